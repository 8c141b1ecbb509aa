"""The vertex inputs for primitives of a mesh that are drawn as instances.

``lower_expansion`` and ``lower_tessellation`` use it, and ``lower_capture`` a part of it. The
attributes of the mesh at the corners of a primitive are vertex inputs per instance, one for each
corner that is read.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from operator import itemgetter

from ...support.frozen import changed
from ..diagnostics.source import Span
from ..ir import build
from ..ir.leaves import Attribute
from ..ir.node import Graph, Node
from ..ir.rewrite import rewrite
from ..ir.shader import AttributeInfo, MeshInput, Shader
from ..ir.stages import INSTANCES, VERTEX, SystemInput
from ..ir.types import INT, UINT, VEC4, Array

VERTEX_INDEX, INSTANCE_INDEX, _ = VERTEX.inputs

NOWHERE = (0.0, 0.0, -1.0, 1.0)
"""A place in clip space that no picture shows."""


def listed_vertex(graph: Graph, count: int) -> Node:
    """The number of a vertex in a draw of so many."""
    last = build.constant(graph, UINT, count - 1)
    index = graph.node("input", UINT, (), VERTEX_INDEX)
    # The host draws no more vertices, so this is the range of the numbers.
    index = graph.node("call", UINT, (index, last), "min")
    return graph.node("call", INT, (index,), "to_int")


def as_attribute(row: SystemInput) -> Attribute:
    """A vertex input in place of a number that the pipeline supplies where nothing is lowered."""
    return Attribute(row.name, row.type, step=row.domain)


def placed(shader: Shader, is_there: Node, position: Node) -> Node:
    """The position of a vertex in clip space; outside of the view if there is nothing to show."""
    nowhere = build.constant(shader.graph, VEC4, NOWHERE)
    value = shader.graph.node("select", VEC4, (is_there, position, nowhere))
    shader.notes.names.setdefault(value.id, "placed")
    return value


def at_number(graph: Graph, names: dict[int, str], values: Sequence[Node], number: Node) -> Node:
    """The one of the values at all corners that a number says."""
    if number.operands:  # Else it has a name, or is a variable of a loop.
        names.setdefault(number.id, "corner")
    whole = graph.node("array", Array(values[0].type, len(values)), tuple(values))
    return build.index(graph, whole, number)


class CornerInputs:
    """Makes the inputs of the corners that are read, and collects them."""

    def __init__(self, shader: Shader, corners: int, span: Span) -> None:
        """``span`` is where the primitive is named."""
        self._graph = shader.graph
        self._notes = shader.notes
        self._corners = corners
        self._infos = [*shader.attributes, *map(partial(_info, span), VERTEX.inputs)]
        """The inputs of the mesh's vertices, with the numbers that they have in it."""
        self._place = {info.leaf: place for place, info in enumerate(self._infos)}
        self._read: dict[tuple[int, int], AttributeInfo] = {}
        """The inputs per primitive that are read instead, by place of an input and corner."""
        self._known: dict[Node, dict[Node, Node]] = {}
        """For each corner, the values there by the values of vertices that they replace."""
        self._is_instanced = any(map(_tells_instances_apart, shader.roots.nodes))

    @property
    def attributes(self) -> tuple[AttributeInfo, ...]:
        """The vertex inputs that are read, in the order of their declaration and of the corners."""
        return tuple(info for _, info in sorted(self._read.items(), key=itemgetter(0)))

    def at_corner(self, value: Node, number: Node) -> Node:
        """A value of the mesh's vertices at one corner, computed from the inputs of this corner."""

        def rule(_graph: object, node: Node, _operands: tuple[Node, ...]) -> Node:
            leaf = as_attribute(node.data) if isinstance(node.data, SystemInput) else node.data
            assert isinstance(leaf, Attribute)
            return self._corner_of(self._place[leaf], number)

        known = self._known.setdefault(number, {})
        ops = ("attribute", "input")
        return rewrite(self._graph, (value,), rule, self._notes.follow, ops, new=known)[0]

    def number(self, counted: SystemInput) -> Node:
        """The number of the primitive, which is that of the instance.

        If the mesh itself is drawn in several instances, the number is a vertex input.
        """
        if not self._is_instanced:
            return self._graph.node("input", UINT, (), INSTANCE_INDEX)
        info = _info(self._infos[-1].span, counted)
        return self.added(changed(info, leaf=changed(info.leaf, step=INSTANCES)))

    def added(self, info: AttributeInfo) -> Node:
        """An input that the mesh does not have, behind all others."""
        if info not in self._infos:
            self._infos.append(info)
        return self._input(self._infos.index(info), 0)

    def _corner_of(self, place: int, number: Node) -> Node:
        """An input at one corner; where this is not a certain one, an element of all."""
        leaf = self._infos[place].leaf
        if leaf.step == INSTANCES or self._corners == 1:
            return self._input(place, 0)
        if number.op == "constant" and isinstance(number.data, int):
            return self._input(place, number.data)
        found = [self._input(place, corner) for corner in range(self._corners)]
        return at_number(self._graph, self._notes.names, found, number)

    def _input(self, place: int, corner: int) -> Node:
        info = self._infos[place]
        leaf, mesh = info.leaf, info.mesh or MeshInput(info.leaf.name)
        if mesh.is_of_pattern:
            pass
        elif leaf.step != INSTANCES:
            mesh = changed(mesh, corner=corner)
            leaf = changed(leaf, name=f"corner{corner}.{leaf.name}", step=INSTANCES)
        elif mesh.is_number:
            leaf = changed(leaf, name=f"draw.{leaf.name}")
        self._read[place, corner] = changed(info, leaf=leaf, mesh=mesh)
        return self._graph.node("attribute", leaf.type, (), leaf)


def _info(span: Span, row: SystemInput) -> AttributeInfo:
    """An input that gives a number which the pipeline supplies where nothing is lowered."""
    mesh = MeshInput(row.name, is_number=True)
    return AttributeInfo(as_attribute(row), str(row.type), "", span, mesh=mesh)


def _tells_instances_apart(node: Node) -> bool:
    return isinstance(node.data, Attribute | SystemInput) and INSTANCES in (
        getattr(node.data, "step", ""),
        getattr(node.data, "domain", ""),
    )

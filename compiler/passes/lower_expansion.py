"""Expansions without a geometry stage: each primitive of the mesh is drawn as an instance.

``lower_stages`` calls ``lower_expansion`` before all passes. The draw has as many vertices as a
primitive emits at most, as a list of triangles or lines, and a vertex knows by its number in which
group, strip and triangle it is. What the mesh has at the corners of the primitive are vertex inputs
per instance, one for each corner that is read. A strip that is not emitted has all its vertices in
one place, beyond the picture. Where render targets have layers, each of these is a draw of its own,
in which the strips of all others are not emitted. The result is the same, as are the order of
triangles and the vertex that each begins with: triangle ``t`` of a strip has the vertices ``t``,
``t + 1 + t mod 2`` and ``t + 2 - t mod 2``, as in Vulkan.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce

from ...support.frozen import changed
from ..ir import build
from ..ir.expansion import Expansion
from ..ir.leaves import Parameter
from ..ir.node import Graph, Node, Roots, reachable
from ..ir.operations import CROSS, INPUT
from ..ir.rewrite import rewrite
from ..ir.shader import Notes, ParameterInfo, Result, Shader
from ..ir.stages import (
    CAPTURED,
    CLIP_POSITION,
    CONTROL,
    EMITTED,
    EMITTING,
    FLAT,
    FRAGMENTS,
    GEOMETRY,
    GROUP,
    LAYER,
    PRIMITIVE_INDEX,
    RASTERISED,
    SMOOTH,
    STRIP,
    STRIP_VERTEX,
    VERTEX,
    SystemInput,
)
from ..ir.types import BOOL, INT
from .corner_inputs import placed
from .draw_parameters import unused_name
from .expanded_corners import CellCorners, Corners, MeshCorners

LAYER_OF_DRAW = "draw.layer"
"""The name of the parameter that says for which layer a draw is."""


def lower_expansion(shader: Shader) -> Shader:
    """The shader with vertices instead of emitted vertices; itself if it expands nothing."""
    if shader.expansion is None:
        return shader
    before = len(shader.graph)
    patches = shader.tessellation
    corners: Corners
    if patches is None:
        corners = MeshCorners(shader, shader.expansion)
    else:
        corners = CellCorners(shader, patches, shader.expansion)
    lowering = _Lowering(shader, shader.expansion, corners)
    told = [result for result in shader.results if result.stage != CONTROL]
    values = lowering.lowered([result.value for result in told])
    results = [changed(r, value=v) for r, v in zip(told, values, strict=True)]
    drawn = lowering.drawn(results)
    delivered = [
        _placed(shader, result, drawn) for result in results if result.kind not in (EMITTING, LAYER)
    ]
    if drawn is not None and shader.capture is not None:
        # There is no place for a vertex that is not captured, so it has to be left out.
        delivered.append(Result(EMITTING, VERTEX, drawn))
    # The vertices' numbers have no place of their own: they get that of the expansion.
    for node in reachable([result.value for result in delivered]):
        if node.id >= before:
            shader.notes.spans.setdefault(node.id, shader.expansion.span)
    return changed(
        shader,
        results=tuple(delivered),
        attributes=corners.attributes,
        levels=corners.levels,
        listed=corners.listed,
        parameters=lowering.parameters,
        layer=lowering.layer or shader.layer,
        chain=RASTERISED if shader.capture is None else CAPTURED,
    )


def _placed(shader: Shader, result: Result, drawn: Node | None) -> Result:
    """A result of the geometry stage as one of the vertices."""
    if result.stage != GEOMETRY:
        return result
    value = result.value
    if result.kind == CLIP_POSITION and drawn is not None:
        value = placed(shader, drawn, value)
    return changed(result, stage=VERTEX, value=value)


class _Lowering:
    """Turns emitted vertices into vertices of a draw, and collects the inputs that they read."""

    def __init__(self, shader: Shader, expansion: Expansion, corners: Corners) -> None:
        self._graph: Graph = shader.graph
        self._notes: Notes = shader.notes
        self._corners = corners
        self._expansion = expansion
        self._parameters = shader.parameters
        self.layer: Parameter | None = None
        """The parameter that says for which layer a draw is, if the render targets have layers."""
        self._numbers = EmittedNumbers(shader.graph, expansion, corners.vertex)

    def lowered(self, roots: Sequence[Node]) -> Roots:
        """The values at the vertices, and of the fragments."""
        return rewrite(self._graph, roots, self._rule, self._notes.follow, ("cross", "input"))

    def drawn(self, results: Sequence[Result]) -> Node | None:
        """A condition: the strip of a vertex exists in this draw. ``None`` if all of them do."""
        values = [result.value for result in results if result.kind == EMITTING]
        layers = [result.value for result in results if result.kind == LAYER]
        found = [] if all(map(_is_true, values)) else [self._numbers.by_group(values)]
        found += [self._is_drawn(layer) for layer in layers]
        found += [] if self._corners.is_there is None else [self._corners.is_there]
        if not found:
            return None
        return reduce(lambda one, other: self._graph.node("call", BOOL, (one, other), "and"), found)

    def _is_drawn(self, layer: Node) -> Node:
        """A condition: a draw is for this layer.

        The host sets a parameter to the layer that it draws.
        """
        self.layer = Parameter(unused_name(LAYER_OF_DRAW, self._parameters), INT, "draw")
        drawn = self._graph.node("parameter", INT, (), self.layer)
        return self._graph.node("call", BOOL, (layer, drawn), "eq")

    @property
    def parameters(self) -> tuple[ParameterInfo, ...]:
        """The parameters, and those that the host sets for each of several draws."""
        if self.layer is None:
            return self._parameters
        doc, span = "The layer of the render targets that is drawn", self._expansion.span
        return (*self._parameters, ParameterInfo(self.layer, str(INT), doc, span, default=0))

    def _rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        if node.op == "input":
            row = INPUT.data(node)
            if row == PRIMITIVE_INDEX:
                assert isinstance(self._corners, MeshCorners)
                return self._corners.number(row)
            if row.domain != EMITTED:
                return None
            found = self._numbers.of(row)
            self._notes.names.setdefault(found.id, row.name)
            return found
        crossing = CROSS.data(node)
        if crossing.destination not in (EMITTED, FRAGMENTS):
            return None  # The vertex of a patch, which a corner asks for.
        if crossing.mode == "corner":
            return self._corners.at_corner(*operands)
        return build.cross(graph, operands[0], FLAT if crossing.mode == "flat" else SMOOTH)


def _is_true(value: Node) -> bool:
    return value.op == "constant" and bool(value.data)


class EmittedNumbers:
    """Position of a vertex of a list of triangles or lines among the groups that are emitted."""

    def __init__(self, graph: Graph, expansion: Expansion, vertex: Node) -> None:
        """``vertex`` is the number of the vertex in that list."""
        self._graph = graph
        self._groups = expansion.groups
        self._starts = expansion.starts
        self._vertex = vertex

    def of(self, row: SystemInput) -> Node:
        """One of the numbers that tell emitted vertices apart."""
        kind = {GROUP: self._number, STRIP: self._strip, STRIP_VERTEX: self._strip_vertex}[row]
        return self.by_group([kind(number) for number in range(len(self._groups))])

    def by_group(self, values: Sequence[Node]) -> Node:
        """The value for the group that the vertex belongs to."""
        *others, chosen = values
        for start, value in zip(self._starts[:0:-1], reversed(others), strict=True):
            if value is not chosen:
                before = self._call("lt", self._vertex, self._number(start))
                chosen = self._graph.node("select", chosen.type, (before, value, chosen))
        return chosen

    def _within(self, number: int) -> Node:
        """The number of the vertex among those of its group."""
        start = self._starts[number]
        return self._call("sub", self._vertex, self._number(start)) if start else self._vertex

    def _strip(self, number: int) -> Node:
        group = self._groups[number]
        if group.strips == 1:
            return self._number(0)
        return self._call("div", self._within(number), self._number(group.listed_each))

    def _strip_vertex(self, number: int) -> Node:
        group, place = self._groups[number], self._within(number)
        if group.strips > 1:
            place = self._call("mod", place, self._number(group.listed_each))
        if not group.kind.is_joined or group.primitives == 1:
            return place
        corners = self._number(group.kind.corners)
        primitive, corner = (self._call(name, place, corners) for name in ("div", "mod"))
        if group.kind.emits == "triangle":
            corner = self._turned(primitive, corner)
        return self._call("add", primitive, corner)

    def _turned(self, triangle: Node, corner: Node) -> Node:
        """A corner of a strip's triangle; every second triangle turns the other way round.

        There, the corners after the first are exchanged.
        """
        odd = self._call("mod", triangle, self._number(2))
        is_later = (self._call("ne", number, self._number(0)) for number in (odd, corner))
        turned = self._call("sub", self._number(3), corner)
        return self._graph.node("select", INT, (self._call("and", *is_later), turned, corner))

    def _number(self, value: int) -> Node:
        return build.constant(self._graph, INT, value)

    def _call(self, name: str, *operands: Node) -> Node:
        is_question = name in ("lt", "ne", "and")
        return self._graph.node("call", BOOL if is_question else INT, operands, name)

"""Crossing from the vertex to the fragment stage, as a node.

A ``cross`` node of ``e`` is a value in the fragment domain; ``e`` lives in the vertex domain. Where
a value that contains crossings is itself wanted in the vertex domain (it feeds ``clip_position`` or
stands under ``@vertex``), the crossings in it are taken out: there is nothing to cross.

Where primitives are expanded or patches are divided, the vertices before the fragments are those
that are made so. What the mesh has at its own vertices gets there by crossings from corners of the
primitive.
"""

from __future__ import annotations

from collections.abc import Callable, Container

from ....stdlib.builtins import BUILTINS
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...diagnostics.source import Span
from ...ir import build
from ...ir.domains import Domains
from ...ir.node import AGE, Graph, Node
from ...ir.operations import CROSS, INPUT
from ...ir.stages import (
    COMPUTED,
    FRAGMENT,
    FRAGMENTS,
    INSTANCES,
    INTO_FRAGMENTS,
    PATCHES,
    RASTERISED,
    VERTEX,
    VERTICES,
    VIEWS,
    Crossing,
    Domain,
    SystemInput,
    inputs_of,
    joined_in,
)
from ...ir.types import INT, UINT, Matrix, Scalar, Vector, scalar_kind, width, with_width
from .origins import Origin
from .places import Places
from .scope import FAILURE, Failure

KERNEL_INPUTS = inputs_of(COMPUTED)
_KERNEL_CROSSINGS = joined_in(COMPUTED)
"""Between which stages of a kernel values cross: there are none, as it has only one."""
INPUTS = inputs_of(RASTERISED)
"""The inputs that the pipeline supplies, by their names in expressions."""


class Crossings:
    """Makes and removes crossings in the trees of one elaboration."""

    def __init__(
        self, graph: Graph, report: Report, follow: Callable[[Node, Node], None], places: Places
    ) -> None:
        """``follow`` hands the knowledge about a node on to its copy."""
        self._graph = graph
        self._report = report
        self._follow = follow
        self._places = places
        self.vertex: dict[int, Node] = {}
        """The values of nodes at the vertices, by the nodes' ids."""
        self._missing: dict[int, Node | None] = {}
        """For a node's id, an operation in it that the vertex stage does not have."""
        self._domains = Domains()

    def attribute(self, leaf: Node, origin: Origin | None) -> Node:
        """A vertex input as the fragment stage sees it; a matrix crosses column by column.

        Where vertices are made of those of the mesh, it is the input of the made ones.
        """
        return self.to_fragments(leaf if origin is None else self._made(leaf, origin))

    def supplied(self, row: SystemInput, origin: Origin | None) -> Node:
        """A value of the pipeline's own as the fragment stage sees it."""
        leaf = self._graph.node("input", row.type, (), row)
        if row in FRAGMENT.inputs:
            return leaf
        if row.domain == PATCHES:
            assert origin is not None
            return self.to_fragments(origin.of_patch(self._graph, leaf))
        return self.attribute(leaf, origin if row in VERTEX.inputs else None)

    def domain(self, node: Node) -> Domain | None:
        """The domain over which a value varies; raises ``MixedDomainsError``."""
        return self._domains.of(node)

    def to_fragments(self, value: Node) -> Node:
        """A value of the stage before as the fragments see it."""
        return self._across(value, self._crossing)

    def at_corner(self, value: Node, number: Node, crossing: Crossing) -> Node:
        """A value of the vertices as one corner of the primitive has it."""
        if self._domains.of(value) == INSTANCES:
            number = build.constant(self._graph, INT, 0)
        return self._across(
            value, lambda part: build.at_corner(self._graph, part, number, crossing)
        )

    def _made(self, value: Node, origin: Origin) -> Node:
        """A value of the mesh's vertices at one that is made of them."""
        is_of_instance = self._domains.of(value) == INSTANCES
        return self._across(
            value, lambda part: origin.value(self._graph, part, is_of_instance=is_of_instance)
        )

    def interpolated(self, node: Node, span: Span) -> Node | Failure:
        """``@vertex node``; the node itself where it is the same at every vertex."""
        inner = self.checked_at_vertex(node, span)
        if isinstance(inner, Failure):
            return FAILURE
        if self._needs_no_crossing(inner):
            return node
        if not isinstance(inner.type, Scalar | Vector):
            self._report.add(rules.CANNOT_CROSS, span, type=inner.type)
            return FAILURE
        return self.to_fragments(inner)

    def checked_at_vertex(self, root: Node, span: Span) -> Node | Failure:
        """``root`` as the vertex stage computes it; reports a part that it cannot compute."""
        inner = self.at_vertex(root)
        found = self._missing_at_vertex(inner)
        if found is None:
            return inner
        read = found.op == "call" and BUILTINS[str(found.data)].sampler is not None
        what = "a texture read without a level" if read else f"`{found.data}`"
        labels = [Label(self._places.within(found, span), "read here")]
        hint = "say which level is read: `name.level(coordinate, 0)`" if read else ""
        self._report.add(rules.NOT_AT_VERTEX, span, what=what, labels=labels, hint=hint)
        return FAILURE

    def at_vertex(self, root: Node) -> Node:
        """``root`` as the stage computes it whose results are interpolated."""
        for node in _unseen(root, self.vertex):
            operands = tuple(self.vertex[operand.id] for operand in node.operands)
            if node.op == "cross" and CROSS.data(node).destination == FRAGMENTS:
                self.vertex[node.id] = operands[0]
            elif operands == node.operands:
                self.vertex[node.id] = node
            else:
                new = self._graph.node(node.op, node.type, operands, node.data)
                self.vertex[node.id] = new
                self._follow(node, new)
                self._places.follow(node, new)
        return self.vertex[root.id]

    def _missing_at_vertex(self, root: Node) -> Node | None:
        """The first operation in a value that the vertex stage does not have."""
        known = self._missing
        for node in _unseen(root, known):
            found = [known[operand.id] for operand in node.operands]
            if not _exists_before_fragments(node):
                found.append(node)
            known[node.id] = min(filter(None, found), key=AGE, default=None)
        return known[root.id]

    def _needs_no_crossing(self, value: Node) -> bool:
        """True if each stage has a value by itself: it is the same all over a draw, or a view."""
        return self._domains.of(value) in (None, VIEWS)

    def _crossing(self, inner: Node) -> Node:
        domain = self._domains.of(inner)
        smooth, flat = INTO_FRAGMENTS.get(domain or VERTICES, INTO_FRAGMENTS[VERTICES])
        is_smooth = scalar_kind(inner.type) == "float" and domain in INTO_FRAGMENTS
        return build.cross(self._graph, inner, smooth if is_smooth else flat)

    def _across(self, value: Node, crossed: Callable[[Node], Node]) -> Node:
        """A value all of whose parts cross alike; itself where each stage has it by itself."""
        if self._needs_no_crossing(value):
            return value
        graph, type_ = self._graph, value.type
        if isinstance(type_, Matrix):
            columns = (build.part(graph, value, column) for column in range(type_.columns))
            return build.matrix(graph, tuple(crossed(column) for column in columns))
        if build.parts_of(type_) is not None:
            parts = build.flattened(graph, value)
            return build.assembled(graph, type_, (self._across(part, crossed) for part in parts))
        return (
            self._bool_crossing(value, crossed) if scalar_kind(type_) == "bool" else crossed(value)
        )

    def _bool_crossing(self, inner: Node, crossed: Callable[[Node], Node]) -> Node:
        """Booleans cross as 0 and 1, which is all that a stage interface can carry."""
        lanes = []
        for lane in range(width(inner.type)):
            one, zero = (build.constant(self._graph, UINT, n) for n in (1, 0))
            flag = build.swizzle(self._graph, inner, (lane,)) if width(inner.type) > 1 else inner
            number = crossed(self._graph.node("select", UINT, (flag, one, zero)))
            lanes.append(self._graph.node("call", with_width("bool", 1), (number, zero), "ne"))
        return build.vector(self._graph, tuple(lanes))


def _unseen(root: Node, seen: Container[int]) -> list[Node]:
    """The nodes that ``root`` needs and that have not been seen, operands before users."""
    found = {root} if root.id not in seen else set()
    pending = list(found)
    while pending:
        for operand in pending.pop().operands:
            if operand.id not in seen and operand not in found:
                found.add(operand)
                pending.append(operand)
    return sorted(found, key=AGE)


def _exists_before_fragments(node: Node) -> bool:
    """True if stages before the fragments have all that an operation needs besides operands."""
    if node.op == "call":
        return not BUILTINS[str(node.data)].compares_pixels
    return node.op != "input" or INPUT.data(node).domain != FRAGMENTS


def missing_in_kernels(root: Node) -> Node | None:
    """The first operation in a value that kernels do not have."""
    return next((node for node in _unseen(root, ()) if not _exists_in_kernels(node)), None)


def _exists_in_kernels(node: Node) -> bool:
    """True if a kernel has all that an operation needs besides its operands."""
    if node.op == "call":
        return not BUILTINS[str(node.data)].compares_pixels
    if node.op == "cross":
        return (CROSS.data(node).origin, CROSS.data(node).destination) in _KERNEL_CROSSINGS
    return node.op != "input" or INPUT.data(node).name in KERNEL_INPUTS

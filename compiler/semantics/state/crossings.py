"""Crossing from the vertex to the fragment stage, as a node.

A ``cross`` node of ``e`` is a value in the fragment domain; ``e`` lives in the vertex domain. Where
a value that contains crossings is itself wanted in the vertex domain (it feeds ``clip_position`` or
stands under ``@vertex``), the crossings in it are taken out: there is nothing to cross.
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
from ...ir.operations import INPUT
from ...ir.stages import (
    FLAT,
    RASTERISED,
    SMOOTH,
    VERTEX,
    VERTICES,
    StageRow,
    SystemInput,
    inputs_of,
)
from ...ir.types import UINT, Scalar, Vector, scalar_kind, width, with_width
from .places import Places
from .scope import FAILURE, Failure

INPUTS = inputs_of(RASTERISED)
"""The names by which expressions read what the pipeline supplies."""


class Crossings:
    """Makes and removes crossings in the trees of one elaboration."""

    def __init__(
        self, graph: Graph, report: Report, follow: Callable[[Node, Node], None], places: Places
    ) -> None:
        """``follow`` hands what is known of a node on to its copy."""
        self._graph = graph
        self._report = report
        self._follow = follow
        self._places = places
        self._vertex: dict[int, Node] = {}
        """What nodes are at the vertices, by their ids."""
        self._missing: dict[int, Node | None] = {}
        """What they have that the vertex stage has not."""
        self._domains = Domains()

    def attribute(self, leaf: Node) -> Node:
        """A vertex input as the fragment stage sees it; a matrix crosses column by column."""
        if leaf.op != "matrix":
            return self._crossing(leaf)
        columns = tuple(self._crossing(column) for column in leaf.operands)
        return self._graph.node("matrix", leaf.type, columns)

    def supplied(self, row: SystemInput) -> Node:
        """A value of the pipeline's own as the fragment stage sees it."""
        leaf = self._graph.node("input", row.type, (), row)
        return self._crossing(leaf) if row in VERTEX.inputs else leaf

    def interpolated(self, node: Node, span: Span) -> Node | Failure:
        """``@vertex node``; the node itself where it is the same at every vertex."""
        inner = self.checked_at_vertex(node, span)
        if isinstance(inner, Failure):
            return FAILURE
        if self._domains.of(inner) is None:
            return node
        if not isinstance(inner.type, Scalar | Vector):
            self._report.add(rules.CANNOT_CROSS, span, type=inner.type)
            return FAILURE
        return self._crossing(inner)

    def checked_at_vertex(self, root: Node, span: Span) -> Node | Failure:
        """``root`` as the vertex stage computes it, or a report of what it cannot compute."""
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
        """``root`` as the vertex stage computes it."""
        for node in _unseen(root, self._vertex):
            operands = tuple(self._vertex[operand.id] for operand in node.operands)
            if node.op == "cross":
                self._vertex[node.id] = operands[0]
            elif operands == node.operands:
                self._vertex[node.id] = node
            else:
                new = self._graph.node(node.op, node.type, operands, node.data)
                self._vertex[node.id] = new
                self._follow(node, new)
                self._places.follow(node, new)
        return self._vertex[root.id]

    def _missing_at_vertex(self, root: Node) -> Node | None:
        """The first operation in a value that the vertex stage does not have."""
        known = self._missing
        for node in _unseen(root, known):
            found = [known[operand.id] for operand in node.operands]
            if not _exists_in(VERTEX, node):
                found.append(node)
            known[node.id] = min(filter(None, found), key=AGE, default=None)
        return known[root.id]

    def _crossing(self, inner: Node) -> Node:
        kind = scalar_kind(inner.type)
        if kind == "bool":
            return self._bool_crossing(inner)
        smooth = kind == "float" and self._domains.of(inner) == VERTICES
        return build.cross(self._graph, inner, SMOOTH if smooth else FLAT)

    def _bool_crossing(self, inner: Node) -> Node:
        """Booleans cross as 0 and 1, which is all that a stage interface can carry."""
        lanes = []
        for lane in range(width(inner.type)):
            one, zero = (build.constant(self._graph, UINT, n) for n in (1, 0))
            flag = build.swizzle(self._graph, inner, (lane,)) if width(inner.type) > 1 else inner
            number = self._graph.node("select", UINT, (flag, one, zero))
            crossed = build.cross(self._graph, number, FLAT)
            lanes.append(self._graph.node("call", with_width("bool", 1), (crossed, zero), "ne"))
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


def _exists_in(stage: StageRow, node: Node) -> bool:
    """Whether a stage has what an operation needs, besides its operands."""
    if node.op == "call":
        return stage.has_derivatives or not BUILTINS[str(node.data)].uniform_control_flow
    return node.op != "input" or INPUT.data(node) in stage.inputs

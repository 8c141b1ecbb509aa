"""Scalar replacement of aggregates (SROA): structures and arrays are replaced by their parts.

The pass runs once the binders are open. Reading a member of a structure that the shader built gives
the value that was put there; reading a member of a selection gives a selection between members.
The only aggregates that remain are uniform blocks, which are read as they are stored, and arrays of
plain values whose index is known only when the shader runs.
"""

from __future__ import annotations

from ..ir import build
from ..ir.node import Graph, Node, Roots
from ..ir.operations import MEMBER
from ..ir.rewrite import rewrite
from ..ir.shader import Notes
from ..ir.types import INT, Array, Matrix
from ..trampoline import Step, run

NESTED_MATRICES = 8
"""Matrices are chosen by branches; of choices inside of more choices, each column by itself."""


def replace_aggregates(graph: Graph, roots: Roots, notes: Notes) -> Roots:
    """The roots without structures, and with arrays of plain values only."""
    ops = ("member", "index", "select")
    return rewrite(graph, roots, _Dissolving(graph, notes).rule, notes.follow, ops)


class _Dissolving:
    def __init__(self, graph: Graph, notes: Notes) -> None:
        self._graph = graph
        self._notes = notes
        self._members: dict[tuple[int, str], Node] = {}
        self._elements: dict[tuple[int, int], Node] = {}
        self._nesting: dict[int, int] = {}
        """Of choices between matrices."""

    def rule(self, _graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        """Resolve what is read of an aggregate; its own parts have been resolved already."""
        if node.op == "member":
            return run(self._member(operands[0], MEMBER.data(node)))
        if node.op == "index" and isinstance(node.operands[0].type, Array):
            return run(self._element(operands[0], operands[1]))
        if node.op == "select" and isinstance(node.type, Matrix):
            return self._matrix(node.type, operands)
        return None

    def _member(self, source: Node, name: str) -> Step[Node]:
        key = source.id, name
        if key not in self._members:
            self._members[key] = yield self._new_member(source, name)
        return self._members[key]

    def _new_member(self, source: Node, name: str) -> Step[Node]:
        if source.op == "select":
            condition, then, otherwise = source.operands
            first = yield self._member(then, name)
            second = yield self._member(otherwise, name)
            return self._chosen(condition, first, second)
        if _in_made_array(source):
            array, position = source.operands
            parts: list[Node] = []
            for element in array.operands:
                part = yield self._member(element, name)
                parts.append(part)
            found: Node = yield self._element(self._array(parts, array, name), position)
            return found
        return build.member(self._graph, source, name)

    def _element(self, source: Node, position: Node) -> Step[Node]:
        key = source.id, position.id
        if key not in self._elements:
            self._elements[key] = yield self._new_element(source, position)
        return self._elements[key]

    def _new_element(self, source: Node, position: Node) -> Step[Node]:
        if source.op == "select":
            condition, then, otherwise = source.operands
            first = yield self._element(then, position)
            second = yield self._element(otherwise, position)
            return self._chosen(condition, first, second)
        if _in_made_array(source):
            rows, row = source.operands
            found: Node = yield self._of_nested(rows, row, position)
            return found
        return build.index(self._graph, source, position)

    def _of_nested(self, rows: Node, row: Node, position: Node) -> Step[Node]:
        """``rows[row][position]``, where the rows were put together."""
        if position.op != "constant" and all(inner.op == "array" for inner in rows.operands):
            width = len(rows.operands[0].operands)
            flat = [part for inner in rows.operands for part in inner.operands]
            first = self._graph.node(
                "call", INT, (row, build.constant(self._graph, INT, width)), "mul"
            )
            place = self._graph.node("call", INT, (first, position), "add")
            found: Node = yield self._element(self._array(flat, rows), place)
            return found
        parts: list[Node] = []
        for inner in rows.operands:
            part = yield self._element(inner, position)
            parts.append(part)
        found = yield self._element(self._array(parts, rows), row)
        return found

    def _array(self, parts: list[Node], source: Node, member: str = "") -> Node:
        """An array of what is read of the elements of ``source``, called after it."""
        array = self._graph.node("array", Array(parts[0].type, len(parts)), tuple(parts))
        name = self._notes.names.get(source.id)
        if name is not None:
            self._notes.names.setdefault(array.id, f"{name}_{member}" if member else name)
        return array

    def _chosen(self, condition: Node, then: Node, otherwise: Node) -> Node:
        if then is otherwise:
            return then
        return self._graph.node("select", then.type, (condition, then, otherwise))

    def _matrix(self, type_: Matrix, operands: tuple[Node, ...]) -> Node | None:
        """A choice between matrices, column by column if it is nested too deeply."""
        condition, *sides = operands
        depth = 1 + max(self._nesting.get(side.id, 0) for side in sides)
        if depth <= NESTED_MATRICES:
            whole = self._graph.node("select", type_, operands)
            self._nesting[whole.id] = depth
            return None
        columns = []
        for i in range(type_.size):
            position = build.constant(self._graph, INT, i)
            then, otherwise = (build.index(self._graph, side, position) for side in sides)
            columns.append(self._chosen(condition, then, otherwise))
        parted = build.matrix(self._graph, tuple(columns))
        self._nesting[parted.id] = depth
        return parted


def _in_made_array(source: Node) -> bool:
    """Whether an aggregate is an element of an array that was put together."""
    return source.op == "index" and source.operands[0].op == "array"

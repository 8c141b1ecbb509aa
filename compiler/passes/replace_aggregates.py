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

NESTED_MATRICES = 8
"""Matrices are chosen by branches; of choices inside of more choices, each column by itself."""

_Read = tuple[Node, str | Node]
"""A read of an aggregate: of a member, by its name, or of an element, by its number."""


def replace_aggregates(graph: Graph, roots: Roots, notes: Notes) -> Roots:
    """The roots without structures, and with arrays of plain values only."""
    ops = ("member", "index", "select")
    return rewrite(graph, roots, _Dissolving(graph, notes).rule, notes.follow, ops)


class _Dissolving:
    def __init__(self, graph: Graph, notes: Notes) -> None:
        self._graph = graph
        self._notes = notes
        self._read: dict[_Read, Node] = {}
        self._nesting: dict[int, int] = {}
        """The depth of nested choices between matrices."""

    def rule(self, _graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        """Resolves reads of an aggregate; its own parts have been resolved already."""
        if node.op == "member":
            return self._resolved((operands[0], MEMBER.data(node)))
        if node.op == "index" and isinstance(node.operands[0].type, Array):
            return self._resolved((operands[0], operands[1]))
        if node.op == "select" and isinstance(node.type, Matrix):
            return self._matrix(node.type, operands)
        return None

    def _resolved(self, wanted: _Read) -> Node:
        """The value of a read, without the choices and arrays that it goes through."""
        pending = [wanted]
        while pending:
            read = pending[-1]
            if read in self._read:
                pending.pop()
            elif missing := [need for need in self._needs(read) if need not in self._read]:
                pending += reversed(missing)
            else:
                self._read[read] = self._made(read)
        return self._read[wanted]

    def _needs(self, read: _Read) -> list[_Read]:
        """The reads that come first: of the same part of each side, or of each element."""
        source, part = read
        if source.op == "select":
            return [(side, part) for side in source.operands[1:]]
        if _in_made_array(source) and not _is_flattened(source, part):
            return [(element, part) for element in source.operands[0].operands]
        return []

    def _made(self, read: _Read) -> Node:
        """The value of a read, once the values of all that it needs are there."""
        source, part = read
        if source.op == "select":
            then, otherwise = (self._read[need] for need in self._needs(read))
            return self._chosen(source.operands[0], then, otherwise)
        if _in_made_array(source):
            array, position = source.operands
            if isinstance(part, Node) and _is_flattened(source, part):
                return self._of_rows(array, position, part)
            parts = [self._read[need] for need in self._needs(read)]
            name = part if isinstance(part, str) else ""
            return build.index(self._graph, self._array(parts, array, name), position)
        if isinstance(part, str):
            return build.member(self._graph, source, part)
        return build.index(self._graph, source, part)

    def _of_rows(self, rows: Node, row: Node, position: Node) -> Node:
        """``rows[row][position]``, of the elements of all rows in one array."""
        width = len(rows.operands[0].operands)
        flat = [part for inner in rows.operands for part in inner.operands]
        first = self._graph.node("call", INT, (row, build.constant(self._graph, INT, width)), "mul")
        place = self._graph.node("call", INT, (first, position), "add")
        return build.index(self._graph, self._array(flat, rows), place)

    def _array(self, parts: list[Node], source: Node, member: str = "") -> Node:
        """An array of the parts that are read of the elements of ``source``, called after it."""
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
        for i in range(type_.columns):
            position = build.constant(self._graph, INT, i)
            then, otherwise = (build.index(self._graph, side, position) for side in sides)
            columns.append(self._chosen(condition, then, otherwise))
        parted = build.matrix(self._graph, tuple(columns))
        self._nesting[parted.id] = depth
        return parted


def _in_made_array(source: Node) -> bool:
    """True if an aggregate is an element of an array that the shader built."""
    return source.op == "index" and source.operands[0].op == "array"


def _is_flattened(source: Node, part: str | Node) -> bool:
    """True if an element, at a position that the shader computes, is read of one row of many."""
    rows = source.operands[0]
    is_computed = isinstance(part, Node) and part.op != "constant"
    return is_computed and all(row.op == "array" for row in rows.operands)

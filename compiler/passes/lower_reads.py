"""Lowers reads of parameters and buffers to the form in which memory has them.

Every conversion from the stored form becomes a node of its own. Scalars, vectors and matrices are
converted where they are read. Structs and arrays keep their stored form through selects, binders
and calls, until a member or an element is taken out of them. A product of a matrix and a column,
and a single column, are computed from the matrix as it is stored.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Mapping

from ..ir.binding import Moved
from ..ir.build import constant, index, matrix, member, swizzle, vector
from ..ir.node import Graph, Node, Roots
from ..ir.operations import MEMBER, SWIZZLE
from ..ir.rewrite import rewrite
from ..ir.storage import elements_in_row, stored_elements, stored_type
from ..ir.types import (
    BOOL,
    INT,
    UINT,
    VEC4,
    Array,
    Matrix,
    RuntimeArray,
    Scalar,
    Struct,
    Type,
    Vector,
    width,
)

_READS = frozenset({"parameter", "buffer", "member", "index"})
"""Apart from these and from variables, operations change only where an operand has changed."""

_MADE = frozenset({"array", "struct", "iterate"})
"""Operations that build aggregates in the shader, of plain values; all others are stored."""


def lower_reads(graph: Graph, roots: Iterable[Node], moved: Moved | None = None) -> Roots:
    """The roots, with every parameter and buffer of its stored type.

    Lowering twice changes nothing. Indices are expected within bounds: whoever made them has
    clamped them.
    """
    return rewrite(graph, roots, _lower, moved)


def _lower(graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
    if operands and operands is node.operands and node.op not in _READS:
        return None
    if node.op == "parameter":
        stored = graph.node("parameter", stored_type(node.type), (), node.data)
        return _loaded(graph, node.type, stored)
    if node.op == "buffer":
        return graph.node("buffer", stored_type(node.type), (), node.data)
    if node.op in _MADE or (operands and node.operands[0].op in _MADE):
        return None
    if node.op == "member":
        return _loaded(graph, node.type, member(graph, operands[0], MEMBER.data(node)))
    if node.op == "index" and isinstance(node.operands[0].type, Array):
        return _element(graph, node.type, *operands)
    if node.op == "index" and isinstance(node.operands[0].type, RuntimeArray):
        return _buffered(graph, node.type, *operands)
    if isinstance(node.type, Vector) and operands and (whole := _whole(graph, operands[0])):
        return _from_whole(graph, node, whole, operands)
    if node.op == "swizzle" and operands[0].op == "swizzle":
        inner = SWIZZLE.data(operands[0])
        lanes = tuple(inner[lane] for lane in SWIZZLE.data(node))
        return swizzle(graph, operands[0].operands[0], lanes)
    if isinstance(node.type, Struct | Array):
        return graph.node(node.op, stored_type(node.type), operands, node.data)
    return None


def _loaded(graph: Graph, type_: Type, stored: Node) -> Node:
    """The value of ``type_`` that ``stored`` holds; structs and arrays stay stored."""
    match type_:
        case Scalar("bool"):
            return _is_set(graph, stored)
        case Vector("bool", size):
            lanes = (swizzle(graph, stored, (lane,)) for lane in range(size))
            return vector(graph, tuple(_is_set(graph, lane) for lane in lanes))
        case Matrix(rows=rows) if rows < 4:
            return _upper(graph, type_, stored)
        case _:
            return stored


def _element(graph: Graph, element: Type, stored: Node, position: Node) -> Node:
    """Element ``position`` of an array in stored form."""
    match element:
        case Matrix(columns):
            first = _computed(graph, "mul", position, columns)
            positions = [_computed(graph, "add", first, column) for column in range(columns)]
            return _matrix(graph, element, stored, positions)
        case Scalar() | Vector():
            return _loaded(graph, element, _from_row(graph, element, stored, position))
        case _:
            return index(graph, stored, position)


def _buffered(graph: Graph, element: Type, stored: Node, position: Node) -> Node:
    """Element ``position`` of a storage buffer in stored form."""
    if isinstance(element, Matrix):
        first = _computed(graph, "mul", position, stored_elements(element))
        positions = [_computed(graph, "add", first, column) for column in range(element.columns)]
        return _matrix(graph, element, stored, positions)
    read = index(graph, stored, position)
    if isinstance(element, Vector) and element.size == 3:
        read = swizzle(graph, read, (0, 1, 2))
    return _loaded(graph, element, read)


def _from_row(graph: Graph, element: Scalar | Vector, stored: Node, position: Node) -> Node:
    """The lanes in which an array of ``vec4`` holds a scalar or vector."""
    in_row = elements_in_row(element)
    row = index(graph, stored, _computed(graph, "div", position, in_row))
    if in_row == 1:
        return swizzle(graph, row, tuple(range(width(element))))
    within = _computed(graph, "mod", position, in_row)
    if within.op == "constant" and isinstance(within.data, int):
        first = within.data * width(element)
        return swizzle(graph, row, tuple(range(first, first + width(element))))
    if in_row == 4:
        return index(graph, row, within)
    is_first = graph.node("native", BOOL, (within, constant(graph, within.type, 0)), "eq")
    halves = swizzle(graph, row, (0, 1)), swizzle(graph, row, (2, 3))
    return graph.node("select", halves[0].type, (is_first, *halves))


def _matrix(graph: Graph, type_: Matrix, stored: Node, positions: list[Node]) -> Node:
    lanes = tuple(range(type_.rows))
    columns = (swizzle(graph, index(graph, stored, position), lanes) for position in positions)
    return matrix(graph, tuple(columns))


def _upper(graph: Graph, type_: Matrix, stored: Node) -> Node:
    """The upper rows of a stored matrix."""
    positions = [constant(graph, INT, column) for column in range(type_.columns)]
    return _matrix(graph, type_, stored, positions)


def _whole(graph: Graph, upper: Node) -> Node | None:
    """The stored matrix that was read to give ``upper``, if it was read and not computed."""
    if not isinstance(upper.type, Matrix):
        return None
    stored = upper
    for op in ("matrix", "swizzle", "index"):
        if stored.op != op:
            return None
        stored = stored.operands[0]
    fits = stored.type == stored_type(upper.type)
    return stored if fits and _upper(graph, upper.type, stored) is upper else None


def _from_whole(graph: Graph, node: Node, stored: Node, operands: tuple[Node, ...]) -> Node | None:
    """A vector that is computed from a stored matrix: the upper rows of the result of all rows."""
    if node.op == "index":
        rows = index(graph, stored, operands[1])
    elif node.op == "native" and node.data == "mul":
        rows = graph.node("native", VEC4, (stored, operands[1]), "mul")
    else:
        return None
    return swizzle(graph, rows, tuple(range(width(node.type))))


def _is_set(graph: Graph, stored: Node) -> Node:
    return graph.node("native", BOOL, (stored, constant(graph, UINT, 0)), "ne")


_FOLDED: Mapping[str, Callable[[int, int], int]] = {
    "add": operator.add,
    "mul": operator.mul,
    "div": operator.floordiv,
    "mod": operator.mod,
}
_WITHOUT_EFFECT = {("add", 0), ("mul", 1), ("div", 1)}


def _computed(graph: Graph, operation: str, position: Node, number: int) -> Node:
    """Index arithmetic: constants are computed here, the rest as the hardware does it.

    Indices are never negative, so the hardware's division is the same everywhere.
    """
    if (operation, number) in _WITHOUT_EFFECT:
        return position
    if position.op == "constant" and isinstance(position.data, int):
        return constant(graph, position.type, _FOLDED[operation](position.data, number))
    operands = (position, constant(graph, position.type, number))
    return graph.node("native", position.type, operands, operation)

"""Short spellings for making nodes; types of results are derived here and nowhere else."""

from __future__ import annotations

from .node import Graph, Node
from .types import (
    FLOAT,
    INT,
    VEC4,
    Array,
    Matrix,
    Struct,
    TallMatrix,
    Type,
    Vector,
    scalar_kind,
    width,
    with_width,
)

Number = float | int | bool


def constant(graph: Graph, type_: Type, value: Number | tuple[Number, ...]) -> Node:
    """A constant; a tuple gives the lanes of a vector."""
    return graph.node("constant", type_, (), value)


def floating(graph: Graph, value: float) -> Node:
    """A float constant."""
    return constant(graph, FLOAT, float(value))


def vector(graph: Graph, operands: tuple[Node, ...]) -> Node:
    """The lanes of scalars and vectors of one kind, joined."""
    lanes = sum(width(operand.type) for operand in operands)
    kind = scalar_kind(operands[0].type)
    assert kind is not None and 1 <= lanes <= 4
    return (
        operands[0] if len(operands) == 1 else graph.node("vector", Vector(kind, lanes), operands)
    )


def splat(graph: Graph, operand: Node, lanes: int) -> Node:
    """A scalar in every lane; the scalar itself for one lane."""
    if lanes == 1:
        return operand
    kind = scalar_kind(operand.type)
    assert kind is not None
    return graph.node("splat", Vector(kind, lanes), (operand,))


def matrix(graph: Graph, columns: tuple[Node, ...]) -> Node:
    """A square matrix from its columns."""
    return graph.node("matrix", Matrix(len(columns)), columns)


def swizzle(graph: Graph, operand: Node, lanes: tuple[int, ...]) -> Node:
    """Lanes of a vector (or of a scalar, where every lane is 0)."""
    kind = scalar_kind(operand.type)
    assert kind is not None
    if width(operand.type) == 1:
        return splat(graph, operand, len(lanes))
    if lanes == tuple(range(width(operand.type))):
        return operand
    return graph.node("swizzle", with_width(kind, len(lanes)), (operand,), lanes)


def index(graph: Graph, operand: Node, position: Node) -> Node:
    """Element of an array, column of a matrix or lane of a vector."""
    match operand.type:
        case Array(element=element):
            type_: Type = element
        case Matrix(size=size):
            type_ = Vector("float", size)
        case TallMatrix():
            type_ = VEC4
        case Vector(kind=kind):
            type_ = with_width(kind, 1)
        case _:
            raise TypeError(f"{operand.type} cannot be indexed")
    return graph.node("index", type_, (operand, position))


def element(graph: Graph, operand: Node, number: int) -> Node:
    """A known element, column or lane; of a matrix put together from columns no other is read."""
    if operand.op == "matrix":
        return operand.operands[number]
    return index(graph, operand, constant(graph, INT, number))


def member(graph: Graph, operand: Node, name: str) -> Node:
    """Member of a struct."""
    assert isinstance(operand.type, Struct)
    return graph.node("member", operand.type.member(name), (operand,), name)

"""Functions that make the most common nodes, and derive the types of these."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ...stdlib.builtins.facts import LARGEST_FLOAT
from .leaves import Leaf, Number
from .node import Applying, FoldOperator, Formals, Graph, Iterating, Node, Op, bare
from .stages import CORNER, Crossing
from .types import (
    FLOAT,
    INT,
    Array,
    Matrix,
    RuntimeArray,
    ScalarKind,
    Struct,
    Type,
    Vector,
    scalar_kind,
    width,
    with_width,
)


def constant(graph: Graph, type_: Type, value: Number | tuple[Number, ...]) -> Node:
    """A constant; a tuple gives the lanes of a vector."""
    return graph.node("constant", type_, (), value)


def floating(graph: Graph, value: float) -> Node:
    """A float constant."""
    return constant(graph, FLOAT, float(value))


def neutral(operator: FoldOperator, kind: ScalarKind) -> Number:
    """The identity element of an operator: joined with any number of this kind, it changes nothing.

    A fold without terms has this value.
    """
    if operator in ("min", "max"):
        least, greatest = _ENDS[kind]
        return greatest if operator == "min" else least
    value = _NEUTRAL[operator]
    return float(value) if kind == "float" else value


_NEUTRAL: Mapping[FoldOperator, int | bool] = {"add": 0, "mul": 1, "and": True, "or": False}
_ENDS: Mapping[ScalarKind, tuple[Number, Number]] = {
    "float": (-LARGEST_FLOAT, LARGEST_FLOAT), "int": (-(2**31), 2**31 - 1), "uint": (0, 2**32 - 1),
}  # fmt: skip


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
    """A matrix from its columns."""
    return graph.node("matrix", Matrix(len(columns), width(columns[0].type)), columns)


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
    """Element of an array or a buffer, column of a matrix or lane of a vector."""
    if operand.op == "array" and position.op == "constant" and isinstance(position.data, int):
        return operand.operands[position.data]
    match operand.type:
        case Array(element=element) | RuntimeArray(element):
            type_: Type = element
        case Matrix():
            type_ = operand.type.column
        case Vector(kind=kind):
            type_ = with_width(kind, 1)
        case _:
            raise TypeError(f"{operand.type} cannot be indexed")
    return graph.node("index", type_, (operand, position))


def read(graph: Graph, leaf: Leaf) -> Node:
    """The value of a leaf."""
    return graph.node(leaf.KIND, leaf.type, (), leaf)


def member(graph: Graph, operand: Node, name: str) -> Node:
    """A member of a struct; of a struct that was built here, the value that it was built of."""
    assert isinstance(operand.type, Struct)
    if operand.op == "struct":
        return operand.operands[[member for member, _ in operand.type.members].index(name)]
    return graph.node("member", operand.type.member(name), (operand,), name)


def in_body(node: Node) -> Node | None:
    """A call's result, or a member of it, as the function's body computes it.

    ``None`` for other nodes, and for a member of what the body does not put together itself. The
    facts of the node in the body hold for the call's, too.
    """
    if node.op != "member":
        return node.operands[0] if node.op == "apply" else None
    whole = in_body(node.operands[0])
    built = None if whole is None else bare(whole)
    if built is None or built.op != "struct":
        return None
    assert isinstance(built.type, Struct)
    return built.operands[[name for name, _ in built.type.members].index(str(node.data))]


def part(graph: Graph, operand: Node, position: int) -> Node:
    """Member, element, column or lane ``position``, simplified if the operand was built here."""
    if operand.op in ("struct", "array", "matrix"):
        return operand.operands[position]
    if isinstance(operand.type, Struct):
        return member(graph, operand, operand.type.members[position][0])
    return index(graph, operand, constant(graph, INT, position))


def parts_of(type_: Type) -> tuple[Type, ...] | None:
    """The types of an aggregate's members or elements; ``None`` where it is none."""
    match type_:
        case Struct(members=members):
            return tuple(inner for _, inner in members)
        case Array(element=element, count=count):
            return (element,) * count
        case _:
            return None


def assembled(graph: Graph, type_: Type, leaves: Iterator[Node]) -> Node:
    """An aggregate from the parts of its parts, or the next leaf where ``type_`` is none.

    Recurses over a type, whose nesting is that of declarations.
    """
    parts = parts_of(type_)
    if parts is None:
        return next(leaves)
    op: Op = "struct" if isinstance(type_, Struct) else "array"
    return graph.node(op, type_, tuple(assembled(graph, inner, leaves) for inner in parts))


def flattened(graph: Graph, node: Node) -> Iterator[Node]:
    """The parts of a value's parts, down to those that are no aggregates.

    If the value is no aggregate, it is the only one.
    """
    parts = parts_of(node.type)
    if parts is None:
        yield node
        return
    for position in range(len(parts)):
        yield from flattened(graph, part(graph, node, position))


def named_parts(name: str, type_: Type) -> Iterator[tuple[str, Type]]:
    """Names and types of the parts that ``flattened`` makes of a value."""
    match type_:
        case Struct(members=members):
            for member, inner in members:
                yield from named_parts(f"{name}_{member}", inner)
        case Array(element=element, count=count):
            for i in range(count):
                yield from named_parts(f"{name}_{i}", element)
        case _:
            yield name, type_


def states_type(types: Sequence[Type]) -> Type:
    """The type of a loop with states of these types: of one, its own; of several, their struct."""
    if len(types) == 1:
        return types[0]
    return Struct("", tuple((str(i), type_) for i, type_ in enumerate(types)))


def iterate(
    graph: Graph,
    data: Iterating,
    count: Node,
    starts: tuple[Node, ...],
    going: Node,
    nexts: tuple[Node, ...],
) -> Node:
    """A loop over states; ``going`` and ``nexts`` stand under its binder."""
    type_ = states_type([start.type for start in starts])
    return graph.node("iterate", type_, (count, *starts, going, *nexts), data)


def apply(
    graph: Graph, body: Node, arguments: tuple[Node, ...], formals: Formals | None = None
) -> Node:
    """A call: ``body`` with these arguments for its bound variables, or for ``formals``."""
    return graph.node("apply", body.type, (body, *arguments), Applying(len(arguments), formals))


def state(graph: Graph, loop: Node, position: int) -> Node:
    """The final value of one of a loop's states."""
    data = loop.data
    assert isinstance(data, Iterating)
    return loop if data.states == 1 else member(graph, loop, str(position))


def cross(graph: Graph, value: Node, crossing: Crossing) -> Node:
    """A value of one stage as the next one sees it."""
    return graph.node("cross", value.type, (value,), crossing)


def at_corner(graph: Graph, value: Node, number: Node, crossing: Crossing = CORNER) -> Node:
    """A value of the vertices as one corner of a primitive has it."""
    return graph.node("cross", value.type, (value, number), crossing)

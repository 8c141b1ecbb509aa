"""The rules that derive the type of each operation's value: a column of ``operations.py``.

The verifier calls them after it has checked the number of operands and the class of the data. A
rule returns ``None`` if the types of the operands do not fit.
"""

from __future__ import annotations

from collections.abc import Mapping

from . import signatures
from .build import parts_of, states_type
from .leaves import Argument, Attribute, Buffer, Parameter, Texture
from .node import Applying, Folding, Iterating, Node
from .stages import Crossing, SystemInput
from .types import (
    BOOL,
    INT,
    Array,
    Matrix,
    Opaque,
    RuntimeArray,
    Scalar,
    ScalarKind,
    Struct,
    Type,
    Vector,
    scalar_kind,
    width,
    with_width,
)

_DECLARED = (Argument, Attribute, Buffer, Parameter, Texture, SystemInput)
_LANES: Mapping[ScalarKind, type] = {"float": float, "int": int, "uint": int, "bool": bool}


def declared(node: Node) -> Type | None:
    """Leaves that are declared with their type."""
    return node.data.type if isinstance(node.data, _DECLARED) else None


def own(node: Node) -> Type | None:
    """Leaves whose type stands nowhere else."""
    return node.type


def marked(node: Node) -> Type | None:
    """The type of the first operand, about which something is noted."""
    return node.operands[0].type


def constant(node: Node) -> Type | None:
    """Any type of lanes that the data has."""
    return node.type if _holds(node.type, node.data) else None


def _holds(type_: Type, data: object) -> bool:
    match type_:
        case Scalar(kind):
            # A bool is an int to Python, but not to us.
            return isinstance(data, _LANES[kind]) and (kind == "bool") == isinstance(data, bool)
        case Vector(kind, size):
            return _all_hold(Scalar(kind), size, data)
        case Matrix(columns):
            return _all_hold(type_.column, columns, data)
        case _:
            return False


def _all_hold(part: Type, count: int, data: object) -> bool:
    return isinstance(data, tuple) and len(data) == count and all(_holds(part, d) for d in data)


def builtin(node: Node) -> Type | None:
    """The result type by the signatures of the builtin."""
    types = tuple(operand.type for operand in node.operands)
    return signatures.result_type(str(node.data), types)


def vector(node: Node) -> Type | None:
    """A vector with the lanes of all operands together, of their common kind."""
    types = [o.type for o in node.operands if isinstance(o.type, Scalar | Vector)]
    kinds = {type_.kind for type_ in types}
    if len(kinds) != 1 or len(types) != len(node.operands):
        return None
    lanes = sum(map(width, types))
    return Vector(kinds.pop(), lanes) if 2 <= lanes <= 4 else None


def splat(node: Node) -> Type | None:
    """A vector of the operand's kind; only the node itself says how wide."""
    (lane,) = node.operands
    if not isinstance(lane.type, Scalar) or not isinstance(node.type, Vector):
        return None
    return Vector(lane.type.kind, node.type.size)


def matrix(node: Node) -> Type | None:
    """A matrix of its columns."""
    column, columns = node.operands[0].type, len(node.operands)
    fits = 2 <= columns <= 4 and all(operand.type == column for operand in node.operands)
    is_column = isinstance(column, Vector) and column.kind == "float"
    return Matrix(columns, width(column)) if fits and is_column else None


def aggregate(node: Node) -> Type | None:
    """A structure or an array whose parts have the types of the operands."""
    wanted = Struct if node.op == "struct" else Array
    given = tuple(operand.type for operand in node.operands)
    return node.type if isinstance(node.type, wanted) and parts_of(node.type) == given else None


def swizzle(node: Node) -> Type | None:
    """A vector with the named lanes, each within the operand."""
    (source,) = node.operands
    lanes = node.data
    if not isinstance(source.type, Vector) or not isinstance(lanes, tuple) or len(lanes) > 4:
        return None
    inside = lanes and all(0 <= lane < source.type.size for lane in lanes)
    return with_width(source.type.kind, len(lanes)) if inside else None


def index(node: Node) -> Type | None:
    """The element of an array or a buffer, the column of a matrix, the lane of a vector."""
    aggregate, position = (operand.type for operand in node.operands)
    if position not in (INT, Scalar("uint")):
        return None
    match aggregate:
        case Array(element=element) | RuntimeArray(element):
            return element
        case Matrix():
            return aggregate.column
        case Vector(kind=kind):
            return Scalar(kind)
        case _:
            return None


def member(node: Node) -> Type | None:
    """The type of the structure's member."""
    (source,) = node.operands
    members = source.type.members if isinstance(source.type, Struct) else ()
    return dict(members).get(str(node.data))


def select(node: Node) -> Type | None:
    """The type of both sides; textures and buffers cannot be selected."""
    condition, then, otherwise = (operand.type for operand in node.operands)
    fits = condition == BOOL and then == otherwise and not isinstance(then, Opaque)
    return then if fits else None


def cross(node: Node) -> Type | None:
    """The type of the operand; only floats have a mean."""
    inner, *corner = node.operands
    assert isinstance(node.data, Crossing)
    numbered = node.data.mode == "corner"
    smooth = node.data.mode == "perspective" and scalar_kind(inner.type) != "float"
    numeric = _is_numeric(inner) and scalar_kind(inner.type) != "bool"
    fits = numeric and not smooth and [number.type for number in corner] == [INT] * numbered
    return inner.type if fits else None


def fold(node: Node) -> Type | None:
    """The type of the start and of the body, which are numbers or vectors."""
    count, start, body = (operand.type for operand in node.operands)
    fits = isinstance(node.data, Folding) and count == INT and start == body
    return body if fits and _is_numeric(node.operands[2]) else None


def iterate(node: Node) -> Type | None:
    """The type of the only state, or a structure of all of them."""
    data = node.data
    if not isinstance(data, Iterating) or len(node.operands) != 2 + 2 * data.states:
        return None
    count, *states = (operand.type for operand in node.operands)
    starts, going, nexts = states[: data.states], states[data.states], states[data.states + 1 :]
    fits = count == INT and going == BOOL and starts == nexts
    plain = all(isinstance(type_, Scalar | Vector | Matrix) for type_ in starts)
    return states_type(starts) if fits and plain else None


def apply(node: Node) -> Type | None:
    """The type of the body, with an argument for each variable."""
    body, *arguments = node.operands
    data = node.data
    fits = isinstance(data, Applying) and data.arguments == len(arguments)
    return body.type if fits else None


def _is_numeric(node: Node) -> bool:
    return isinstance(node.type, Scalar | Vector)

"""Simplification rules that compute constants: the one way in which an operation becomes one.

Every node that a pass builds is looked up in the table of rules. So it makes no difference which
rule, or which pass, made the last operand a constant: the operation is then computed here, by the
reference. ``loops.py`` has the same for loops over constants.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import isnan

from ....stdlib.builtins import BUILTINS
from ....stdlib.builtins.facts import LARGEST_FLOAT
from ...ir import build
from ...ir.leaves import Number
from ...ir.node import HEADS, Node
from ...ir.operations import CALL, SWIZZLE
from ...ir.types import Matrix, Scalar, Type, Vector, scalar_kind, width
from ...reference.namespace import Lanes
from ...reference.operations import apply, constant_lanes
from .builder import Builder, uniform_lane
from .rule import Rule
from .terms import CONSTANT, Several, Variable, computed, condition, function
from .vocabulary import c, cs, lanes, splat, swizzle, vector

DEEPEST = 4
"""The number of nested operations that are looked through for the value of a single lane."""

_LANEWISE = (
    "add", "sub", "mul", "div", "mod", "neg", "abs", "min", "max", "clamp", "saturate", "mix",
    "step", "smoothstep", "pow", "sqrt",
)  # fmt: skip
"""The builtins, computed lane by lane, through which single constant lanes are followed."""


# --- operations whose operands are all constant --------------------------------------------------


@condition("{} looks at no neighbours, and all of {} are constants, also in columns")
def _is_foldable(_builder: Builder, type_: Type, name: str, operands: tuple[Node, ...]) -> bool:
    is_number = isinstance(type_, Scalar | Vector | Matrix)
    has_value = is_number and not BUILTINS[name].uniform_control_flow
    return has_value and all(map(_is_constant, operands))


def _is_constant(node: Node) -> bool:
    """True if an operand is a constant; a matrix is made of constant columns."""
    return node.op == "constant" or all(column.op == "constant" for column in node.operands)


@computed
def _value(builder: Builder, type_: Type, name: str, operands: tuple[Node, ...]) -> Node:
    """The value of a builtin of constants."""
    call = builder.graph.node("call", type_, operands, name)
    return constant_of(builder, type_, apply(call, list(map(_lanes_of, operands))))


def _lanes_of(node: Node) -> Lanes:
    if node.op == "constant":
        return constant_lanes(node.type, node.data)
    return tuple(constant_lanes(column.type, column.data) for column in node.operands)


def constant_of(b: Builder, type_: Type, values: Lanes) -> Node:
    """The result of a computation, as a constant that float32 holds; of a matrix, its columns.

    Overflow is outside of what programs mean, but every compiler has to take the text: Tint and
    naga refuse constants beyond the largest number, and an expression that comes to one.
    """
    if isinstance(type_, Matrix):
        columns = tuple(constant_of(b, type_.column, value) for value in values)
        return b.make("matrix", type_, columns)
    lanes = tuple(map(_contained, values))
    return build.constant(b.graph, type_, lanes if isinstance(type_, Vector) else lanes[0])


def _contained(value: Number) -> Number:
    """The nearest number that float32 holds; where infinities have made a NaN, zero."""
    if not isinstance(value, float):
        return value
    return 0.0 if isnan(value) else min(max(value, -LARGEST_FLOAT), LARGEST_FLOAT)


# --- joining constants, and taking parts of them -------------------------------------------------


@computed
def _picked(builder: Builder, type_: Type, source: Node, picked: tuple[int, ...]) -> Node:
    values = constant_lanes(source.type, source.data)
    return constant_of(builder, type_, tuple(values[lane] for lane in picked))


@computed
def _joined(builder: Builder, type_: Type, parts: tuple[Node, ...]) -> Node:
    values = (constant_lanes(each.type, each.data) for each in parts)
    return constant_of(builder, type_, tuple(lane for part in values for lane in part))


@computed
def _filled(builder: Builder, type_: Type, lane: Node) -> Node:
    (value,) = constant_lanes(lane.type, lane.data)
    return constant_of(builder, type_, (value,) * width(type_))


def _is_split(node: Node) -> bool:
    """True if a constant vector is joined lane by lane: ``vec3(0.8)`` is shorter as it is."""
    if node.op != "constant" or not isinstance(node.type, Vector):
        return False
    return node.type.size == 2 or uniform_lane(node) is None


@condition("some constant among {} is joined lane by lane")
def _has_split(_builder: Builder, _type: Type, parts: tuple[Node, ...]) -> bool:
    return any(map(_is_split, parts))


@computed
def _joined_by_lanes(builder: Builder, type_: Type, parts: tuple[Node, ...]) -> Node:
    scalars = tuple(scalar for part in parts for scalar in _scalars(builder, part))
    return builder.make("vector", type_, scalars)


def _scalars(b: Builder, node: Node) -> Iterable[Node]:
    kind = scalar_kind(node.type)
    if kind is None or not _is_split(node):
        return (node,)
    return (build.constant(b.graph, Scalar(kind), v) for v in constant_lanes(node.type, node.data))


# --- constant lanes of vectors that are not constant as a whole ----------------------------------


@computed
def _computed_lanes(
    builder: Builder, type_: Type, source: Node, picked: tuple[int, ...]
) -> Node | None:
    """Lanes of an operation whose operands are constant in these lanes."""
    values: list[Number] = []
    for lane in picked:
        value = _lane(source, lane, DEEPEST)
        if value is None:
            return None
        values.append(value)
    return constant_of(builder, type_, tuple(values))


def _lane(node: Node, lane: int, depth: int) -> Number | None:
    """The value of one lane, if it is constant; recurses into so many operations.

    A scalar stands for a vector with this number in every lane.
    """
    lane = lane if isinstance(node.type, Vector) else 0
    if node.op == "constant" and not isinstance(node.type, Matrix):
        value: Number = constant_lanes(node.type, node.data)[lane]
        return value
    if not depth:
        return None
    match node.op:
        case "splat":
            return _lane(node.operands[0], 0, depth - 1)
        case "swizzle":
            return _lane(node.operands[0], SWIZZLE.data(node)[lane], depth - 1)
        case "vector":
            for part in node.operands:
                if lane < width(part.type):
                    return _lane(part, lane, depth - 1)
                lane -= width(part.type)
            return None
        case "call" if CALL.data(node) in _LANEWISE:
            return _lane_of_call(node, lane, depth)
        case _:
            return None


def _lane_of_call(node: Node, lane: int, depth: int) -> Number | None:
    if any(isinstance(operand.type, Matrix) for operand in node.operands):
        return None
    operands: list[Lanes] = []
    for operand in node.operands:
        is_scalar = isinstance(operand.type, Scalar)  # A scalar has this value in every lane.
        value = _lane(operand, 0 if is_scalar else lane, depth - 1)
        if value is None:
            return None
        operands.append((value,))
    result: Number = _contained(apply(node, operands)[0])
    return result


_BUILTIN = function(*BUILTINS)
_CONSTANTS = Several("cs", every=CONSTANT | {HEADS["matrix"]})
_LANEWISE_VALUE = Variable("x", frozenset(_LANEWISE))
_PARTS = Several("xs", some=CONSTANT)

FOLDING = (
    Rule("constants", _BUILTIN(_CONSTANTS), _value(_BUILTIN, _CONSTANTS),
         "A builtin of constants is the constant that the reference computes.",
         where=_is_foldable(_BUILTIN, _CONSTANTS)),
    Rule("lanes of a constant", swizzle[lanes](c), _picked(c, lanes),
         "Lanes of a constant are a constant."),
    Rule("constant lanes", swizzle[lanes](_LANEWISE_VALUE), _computed_lanes(_LANEWISE_VALUE, lanes),
         "Lanes of an operation are constant if they are so in all operands."),
    Rule("constants joined", vector(cs), _joined(cs), "Constants, joined, are a constant."),
    Rule("constants one by one", vector(_PARTS), _joined_by_lanes(_PARTS),
         "Constant lanes are joined one by one, as they are written.", where=_has_split(_PARTS)),
    Rule("constant filled in", splat(c), _filled(c),
         "A vector filled with a constant is a constant."),
)  # fmt: skip

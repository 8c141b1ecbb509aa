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
from ...ir.build import Number
from ...ir.node import Node
from ...ir.operations import CALL, SWIZZLE
from ...ir.types import Matrix, Scalar, Type, Vector, scalar_kind, width
from ...reference.namespace import Lanes
from ...reference.operations import apply, constant_lanes
from .rule import (
    ANY,
    CONSTANT,
    Builder,
    Rule,
    Site,
    builtin,
    made,
    swizzled_lanes,
    uniform_lane,
)

DEEPEST = 4
"""So many operations are looked through for the value of a single lane."""

_LANEWISE = (
    "add", "sub", "mul", "div", "mod", "neg", "abs", "min", "max", "clamp", "saturate", "mix",
    "step", "smoothstep", "pow", "sqrt",
)  # fmt: skip
"""The builtins, computed lane by lane, through which single constant lanes are followed."""


# --- operations whose operands are all constant --------------------------------------------------


def _is_foldable(_b: Builder, at: Site) -> bool:
    row = BUILTINS[str(at.data)]
    is_number = isinstance(at.type, Scalar | Vector | Matrix)
    return is_number and not row.uniform_control_flow and all(map(_is_constant, at.operands))


def _is_constant(node: Node) -> bool:
    """Whether an operand is a constant; a matrix is made of constant columns."""
    return node.op == "constant" or all(column.op == "constant" for column in node.operands)


def _folded(b: Builder, at: Site) -> Node:
    """The value of a builtin of constants."""
    call = b.graph.node("call", at.type, at.operands, at.data)
    return constant_of(b, at.type, apply(call, list(map(_lanes_of, at.operands))))


def _lanes_of(node: Node) -> Lanes:
    if node.op == "constant":
        return constant_lanes(node.type, node.data)
    return tuple(constant_lanes(column.type, column.data) for column in node.operands)


def constant_of(b: Builder, type_: Type, values: Lanes) -> Node:
    """What was computed, as a constant that float32 holds; of a matrix, its columns.

    Overflow is outside of what programs mean, but every compiler has to take the text: Tint and
    naga refuse constants beyond the largest number, and an expression that comes to one.
    """
    if isinstance(type_, Matrix):
        column = Vector("float", type_.size)
        columns = tuple(constant_of(b, column, value) for value in values)
        return b.make("matrix", type_, columns)
    lanes = tuple(map(_contained, values))
    return build.constant(b.graph, type_, lanes if isinstance(type_, Vector) else lanes[0])


def _contained(value: Number) -> Number:
    """The nearest number that float32 holds; where infinities have made a NaN, zero."""
    if not isinstance(value, float):
        return value
    return 0.0 if isnan(value) else min(max(value, -LARGEST_FLOAT), LARGEST_FLOAT)


# --- joining constants, and taking parts of them -------------------------------------------------


def _picked_constant(b: Builder, at: Site) -> Node:
    (source,) = at.operands
    values = constant_lanes(source.type, source.data)
    return constant_of(b, at.type, tuple(values[lane] for lane in swizzled_lanes(at)))


def _joined_constants(b: Builder, at: Site) -> Node:
    values = (constant_lanes(each.type, each.data) for each in at.operands)
    return constant_of(b, at.type, tuple(lane for part in values for lane in part))


def _filled_constant(b: Builder, at: Site) -> Node:
    (value,) = constant_lanes(at.operands[0].type, at.operands[0].data)
    return constant_of(b, at.type, (value,) * width(at.type))


def _is_split(node: Node) -> bool:
    """Whether a constant vector is joined lane by lane: ``vec3(0.8)`` is shorter as it is."""
    if node.op != "constant" or not isinstance(node.type, Vector):
        return False
    return node.type.size == 2 or uniform_lane(node) is None


def _has_split(_b: Builder, at: Site) -> bool:
    return any(map(_is_split, at.operands))


def _joined_by_lanes(b: Builder, at: Site) -> Node:
    parts = tuple(part for operand in at.operands for part in _scalars(b, operand))
    return b.make("vector", at.type, parts)


def _scalars(b: Builder, node: Node) -> Iterable[Node]:
    kind = scalar_kind(node.type)
    if kind is None or not _is_split(node):
        return (node,)
    return (build.constant(b.graph, Scalar(kind), v) for v in constant_lanes(node.type, node.data))


# --- constant lanes of vectors that are not constant as a whole ----------------------------------


def _computed_lanes(b: Builder, at: Site) -> Node | None:
    """Lanes of an operation whose operands are constant in these lanes."""
    (source,) = at.operands
    values: list[Number] = []
    for lane in swizzled_lanes(at):
        value = _lane(source, lane, DEEPEST)
        if value is None:
            return None
        values.append(value)
    return constant_of(b, at.type, tuple(values))


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
        is_scalar = isinstance(operand.type, Scalar)  # It counts for every lane.
        value = _lane(operand, 0 if is_scalar else lane, depth - 1)
        if value is None:
            return None
        operands.append((value,))
    result: Number = _contained(apply(node, operands)[0])
    return result


FOLDING = (
    Rule("constants", "A builtin of constants is the constant that the reference computes.",
         ("*",), made("constant", "matrix"), _folded, _is_foldable),
    Rule("lanes of a constant", "Lanes of a constant are a constant.",
         (".swizzle",), (CONSTANT,), _picked_constant),
    Rule("constant lanes", "Lanes of an operation are constant if they are so in all operands.",
         (".swizzle",), (builtin(*_LANEWISE),), _computed_lanes),
    Rule("constants joined", "Constants, joined, are a constant.",
         (".vector",), CONSTANT, _joined_constants),
    Rule("constants one by one", "Constant lanes are joined one by one, as they are written.",
         (".vector",), ANY, _joined_by_lanes, _has_split, some=CONSTANT),
    Rule("constant filled in", "A vector filled with a constant is a constant.",
         (".splat",), (CONSTANT,), _filled_constant),
)  # fmt: skip

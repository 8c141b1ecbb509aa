"""Simplification rules of single builtins: neutral operands, known ranges, equal operands.

Rules hold for finite operands; that is what "finite in, finite out" is for. The sign of a zero is
no part of the meaning.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from ..ir import build
from ..ir.node import Node, Op
from ..ir.operations import builtin_of
from ..ir.refinements import OPPOSITES
from ..ir.types import Matrix, Scalar, Type, Vector, scalar_kind
from ..reference.operations import constant_lanes

if TYPE_CHECKING:
    from .simplify import Simplifier

BuiltinRule = Callable[["Simplifier", Op, Type, tuple[Node, ...]], Node | None]


def uniform_lane(node: Node) -> float | int | bool | None:
    """The value in every lane of a constant, if they are all the same."""
    if node.op != "constant" or isinstance(node.type, Matrix):
        return None
    lanes = constant_lanes(node.type, node.data)
    first: float | int | bool = lanes[0]
    return first if all(lane == first for lane in lanes) else None


def _is_call(node: Node, name: str) -> bool:
    return builtin_of(node) == name


def _fits(s: Simplifier, node: Node, type_: Type) -> Node | None:
    """An operand as the whole result: itself, or a scalar in every lane."""
    if node.type == type_:
        return node
    if isinstance(node.type, Scalar) and isinstance(type_, Vector):
        return s.make("splat", type_, (node,))
    return None


_OF_EQUAL_LANES = ("splat", "constant")
"""What may be a vector of equal lanes."""


def _scalar_form(s: Simplifier, name: str, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    """Arithmetic with equal lanes as arithmetic with a scalar."""
    if not isinstance(type_, Vector) or not any(o.op in _OF_EQUAL_LANES for o in operands):
        return None
    lanes = [_equal_lane(s, operand) for operand in operands]
    if all(lane is not None for lane in lanes):
        scalar = s.call(name, Scalar(type_.kind), *[lane for lane in lanes if lane is not None])
        return s.make("splat", type_, (scalar,))
    changed = [
        lane if lane is not None and isinstance(operand.type, Vector) else operand
        for lane, operand in zip(lanes, operands, strict=True)
    ]
    if changed == list(operands):
        return None
    return s.call(name, type_, *changed)


def _equal_lane(s: Simplifier, node: Node) -> Node | None:
    """The scalar that fills every lane of ``node``, if one does."""
    if isinstance(node.type, Scalar):
        return node
    if node.op == "splat":
        return node.operands[0]
    value = uniform_lane(node)
    kind = scalar_kind(node.type)
    if value is None or kind is None:
        return None
    return build.constant(s.graph, Scalar(kind), value)


def _add(s: Simplifier, op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    left, right = operands
    if uniform_lane(left) == 0:
        return _fits(s, right, type_)
    if uniform_lane(right) == 0:
        return _fits(s, left, type_)
    if _is_call(right, "neg") and right.type == type_:
        return s.call("sub", type_, left, right.operands[0])
    if op != "call":
        return None
    return _factored(s, type_, left, right) or _scalar_form(s, "add", type_, operands)


def _factored(s: Simplifier, type_: Type, left: Node, right: Node) -> Node | None:
    """``a * x + b * x`` as ``(a + b) * x``: one product less.

    The factor has the type of the sum, so that no scalar part of a product is parted from it.
    """
    if not (_is_call(left, "mul") and _is_call(right, "mul")) or isinstance(type_, Matrix):
        return None
    common = [o for o in left.operands if o in right.operands and o.type == type_]
    if not common or scalar_kind(type_) != "float" or _has_matrix(left) or _has_matrix(right):
        return None
    rests = [_other(product, common[0]) for product in (left, right)]
    if not all(rest.type == type_ for rest in rests):
        return None
    return s.call("mul", type_, s.call("add", type_, *rests), common[0])


def _other(product: Node, factor: Node) -> Node:
    left, right = product.operands
    return right if left is factor else left


def _has_matrix(node: Node) -> bool:
    return any(isinstance(operand.type, Matrix) for operand in node.operands)


def _sub(s: Simplifier, op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    left, right = operands
    if uniform_lane(right) == 0:
        return _fits(s, left, type_)
    if uniform_lane(left) == 0 and scalar_kind(type_) != "uint":
        fitted = _fits(s, right, type_)
        return None if fitted is None else s.call("neg", type_, fitted)
    if left is right and not isinstance(type_, Matrix):
        return s.constant(type_, 0)
    return _scalar_form(s, "sub", type_, operands) if op == "call" else None


def _mul(s: Simplifier, op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    left, right = operands
    if isinstance(type_, Matrix) or any(isinstance(o.type, Matrix) for o in operands):
        return None
    for one, other in ((left, right), (right, left)):
        value = uniform_lane(one)
        if value == 0:
            return s.constant(type_, 0)
        if value == 1:
            return _fits(s, other, type_)
        if value == -1 and (fitted := _fits(s, other, type_)) is not None:
            return s.call("neg", type_, fitted)
    return _scalar_form(s, "mul", type_, operands) if op == "call" else None


def _div(s: Simplifier, op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    left, right = operands
    if isinstance(type_, Matrix):
        return None
    if uniform_lane(right) == 1:
        return _fits(s, left, type_)
    if uniform_lane(left) == 0 and scalar_kind(type_) == "float":
        return s.constant(type_, 0)
    return _scalar_form(s, "div", type_, operands) if op == "call" else None


def _neg(_s: Simplifier, _op: Op, _type: Type, operands: tuple[Node, ...]) -> Node | None:
    (operand,) = operands
    return operand.operands[0] if _is_call(operand, "neg") else None


def _min(s: Simplifier, _op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    x, y = operands
    fx, fy = s.ranges.of(x), s.ranges.of(y)
    if fx.hi <= fy.lo:
        return _fits(s, x, type_)
    return _fits(s, y, type_) if fy.hi <= fx.lo else None


def _max(s: Simplifier, _op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    x, y = operands
    fx, fy = s.ranges.of(x), s.ranges.of(y)
    if fx.lo >= fy.hi:
        return _fits(s, x, type_)
    return _fits(s, y, type_) if fy.lo >= fx.hi else None


def _clamp(s: Simplifier, _op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    x, low, high = operands
    if s.ranges.of(x).within(s.ranges.of(low).hi, s.ranges.of(high).lo):
        return _fits(s, x, type_)
    if (
        scalar_kind(type_) == "float"
        and (uniform_lane(low), uniform_lane(high)) == (0, 1)
        and x.type == type_
    ):
        return s.call("saturate", type_, x)
    return None


def _saturate(s: Simplifier, _op: Op, _type: Type, operands: tuple[Node, ...]) -> Node | None:
    return operands[0] if s.ranges.of(operands[0]).within(0.0, 1.0) else None


def _abs(s: Simplifier, _op: Op, _type: Type, operands: tuple[Node, ...]) -> Node | None:
    return operands[0] if s.ranges.of(operands[0]).lo >= 0 else None


def _normalize(s: Simplifier, _op: Op, _type: Type, operands: tuple[Node, ...]) -> Node | None:
    """Normalising what is known to be of unit length costs nothing."""
    return operands[0] if s.ranges.of(operands[0]).unit else None


def _pow(s: Simplifier, _op: Op, _type: Type, operands: tuple[Node, ...]) -> Node | None:
    base, exponent = operands
    return base if uniform_lane(exponent) == 1 and s.ranges.of(base).lo >= 0 else None


def _transpose(s: Simplifier, _op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    """Two transposes cancel, whatever scalar stands between them."""
    (operand,) = operands
    if _is_call(operand, "transpose"):
        return operand.operands[0]
    if not _is_call(operand, "mul") or not isinstance(operand.operands[1].type, Scalar):
        return None
    matrix, factor = operand.operands
    return (
        s.call("mul", type_, matrix.operands[0], factor) if _is_call(matrix, "transpose") else None
    )


def _comparison(decide: Callable[[Simplifier, Node, Node], bool | None]) -> BuiltinRule:
    def rule(s: Simplifier, _op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
        left, right = operands
        decided = decide(s, left, right)
        return None if decided is None else s.constant(type_, decided)

    return rule


def _below(s: Simplifier, left: Node, right: Node) -> bool | None:
    """Whether ``left < right``, where the ranges decide it."""
    if s.ranges.of(left).hi < s.ranges.of(right).lo:
        return True
    return False if s.ranges.of(left).lo >= s.ranges.of(right).hi else None


def _at_most(s: Simplifier, left: Node, right: Node) -> bool | None:
    above = _below(s, right, left)
    return None if above is None else not above


def _equal(s: Simplifier, left: Node, right: Node) -> bool | None:
    if left is right:
        return True
    fl, fr = s.ranges.of(left), s.ranges.of(right)
    return False if fl.hi < fr.lo or fr.hi < fl.lo else None


def _negated(decide: Callable[[Simplifier, Node, Node], bool | None]) -> BuiltinRule:
    def opposite(s: Simplifier, left: Node, right: Node) -> bool | None:
        decided = decide(s, left, right)
        return None if decided is None else not decided

    return _comparison(opposite)


def _equality(decide: BuiltinRule, same: bool) -> BuiltinRule:
    """``==`` (``same``) and ``!=``: a truth beside a constant is itself, or its opposite."""

    def rule(s: Simplifier, op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
        for one, other in (operands, operands[::-1]):
            truth = uniform_lane(one)
            if isinstance(truth, bool) and other.type == type_:
                return other if truth is same else s.make(op, type_, (other,), "not")
        return decide(s, op, type_, operands)

    return rule


def _not(s: Simplifier, op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    (operand,) = operands
    if _is_call(operand, "not"):
        return operand.operands[0]
    if operand.op == op and operand.data in OPPOSITES:
        return s.make(op, type_, operand.operands, OPPOSITES[str(operand.data)])
    return None


def _connective(absorbing: bool) -> BuiltinRule:
    """``and`` (absorbed by false) and ``or`` (absorbed by true)."""

    def rule(s: Simplifier, _op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
        left, right = operands
        for one, other in ((left, right), (right, left)):
            lane = uniform_lane(one)
            if lane is not None:
                return s.constant(type_, absorbing) if lane is absorbing else other
        return left if left is right else None

    return rule


BUILTIN_RULES: Mapping[str, BuiltinRule] = {
    "add": _add,
    "sub": _sub,
    "mul": _mul,
    "div": _div,
    "neg": _neg,
    "min": _min,
    "max": _max,
    "clamp": _clamp,
    "saturate": _saturate,
    "abs": _abs,
    "normalize": _normalize,
    "pow": _pow,
    "transpose": _transpose,
    "lt": _comparison(_below),
    "ge": _negated(_below),
    "le": _comparison(_at_most),
    "gt": _negated(_at_most),
    "eq": _equality(_comparison(_equal), True),
    "ne": _equality(_negated(_equal), False),
    "not": _not,
    "and": _connective(False),
    "or": _connective(True),
}

DECIDED = frozenset(
    ("min", "max", "clamp", "saturate", "abs", "normalize", "lt", "ge", "le", "gt", "eq", "ne")
)
"""Builtins whose rules leave the operation away where ranges show what it comes to."""

"""Simplification rules of bits and lane-wise choices."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ..ir.node import Node, Op
from ..ir.operations import builtin_of
from ..ir.types import Scalar, Type, scalar_kind, width, with_width
from .arithmetic import BuiltinRule, uniform_lane

if TYPE_CHECKING:
    from .simplify import Simplifier


def _all_set(type_: Type) -> int:
    """The value with every bit set."""
    return -1 if scalar_kind(type_) == "int" else 2**32 - 1


def _and(s: Simplifier, _op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    left, right = operands
    for one, other in ((left, right), (right, left)):
        lane = uniform_lane(one)
        if lane == 0:
            return s.constant(type_, 0)
        if lane == _all_set(type_):
            return other
    return left if left is right else None


def _or(_s: Simplifier, _op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    left, right = operands
    for one, other in ((left, right), (right, left)):
        lane = uniform_lane(one)
        if lane == 0:
            return other
        if lane == _all_set(type_):
            return one
    return left if left is right else None


def _xor(s: Simplifier, _op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    left, right = operands
    for one, other in ((left, right), (right, left)):
        lane = uniform_lane(one)
        if lane == 0:
            return other
        if lane == _all_set(type_):
            return s.call("bit_not", type_, other)
    return s.constant(type_, 0) if left is right else None


def _twice(name: str) -> BuiltinRule:
    """A function that undoes itself."""

    def rule(_s: Simplifier, _op: Op, _type: Type, operands: tuple[Node, ...]) -> Node | None:
        (operand,) = operands
        return operand.operands[0] if builtin_of(operand) == name else None

    return rule


def _shift(name: str) -> BuiltinRule:
    """A constant amount becomes the `uint` below 32 by which every backend shifts."""

    def rule(s: Simplifier, op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
        shifted, amount = operands
        if uniform_lane(shifted) == 0:
            return s.constant(type_, 0)
        by = uniform_lane(amount)
        if by is None:
            return None
        if by % 32 == 0:
            return shifted
        if 0 < by < 32 and scalar_kind(amount.type) == "uint":
            return None
        lanes = with_width("uint", width(amount.type))
        return s.make(op, type_, (shifted, s.constant(lanes, by % 32)), name)

    return rule


def _choose(s: Simplifier, _op: Op, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    """A choice by one condition is a selection, or none."""
    condition, then, otherwise = operands
    decided = uniform_lane(condition)
    if decided is not None:
        return then if decided else otherwise
    if then is otherwise:
        return then
    if isinstance(condition.type, Scalar):
        return s.make("select", type_, operands)
    return None


BIT_RULES: Mapping[str, BuiltinRule] = {
    "bit_and": _and,
    "bit_or": _or,
    "bit_xor": _xor,
    "bit_not": _twice("bit_not"),
    "reverse_bits": _twice("reverse_bits"),
    "shift_left": _shift("shift_left"),
    "shift_right": _shift("shift_right"),
    "choose": _choose,
}

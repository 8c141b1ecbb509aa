"""The value of one operation for the values of its operands."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import Any

from ..ir.node import Node, Op
from ..ir.operations import CALL, MEMBER, SWIZZLE
from ..ir.types import Array, Matrix, Scalar, Struct, TallMatrix, Type, Vector, scalar_kind
from . import scalars
from .functions import evaluate as builtin
from .namespace import Lane, Lanes, Namespace


class NotConstantError(Exception):
    """The graph has a leaf without a value."""

    def __init__(self, node: Node) -> None:
        super().__init__(f"{node} has no value")
        self.node = node


def apply(node: Node, operands: list[Lanes], xp: Namespace = scalars) -> Lanes:
    """The value of an operation that neither binds variables nor is a leaf without a value.

    The value of an array is the tuple of its elements', that of a struct the tuple of its members'.
    """
    step = _STEPS.get(node.op)
    if step is None:
        raise NotConstantError(node)
    return step(node, operands, xp)


def constant_lanes(type_: Type, data: Any) -> Lanes:
    """A constant node's data as lanes."""
    if isinstance(type_, Scalar):
        return (data,)
    return tuple(data)


def chosen(xp: Namespace, condition: Lane, then: Any, otherwise: Any) -> Any:
    """``then`` where the condition holds, else ``otherwise``; of values of any one type."""
    if isinstance(condition, bool):
        return then if condition else otherwise
    if isinstance(then, tuple):
        pairs = zip(then, otherwise, strict=True)
        return tuple(chosen(xp, condition, a, b) for a, b in pairs)
    return xp.where(condition, then, otherwise)


def _constant(node: Node, _operands: list[Lanes], _xp: Namespace) -> Lanes:
    return constant_lanes(node.type, node.data)


def _call(node: Node, operands: list[Lanes], xp: Namespace) -> Lanes:
    kind = scalar_kind(node.operands[0].type)
    return builtin(CALL.data(node), operands, xp, kind or "float")


def _vector(_node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    return tuple(lane for operand in operands for lane in operand)


def _splat(node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    assert isinstance(node.type, Vector)
    return operands[0] * node.type.size


def _joined(_node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    """Columns, members or elements."""
    return tuple(operands)


def _swizzle(node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    return tuple(operands[0][lane] for lane in SWIZZLE.data(node))


def _index(node: Node, operands: list[Lanes], xp: Namespace) -> Lanes:
    aggregate, (position,) = operands
    parts = aggregate
    if not isinstance(node.operands[0].type, Matrix | TallMatrix | Array):
        parts = tuple((lane,) for lane in aggregate)
    part: Lanes = _at(parts, position, xp)
    return part


def _at(parts: Lanes, position: Lane, xp: Namespace) -> Any:
    """The part at a position; many positions, in an array, take each their own."""
    try:
        return parts[operator.index(position)]
    except TypeError:
        found = parts[0]
        for i, part in enumerate(parts[1:], start=1):
            found = chosen(xp, position == i, part, found)
        return found


def _member(node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    struct = node.operands[0].type
    assert isinstance(struct, Struct)
    names = [name for name, _ in struct.members]
    member: Lanes = operands[0][names.index(MEMBER.data(node))]
    return member


def _select(_node: Node, operands: list[Lanes], xp: Namespace) -> Lanes:
    (condition,), then, otherwise = operands
    selected: Lanes = chosen(xp, condition, then, otherwise)
    return selected


def _interpolate(_node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    """What all vertices agree on."""
    return operands[0]


def _marked(_node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    """Semantics evaluates constants while meanings and calls are still noted in the graph."""
    return operands[0]


_STEPS: Mapping[Op, Callable[[Node, list[Lanes], Namespace], Lanes]] = {
    "constant": _constant,
    "call": _call,
    "native": _call,
    "vector": _vector,
    "splat": _splat,
    "matrix": _joined,
    "struct": _joined,
    "array": _joined,
    "swizzle": _swizzle,
    "index": _index,
    "member": _member,
    "select": _select,
    "interpolate": _interpolate,
    "as": _marked,
    "called": _marked,
}
"""A ``native`` is only used where the hardware agrees with the builtin's meaning."""

"""Computes the value of one operation from the values of its operands; ``evaluate.py`` calls it."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

from ..ir.node import Node, Op
from ..ir.operations import CALL, MEMBER, SWIZZLE, joins_group
from ..ir.types import (
    Array,
    Matrix,
    RuntimeArray,
    Scalar,
    Struct,
    Type,
    Vector,
    scalar_kind,
)
from . import scalars
from .namespace import Lane, Lanes, Namespace, WorkGroups

if TYPE_CHECKING:
    from .functions import LaneKind


class NotConstantError(Exception):
    """The graph has a leaf without a value, so it is no constant.

    It may also join values that are not at hand.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(f"{node} has no value")
        self.node = node


def apply(node: Node, operands: list[Lanes], xp: Namespace = scalars) -> Lanes:
    """The value of an operation that binds no variables. Raises ``NotConstantError`` for a leaf.

    The value of an array is the tuple of its elements, and that of a struct the tuple of its
    members.
    """
    step = _STEPS.get(node.op)
    if step is None:
        raise NotConstantError(node)
    return step(node, operands, xp)


def constant_lanes(type_: Type, data: Any) -> Lanes:
    """The data of a constant node as lanes."""
    if isinstance(type_, Scalar):
        return (data,)
    return tuple(data)


def chosen(xp: Namespace, condition: Lane, then: Any, otherwise: Any) -> Any:
    """``then`` where the condition holds, else ``otherwise``; both are values of the same type."""
    if isinstance(condition, bool):
        return then if condition else otherwise
    if isinstance(then, tuple):
        pairs = zip(then, otherwise, strict=True)
        return tuple(chosen(xp, condition, a, b) for a, b in pairs)
    return xp.where(condition, then, otherwise)


def _constant(node: Node, _operands: list[Lanes], _xp: Namespace) -> Lanes:
    return constant_lanes(node.type, node.data)


@cache
def builtins() -> Callable[[str, Sequence[Lanes], Namespace, LaneKind], Lanes]:
    """The function that evaluates a builtin by name.

    Its table is loaded with ten modules when it is first asked for: most compiles only fold
    operations of the graph.
    """
    from .functions import evaluate

    return evaluate


def _call(node: Node, operands: list[Lanes], xp: Namespace) -> Lanes:
    if joins_group(node) and not isinstance(xp, WorkGroups):
        raise NotConstantError(node)
    kind = scalar_kind(node.operands[0].type)
    return builtins()(CALL.data(node), operands, xp, kind or "float")


def _vector(_node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    return tuple(lane for operand in operands for lane in operand)


def _splat(node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    assert isinstance(node.type, Vector)
    return operands[0] * node.type.size


def _joined(_node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    """The columns of a matrix, the members of a struct or the elements of an array."""
    return tuple(operands)


def _swizzle(node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    return tuple(operands[0][lane] for lane in SWIZZLE.data(node))


def _index(node: Node, operands: list[Lanes], xp: Namespace) -> Lanes:
    aggregate, (position,) = operands
    if isinstance(node.operands[0].type, RuntimeArray):
        element: Lanes = aggregate[0].element(position)
        return element
    parts = aggregate
    if not isinstance(node.operands[0].type, Matrix | Array):
        parts = tuple((lane,) for lane in aggregate)
    part: Lanes = _at(parts, position, xp)
    return part


def _at(parts: Lanes, position: Lane, xp: Namespace) -> Any:
    """The part at a position; if the position is an array, each element chooses its own part."""
    try:
        return parts[operator.index(position)]
    except TypeError:
        return _each_chosen(parts, position, xp, [])


def _each_chosen(parts: Lanes, position: Lane, xp: Namespace, conditions: list[Lane]) -> Any:
    """The part that each element of an array of positions chooses, lane by lane.

    The lanes share the ``conditions`` under which each part but the first is chosen, once they are
    needed.
    """
    if isinstance(parts[0], tuple):
        lanes = zip(*parts, strict=True)
        return tuple(_each_chosen(each, position, xp, conditions) for each in lanes)
    if hasattr(position, "ndim"):  # It is an array, so NumPy is loaded.
        from .tables import in_table

        found = in_table(parts, position)
        if found is not None:
            return found
    if not conditions:
        conditions += [position == i for i in range(1, len(parts))]
    found = parts[0]
    for condition, part in zip(conditions, parts[1:], strict=True):
        found = chosen(xp, condition, part, found)
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


def _cross(_node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    """The value of a crossing without a value of its own: the same at all vertices."""
    return operands[0]


def _marked(_node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    """Marks do not change values; semantics evaluates constants while the graph still has marks."""
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
    "cross": _cross,
    "as": _marked,
    "called": _marked,
}
"""Passes use ``native`` only where the hardware has the builtin's meaning."""

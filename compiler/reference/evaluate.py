"""The value of a graph whose leaves are known."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..ir.node import Node, reachable
from ..ir.types import Matrix, Scalar, Type, Vector, scalar_kind
from . import scalars
from .functions import evaluate as builtin
from .namespace import Lanes, Namespace

Leaves = Mapping[int, Lanes]
"""Values of leaves by node id."""


class NotConstantError(Exception):
    """The graph has a leaf without a value."""

    def __init__(self, node: Node) -> None:
        super().__init__(f"{node} has no value")
        self.node = node


def evaluate(root: Node, leaves: Leaves | None = None, xp: Namespace = scalars) -> Lanes:
    """The lanes of ``root`` (a matrix: its columns), in float64; binders do not occur in it.

    Raises ``NotConstantError`` at a leaf that is neither a constant nor in ``leaves``.
    """
    values: dict[int, Lanes] = dict(leaves or {})
    for node in reachable((root,)):
        if node.id not in values:
            values[node.id] = apply(node, [values[operand.id] for operand in node.operands], xp)
    return values[root.id]


def apply(node: Node, operands: list[Lanes], xp: Namespace = scalars) -> Lanes:
    """The value of one operation for the values of its operands."""
    step = _STEPS.get(node.op)
    if step is None:
        raise NotConstantError(node)
    return step(node, operands, xp)


def constant_lanes(type_: Type, data: Any) -> Lanes:
    """A constant node's data as lanes."""
    if isinstance(type_, Scalar):
        return (data,)
    return tuple(data)


def _constant(node: Node, _operands: list[Lanes], _xp: Namespace) -> Lanes:
    return constant_lanes(node.type, node.data)


def _call(node: Node, operands: list[Lanes], xp: Namespace) -> Lanes:
    kind = scalar_kind(node.operands[0].type)
    return builtin(str(node.data), operands, xp, kind or "float")


def _vector(_node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    return tuple(lane for operand in operands for lane in operand)


def _splat(node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    assert isinstance(node.type, Vector)
    return operands[0] * node.type.size


def _matrix(_node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    return tuple(operands)


def _swizzle(node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    assert isinstance(node.data, tuple)
    return tuple(operands[0][lane] for lane in node.data)


def _index(node: Node, operands: list[Lanes], _xp: Namespace) -> Lanes:
    aggregate, (position,) = operands
    element = aggregate[int(position)]
    return element if isinstance(node.operands[0].type, Matrix) else (element,)


def _select(_node: Node, operands: list[Lanes], xp: Namespace) -> Lanes:
    (condition,), then, otherwise = operands
    if then and isinstance(then[0], tuple):
        return tuple(
            tuple(xp.where(condition, a, b) for a, b in zip(*columns, strict=True))
            for columns in zip(then, otherwise, strict=True)
        )
    return tuple(xp.where(condition, a, b) for a, b in zip(then, otherwise, strict=True))


_STEPS: Mapping[str, Callable[[Node, list[Lanes], Namespace], Lanes]] = {
    "constant": _constant,
    "call": _call,
    "vector": _vector,
    "splat": _splat,
    "matrix": _matrix,
    "swizzle": _swizzle,
    "index": _index,
    "select": _select,
}

"""Finds the floats that are whole numbers, by the way in which they are computed."""

from __future__ import annotations

from ...ir.node import Node
from ...ir.operations import builtin_of
from ...ir.types import Type
from .builder import Builder, uniform_lane
from .terms import Heads, condition

_ROUNDED = frozenset({"floor", "ceil", "round", "trunc", "sign", "step", "to_float"})
"""Builtins whose results are whole; conversions to floats are of integers and bools."""
_KEEPING = frozenset({"add", "sub", "mul", "neg", "abs", "min", "max"})
"""Builtins that make whole numbers of whole numbers."""
MAY_BE_WHOLE: Heads = _ROUNDED | _KEEPING
"""The heads of values that are worth a closer look by ``is_whole_number``."""
_MOVING = frozenset({"splat", "swizzle", "vector"})
"""Operations that only move lanes."""
_MOST = 16
"""Values that are looked at."""


@condition("{} is a whole number")
def is_whole_number(_builder: Builder, _type: Type, value: Node) -> bool:
    """True if every lane of a float is certainly a whole number."""
    pending, seen = [value], set[int]()
    while pending:
        node = pending.pop()
        if node.id in seen:
            continue
        seen.add(node.id)
        if len(seen) > _MOST:
            return False
        if node.op == "constant":
            number = uniform_lane(node)
            if number is None or number != int(number):
                return False
        elif builtin_of(node) in _KEEPING or node.op in _MOVING:
            pending += node.operands
        elif builtin_of(node) not in _ROUNDED:
            return False
    return True

"""Interval arithmetic for the range rules of builtins.

Bounds must hold for the float32 value that a device computes, not only for the exact value, because
guards are left out on their account. So all bounds are moved outward, by the operation's error on
the platform that promises least (``weakest.py``), since one analysis serves all targets. Rounding
never changes an order, so a bound that float32 represents exactly stays unchanged. Zero stays
unchanged too: no error that is relative to a result changes its sign.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable

from .facts import SMALLEST_NORMAL, Fact
from .weakest import ROUNDING


def rounded(lo: float, hi: float) -> Fact:
    """The float32 interval around [lo, hi], if a single rounding is the only error."""
    return Fact(_rounded(lo, -1.0), _rounded(hi, 1.0))


def _rounded(bound: float, direction: float) -> float:
    is_exact = abs(bound) >= SMALLEST_NORMAL and _is_float32(bound)
    return bound if is_exact else _moved(bound, direction, ROUNDING)


def inexact(lo: float, hi: float, error: float, error_at_hi: float | None = None) -> Fact:
    """The float32 interval around [lo, hi], if results are off by this part of them.

    Where it depends on the operand how much that is, it may be another part at the upper bound.
    """
    other = error if error_at_hi is None else error_at_hi
    return Fact(_moved(lo, -1.0, error), _moved(hi, 1.0, other))


def _moved(bound: float, direction: float, error: float) -> float:
    if math.isnan(bound):
        return direction * math.inf
    if bound == 0 or math.isinf(bound):
        return bound
    if abs(bound) < SMALLEST_NORMAL:
        return direction * SMALLEST_NORMAL if bound * direction > 0 else 0.0
    return bound + direction * abs(bound) * error


def _is_float32(value: float) -> bool:
    try:
        rounded: float = struct.unpack("f", struct.pack("f", value))[0]
    except OverflowError:
        return False
    return rounded == value


def monotone(function: Callable[[float], float], fact: Fact) -> Fact:
    """The image of an interval under a function that never decreases, and rounds its result."""
    return rounded(function(fact.lo), function(fact.hi))


def product(x: float, y: float) -> float:
    """``x * y`` for two bounds, where an infinite bound means that finite operands may be large."""
    return 0.0 if x == 0 or y == 0 else x * y


def products(x: Fact, y: Fact) -> tuple[float, float]:
    """The least and the greatest product of a value of each interval."""
    corners = [product(a, b) for a in (x.lo, x.hi) for b in (y.lo, y.hi)]
    return min(corners), max(corners)


def squares(x: Fact) -> tuple[float, float]:
    """The least and the greatest square of a value of the interval."""
    return product(x.least, x.least), product(x.most, x.most)


def quotients(x: Fact, y: Fact, smallest: float, largest: float) -> list[float]:
    """Bounds of ``x / y`` for every ``y`` whose magnitude is in ``smallest`` to ``largest``."""
    corners: list[float] = []
    for lo, hi in (
        (max(y.lo, -largest), min(y.hi, -smallest)),
        (max(y.lo, smallest), min(y.hi, largest)),
    ):
        if lo <= hi:
            corners += [_quotient(a, b) for a in (x.lo, x.hi) for b in (lo, hi)]
    return corners


def _quotient(x: float, y: float) -> float:
    return 0.0 if math.isinf(y) else x / y


def around(centre: Fact, slack: float) -> Fact:
    """The interval widened by an absolute error."""
    if math.isnan(slack):
        return Fact()
    return Fact(centre.lo - slack, centre.hi + slack)

"""Interval arithmetic for the range rules of builtins.

Bounds must hold for the float32 value that a device computes, not only for the exact value, because
guards are left out on their account. So all bounds are rounded outward, by the operation's error.
Rounding is monotonic, so a bound that float32 represents exactly stays unchanged. Zero stays
unchanged too: no operation's error changes the sign of a result.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable

from .facts import SMALLEST_NORMAL, Fact

ULP = 2.0**-23
"""The largest unit in the last place (ulp) of a float32, relative to its value."""


def outward(lo: float, hi: float, ulps: float = 0.0) -> Fact:
    """The float32 interval around [lo, hi] if the operation's error is up to ``ulps``."""
    return Fact(_stretch(lo, -1.0, ulps), _stretch(hi, 1.0, ulps))


def _stretch(bound: float, direction: float, ulps: float) -> float:
    if math.isnan(bound):
        return direction * math.inf
    if bound == 0 or math.isinf(bound):
        return bound
    if abs(bound) < SMALLEST_NORMAL:
        return direction * SMALLEST_NORMAL if bound * direction > 0 else 0.0
    if ulps == 0 and _is_float32(bound):
        return bound
    return bound + direction * abs(bound) * (ulps + 1) * ULP


def _is_float32(value: float) -> bool:
    try:
        rounded: float = struct.unpack("f", struct.pack("f", value))[0]
    except OverflowError:
        return False
    return rounded == value


def monotone(function: Callable[[float], float], fact: Fact, ulps: float = 0.0) -> Fact:
    """The image of an interval under a function that never decreases."""
    return outward(function(fact.lo), function(fact.hi), ulps)


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


def quotients(x: Fact, y: Fact, smallest: float) -> list[float]:
    """Bounds of ``x / y`` for every ``y`` whose magnitude is at least ``smallest``."""
    corners: list[float] = []
    for lo, hi in ((y.lo, min(y.hi, -smallest)), (max(y.lo, smallest), y.hi)):
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

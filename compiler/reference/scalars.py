"""The array library for plain Python numbers, so that evaluating constants needs no NumPy.

Every function returns what NumPy's function would, even where Python's own would raise; see
``namespace``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from operator import mod as _floored_remainder
from typing import TypeVar

_Number = TypeVar("_Number", int, float)


def _total(function: Callable[[float], float]) -> Callable[[float], float]:
    """``function``, returning what NumPy would where Python raises."""

    def total(x: float, /) -> float:
        try:
            return function(x)
        except OverflowError:
            return math.inf
        except ValueError:
            return math.nan

    return total


def _whole(function: Callable[[float], int]) -> Callable[[float], float]:
    """A rounding function that returns infinity and NaN unchanged."""
    return lambda x: float(function(x)) if math.isfinite(x) else x


def where(condition: bool, x: _Number, y: _Number, /) -> _Number:
    """``x`` where the condition holds, else ``y``."""
    return x if condition else y


def float64(x: float, /) -> float:
    """The number as a float."""
    return float(x)


def int64(x: float, /) -> int:
    """The number truncated to an integer; 0 for infinity and NaN."""
    return int(x) if math.isfinite(x) else 0


def logical_and(x: bool, y: bool, /) -> bool:
    """True if both conditions hold."""
    return x and y


def logical_or(x: bool, y: bool, /) -> bool:
    """True if at least one condition holds."""
    return x or y


def logical_not(x: bool, /) -> bool:
    """True if the condition does not hold."""
    return not x


def minimum(x: _Number, y: _Number, /) -> _Number:
    """The lesser number."""
    return min(x, y)


def maximum(x: _Number, y: _Number, /) -> _Number:
    """The greater number."""
    return max(x, y)


def divide(x: float, y: float, /) -> float:
    """The quotient as IEEE 754 defines it."""
    if y != 0:
        return x / y
    return math.nan if x == 0 or math.isnan(x) else math.copysign(math.inf, x) * math.copysign(1, y)


def remainder(x: float, y: float, /) -> float:
    """The remainder of the quotient rounded down; it has the sign of ``y``."""
    return _floored_remainder(x, y) if y != 0 else math.nan


def power(x: float, y: float, /) -> float:
    """``x`` to the power of ``y``, for positive ``x``."""
    try:
        return math.pow(x, y)
    except OverflowError:
        return math.inf
    except ValueError:
        return math.nan


def arctan2(y: float, x: float, /) -> float:
    """The angle between the x axis and the point (x, y)."""
    return math.atan2(y, x)


def frexp(x: float, /) -> tuple[float, int]:
    """The fraction, whose magnitude is at least a half and below one, and the exponent."""
    return math.frexp(x)


def ldexp(x: float, n: int, /) -> float:
    """``x`` times two to the power of ``n``."""
    try:
        return math.ldexp(x, n)
    except OverflowError:
        return math.copysign(math.inf, x)


def _logarithm(function: Callable[[float], float]) -> Callable[[float], float]:
    """A logarithm that is minus infinity at zero."""
    total = _total(function)
    return lambda x: total(x) if x != 0 else -math.inf


floor = _whole(math.floor)
ceil = _whole(math.ceil)
rint = _whole(round)
trunc = _whole(math.trunc)
sqrt = _total(math.sqrt)
exp = _total(math.exp)
exp2 = _total(lambda x: math.pow(2.0, x))
log = _logarithm(math.log)
log2 = _logarithm(math.log2)
sin = _total(math.sin)
cos = _total(math.cos)
tan = _total(math.tan)
arcsin = _total(math.asin)
arccos = _total(math.acos)
arctan = _total(math.atan)
cosh = _total(math.cosh)
tanh = _total(math.tanh)
arcsinh = _total(math.asinh)
arccosh = _total(math.acosh)
arctanh = _total(math.atanh)


def sinh(x: float, /) -> float:
    """The hyperbolic sine, which overflows to infinity of either sign."""
    try:
        return math.sinh(x)
    except OverflowError:
        return math.copysign(math.inf, x)

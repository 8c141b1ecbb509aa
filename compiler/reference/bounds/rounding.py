"""Ends of intervals: rounded outward to float32, multiplied, and limited, for ``bounded.py``."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ....stdlib.builtins.facts import LARGEST_FLOAT, SMALLEST_NORMAL

Array = Any
"""A NumPy array, or one of NumPy's numbers."""
Ends = tuple[Array, Array]
"""The least and the largest of what may be; NaN where nothing is known."""

_LARGEST = np.float32(LARGEST_FLOAT)

ULP = 2.0**-23
"""The largest unit in the last place of a float32, relative to the number; so far the two float32
numbers around a result may be from it."""

ROUNDED_UP = 1.0 + 2.0**-50
"""A factor for magnitudes that float64 may have rounded down."""

SUBNORMAL_STEP = 2.0**-149
"""The distance of subnormal float32 numbers."""


def outward(low: Array, high: Array) -> tuple[Array, Array]:
    """An interval that contains the float32 numbers on both sides of ``low`` and of ``high``.

    A correctly rounded operation returns one of the two float32 numbers around its exact result, so
    this is where it may lie. A number that float32 has stays as it is. A device may flush a
    subnormal result to zero (Vulkan, "Denormalized values"; WGSL, "floating point evaluation").
    """
    return _flushed_up(_below(low)), _flushed_down(_above(high))


def of_device(low: Array, high: Array) -> tuple[Array, Array]:
    """Between which numbers a device's float32 is, if it is within an error from these.

    A result beyond the largest float32 is infinite, and a subnormal one may be flushed to zero.
    """
    if not (np.abs(low).max(initial=0) <= LARGEST_FLOAT >= np.abs(high).max(initial=0)):
        low = np.minimum(np.where(low < -LARGEST_FLOAT, -np.inf, low), LARGEST_FLOAT)
        high = np.maximum(np.where(high > LARGEST_FLOAT, np.inf, high), -LARGEST_FLOAT)
    return _flushed_up(low), _flushed_down(high)


def constant_ends(value: Array) -> tuple[Array, Array]:
    """Between which numbers the nearest float32 of a constant is, and the constant itself."""
    nearest = np.asarray(value, np.float32).astype(np.float64)
    return of_device(np.minimum(value, nearest), np.maximum(value, nearest))


def is_float32(value: Array) -> bool:
    """Whether every device has all these numbers: normal float32 numbers, and zero."""
    nearest = np.asarray(value, np.float32)
    magnitude = np.abs(value)
    normal = (magnitude >= SMALLEST_NORMAL) | (magnitude == 0)
    return bool(((nearest == value) & normal).all())


def _below(x: Array) -> Array:
    """The nearest float32 that is not above, or one less than two steps below."""
    nearest = np.array(np.minimum(np.asarray(x, np.float32), _LARGEST), np.float64)
    np.subtract(nearest, _step(nearest), out=nearest, where=nearest > x)
    return nearest


def _above(x: Array) -> Array:
    nearest = np.array(np.maximum(np.asarray(x, np.float32), -_LARGEST), np.float64)
    np.add(nearest, _step(nearest), out=nearest, where=nearest < x)
    return nearest


def _step(x: Array) -> Array:
    """At least the distance to the next float32, also of a subnormal one."""
    return np.abs(x) * ULP + SUBNORMAL_STEP


def _flushed_up(low: Array) -> Array:
    """The lower end of an interval, or zero if it is positive and subnormal."""
    tiny = (low > 0) & (low < SMALLEST_NORMAL)
    return np.where(tiny, 0.0, low) if tiny.any() else low


def _flushed_down(high: Array) -> Array:
    tiny = (high < 0) & (high > -SMALLEST_NORMAL)
    return np.where(tiny, 0.0, high) if tiny.any() else high


# --- ends of intervals ----------------------------------------------------------------------------


def products(x: Ends, y: Ends) -> Ends:
    """The ends of all products; NaN where one may be infinite and the other one zero."""
    a, b, c, d = (one * other for one in x for other in y)
    low = np.minimum(np.minimum(a, b), np.minimum(c, d))
    high = np.maximum(np.maximum(a, b), np.maximum(c, d))
    if np.isfinite(low).all() and np.isfinite(high).all():
        return low, high
    nothing = (_is_infinite(*x) & _has_zero(*y)) | (_has_zero(*x) & _is_infinite(*y))
    return np.where(nothing, np.nan, low), np.where(nothing, np.nan, high)


def square(x: Ends) -> Ends:
    """The ends of the squares of an interval's numbers."""
    low, high = np.abs(x[0]), np.abs(x[1])
    nearest = np.where(_has_zero(*x), 0.0, np.minimum(low, high))
    return nearest * nearest, np.maximum(low, high) ** 2


def tighter(choose: Callable[[Array, Array], Array], end: Array, limit: Array) -> Array:
    """An end of an interval, limited further unless one of the two numbers says nothing."""
    found = choose(end, limit)
    unknown = np.isnan(end)
    return np.where(unknown, end, found) if unknown.any() else found


def lost(low: Array, high: Array) -> Array:
    """What an error has to allow for besides rounding: subnormal numbers, and those too large."""
    if np.isfinite(low).all() and np.isfinite(high).all():
        return SMALLEST_NORMAL
    return np.where(_is_infinite(low, high), np.inf, SMALLEST_NORMAL)


def _is_infinite(low: Array, high: Array) -> Array:
    return ~(np.isfinite(low) & np.isfinite(high))


def _has_zero(low: Array, high: Array) -> Array:
    return (low <= 0) & (high >= 0)

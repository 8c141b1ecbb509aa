"""The ends of all products of two intervals, which ``bounded.py`` rounds to bounds of a product."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from .rounding import Array


class Interval(Protocol):
    """The attributes that are read of a lane with bounds."""

    value: Array
    low: Array
    high: Array

    @property
    def is_exact(self) -> bool:
        """True if both ends are the value."""
        ...

    @property
    def magnitude(self) -> Array:
        """The largest magnitude of the ends."""
        ...


def products(x: Interval, y: Interval) -> tuple[Array, Array]:
    """The ends of all products; NaN where one may be infinite and the other one zero."""
    if y.is_exact:
        one, other = x.low * y.value, x.high * y.value
        return np.minimum(one, other), np.maximum(one, other)
    if x.is_exact:
        return products(y, x)
    a, b, c, d = x.low * y.low, x.low * y.high, x.high * y.low, x.high * y.high
    low = np.minimum(np.minimum(a, b), np.minimum(c, d))
    high = np.maximum(np.maximum(a, b), np.maximum(c, d))
    if np.isfinite((high - low).sum()):
        return low, high
    nothing = (_is_infinite(x) & _has_zero(y)) | (_has_zero(x) & _is_infinite(y))
    return np.where(nothing, np.nan, low), np.where(nothing, np.nan, high)


def square(x: Interval) -> tuple[Array, Array]:
    """The ends of all products of a number with itself."""
    nearest = np.minimum(np.abs(x.low), np.abs(x.high))
    near = np.where((x.low <= 0) & (x.high >= 0), 0, nearest)
    return near * near, x.magnitude**2


def _is_infinite(x: Interval) -> Array:
    return ~(np.isfinite(x.low) & np.isfinite(x.high))


def _has_zero(x: Interval) -> Array:
    return (x.low <= 0) & (x.high >= 0)

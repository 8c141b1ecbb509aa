"""Directed rounding of float64 arrays to float32; ``bounded.py`` widens intervals with it."""

from __future__ import annotations

from typing import Any

import numpy as np

from ....stdlib.builtins.facts import LARGEST_FLOAT, SMALLEST_NORMAL, ULP

Array = Any
"""A NumPy array, or one of NumPy's numbers."""

ROUNDED_UP = 1.0 + 2.0**-50
"""A factor for magnitudes that float64 may have rounded down."""

SUBNORMAL_STEP = 2.0**-149
"""The distance of subnormal float32 numbers."""


def outward(low: Array, high: Array, *, fits: bool = False) -> tuple[Array, Array]:
    """An interval that contains the float32 numbers on both sides of ``low`` and of ``high``.

    A correctly rounded operation returns one of the two float32 numbers around its exact result, so
    this is where it may lie. A number that float32 has stays as it is. A device may flush a
    subnormal result to zero (Vulkan, "Precision and Operation of SPIR-V Instructions"; WGSL,
    "Differences from IEEE-754"). ``fits`` says that no number is beyond the largest float32.
    """
    # Numbers that are not subnormal, which few are, need fewer operations.
    nearest = np.fmin(np.abs(low), np.abs(high))
    if np.count_nonzero(nearest < SMALLEST_NORMAL):
        ends = _down(low), _up(high)
    else:
        ends = _normal_down(low), _normal_up(high)
    return ends if fits else _finite_or_infinite(*ends)


def of_device(low: Array, high: Array, *, fits: bool = False) -> tuple[Array, Array]:
    """Between which numbers a device's float32 is, if it is within an error from these.

    A result beyond the largest float32 is infinite, and a subnormal one may be flushed to zero.
    ``fits`` says that none is beyond it.
    """
    if not fits:
        low, high = _finite_or_infinite(low, high)
    return _flushed_up(low), _flushed_down(high)


def rounding_error(magnitude: Array, times: int = 1) -> Array:
    """The largest error of results of this magnitude that are rounded so often; none of zero."""
    return relative_error(times) * magnitude + np.minimum(
        magnitude * 2.0**1000, times * SUBNORMAL_STEP
    )


def relative_error(times: int) -> float:
    """The largest error of ``times`` roundings one after the other, relative to the result.

    It is ``(1 + ULP) ** times - 1``, and not more than this if these are fewer than millions.
    """
    return times * ULP * (1.0 + times * ULP)


def lost(magnitude: Array, *, fits: bool = False) -> Array:
    """The amount that a result of this magnitude may lose besides rounding.

    All of it is lost if it is flushed to zero, and everything if it overflows. ``fits`` says that
    none does.
    """
    found = np.minimum(magnitude, SMALLEST_NORMAL)
    if fits or all_fit(magnitude):
        return found
    return np.where(magnitude > LARGEST_FLOAT, np.inf, found)


def all_fit(magnitude: Array) -> bool:
    """True if no number is beyond the largest float32; those that are NaN do not count."""
    return bool(np.fmax.reduce(magnitude, axis=None, initial=0.0) <= LARGEST_FLOAT)


def constant_ends(value: Array) -> tuple[Array, Array]:
    """Between which numbers the nearest float32 of a constant is, and the constant itself."""
    nearest = np.asarray(value, np.float32).astype(np.float64)
    return of_device(np.minimum(value, nearest), np.maximum(value, nearest))


def is_float32(value: Array) -> bool:
    """True if every device has all these numbers: normal float32 numbers, and zero."""
    # Most arrays that are asked about have numbers that are no float32, which is found first.
    if not (np.asarray(value, np.float32) == value).all():
        return False
    magnitude = np.abs(value)
    return bool(((magnitude >= SMALLEST_NORMAL) | (magnitude == 0)).all())


_FRACTION = np.int64(2**29 - 1)
"""The bits of a float64 that float32 has no room for."""


def _normal_down(x: Array) -> Array:
    """The next float32 below, for normal numbers."""
    bits = np.asarray(x, np.float64).view(np.int64)
    # Without a part of its fraction, a number is closer to zero, so a negative one is made larger.
    below: Array = ((bits + ((bits >> 63) & _FRACTION)) & ~_FRACTION).view(np.float64)
    return below


def _normal_up(x: Array) -> Array:
    """The next float32 above, for normal numbers."""
    bits = np.asarray(x, np.float64).view(np.int64)
    above: Array = ((bits + (~(bits >> 63) & _FRACTION)) & ~_FRACTION).view(np.float64)
    return above


def _down(x: Array) -> Array:
    """The least value of a rounded number: the next float32 below, or zero."""
    below, tiny = _normal_down(x), _subnormal(x)
    if not np.count_nonzero(tiny):
        return below
    return np.where(tiny, np.where(x > 0, 0.0, x - SUBNORMAL_STEP), below)


def _up(x: Array) -> Array:
    """The greatest value of a rounded number: the next float32 above, or zero."""
    return 0.0 - _down(-x)


def _subnormal(x: Array) -> Array:
    magnitude = np.abs(x)
    return (magnitude < SMALLEST_NORMAL) & (magnitude > 0)


def _finite_or_infinite(low: Array, high: Array) -> tuple[Array, Array]:
    """The interval, with infinity in place of numbers beyond the largest float32."""
    least = np.minimum.reduce(low, axis=None, initial=0.0)
    largest = np.maximum.reduce(high, axis=None, initial=0.0)
    if least >= -LARGEST_FLOAT and largest <= LARGEST_FLOAT:
        return low, high
    low = np.minimum(np.where(low < -LARGEST_FLOAT, -np.inf, low), LARGEST_FLOAT)
    return low, np.maximum(np.where(high > LARGEST_FLOAT, np.inf, high), -LARGEST_FLOAT)


def _flushed_up(low: Array) -> Array:
    """The lower end of an interval, or zero if it is positive and subnormal."""
    tiny = (low > 0) & (low < SMALLEST_NORMAL)
    return np.where(tiny, 0.0, low) if np.count_nonzero(tiny) else low


def _flushed_down(high: Array) -> Array:
    """The upper end of an interval, or zero if it is negative and subnormal; no negative zero."""
    tiny = (high < 0) & (high > -SMALLEST_NORMAL)
    return 0.0 + (np.where(tiny, 0.0, high) if np.count_nonzero(tiny) else high)

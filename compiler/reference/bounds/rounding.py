"""Directed rounding of float64 arrays to float32; ``bounded.py`` widens intervals with it."""

from __future__ import annotations

from typing import Any

import numpy as np

from ....stdlib.builtins.facts import LARGEST_FLOAT, SMALLEST_NORMAL

Array = Any
"""A NumPy array, or one of NumPy's numbers."""

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
    below = np.asarray(low, np.float32).astype(np.float64)
    above = below if high is low else np.asarray(high, np.float32).astype(np.float64)
    if not np.isfinite((below - above).sum()):
        return _flushed_up(_below_infinity(below, low)), _flushed_down(_above_infinity(above, high))
    below = below - (below > low) * _step(below)
    above = above + (above < high) * _step(above)
    return _flushed_up(below), _flushed_down(above)


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


def _below_infinity(nearest: Array, low: Array) -> Array:
    """The same where the nearest float32 may be infinite, or where nothing is known."""
    nearest = np.minimum(nearest, LARGEST_FLOAT)
    return np.where(nearest > low, nearest - _step(nearest), nearest)


def _above_infinity(nearest: Array, high: Array) -> Array:
    nearest = np.maximum(nearest, -LARGEST_FLOAT)
    return np.where(nearest < high, nearest + _step(nearest), nearest)


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

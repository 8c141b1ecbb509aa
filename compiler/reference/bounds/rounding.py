"""Directed rounding of float64 arrays to float32; ``bounded.py`` widens intervals with it."""

from __future__ import annotations

from typing import Any

import numpy as np

from ....stdlib.builtins.facts import SMALLEST_NORMAL

Array = Any
"""A NumPy array, or one of NumPy's numbers."""

_BELOW, _ABOVE = np.float32(-np.inf), np.float32(np.inf)

HALF_STEP = 2.0**-24
"""The largest error of one rounding to the nearest float32, relative to the result."""
ULP = 2.0**-23
"""The largest unit in the last place of a float32, relative to the number."""


def outward(low: Array, high: Array) -> tuple[Array, Array]:
    """The least interval of float32 numbers that contains ``low`` and ``high``.

    A correctly rounded operation returns one of the two float32 numbers around its exact result, so
    this is where it may lie. A number that float32 has stays as it is. A device may flush a
    subnormal result to zero (Vulkan, "Denormalized values"; WGSL, "floating point evaluation").
    """
    return _flushed(_down(low), low > 0), _flushed(_up(high), high < 0)


def constant_ends(value: Array) -> tuple[Array, Array]:
    """Between which numbers the nearest float32 of a constant is, and the constant itself."""
    nearest = np.asarray(value, np.float32).astype(np.float64)
    return np.minimum(value, nearest), np.maximum(value, nearest)


def is_float32(value: Array) -> bool:
    """Whether every device has all these numbers: normal float32 numbers, and zero."""
    nearest = np.asarray(value, np.float32)
    magnitude = np.abs(value)
    normal = (magnitude >= SMALLEST_NORMAL) | (magnitude == 0)
    return bool(((nearest == value) & normal).all())


def _down(x: Array) -> Array:
    nearest = np.asarray(x, np.float32)
    return np.where(nearest > x, np.nextafter(nearest, _BELOW), nearest).astype(np.float64)


def _up(x: Array) -> Array:
    nearest = np.asarray(x, np.float32)
    return np.where(nearest < x, np.nextafter(nearest, _ABOVE), nearest).astype(np.float64)


def _flushed(x: Array, towards_zero: Array) -> Array:
    """The end with zero in the interval, if its side of it is subnormal."""
    return np.where(towards_zero & (np.abs(x) < SMALLEST_NORMAL), 0.0, x)

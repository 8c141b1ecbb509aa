"""Judges pictures once more, with arrays of NumPy, straight from the rules of golden folders."""

from __future__ import annotations

import math
from decimal import Decimal

import numpy as np

from .folders import Array


def verdict(lower: Array, upper: Array, undecided: Array, picture: Array, encoding: str) -> str:
    """The message of the verdict about a picture that fits its bounds."""
    if picture.dtype.kind == "f" and encoding == "srgb":
        return "error: the picture has floats, which are linear: only integers are encoded"
    lanes = picture.shape[2]
    low, high = lower[..., :lanes].copy(), upper[..., :lanes].copy()
    largest = np.iinfo(picture.dtype).max if picture.dtype.kind == "u" else 1
    if picture.dtype.kind == "u":
        low, high = np.clip(low, 0, 1), np.clip(high, 0, 1)
        if encoding == "srgb":
            low[..., :3], high[..., :3] = srgb(low[..., :3]), srgb(high[..., :3])
        low, high = np.floor(low * largest), np.ceil(high * largest)
    drawn = picture.astype(np.float64)
    compared = undecided == 0
    outside = ~((low <= drawn) & (drawn <= high)) & compared[..., None]
    if not compared.any():
        return "error: nothing is compared: every pixel is undecided"
    counts = (
        f"{compared.sum()} pixels compared, {(~compared).sum()} undecided, "
        f"{outside.any(axis=2).sum()} outside of the bounds"
    )
    if not outside.any():
        return f"good: {counts}"
    with np.errstate(invalid="ignore", over="ignore"):
        distance = np.where(drawn < low, low - drawn, drawn - high) / largest
    distance = np.where(np.isnan(drawn), np.inf, distance)
    place = np.unravel_index(np.argmax(np.where(outside, distance, -np.inf)), distance.shape)
    y, x, lane = map(int, place)
    value, least, most = (_shown(array[place]) for array in (drawn, low, high))
    return (
        f"bad: {counts}; the worst, at x {x}, y {y}, lane {lane}, "
        f"is {value}, not within {least} .. {most}"
    )


def srgb(values: Array) -> Array:
    """The transfer function of sRGB, from linear light."""
    dark = values <= 0.0031308
    curve = 1 + 1.055 * (np.power(np.where(dark, 1, values), 1 / 2.4) - 1)
    return np.where(dark, 12.92 * values, curve)


def _shown(number: float) -> str:
    """The shortest decimal that means the same number, positional if it is of usual size."""
    if math.isnan(number):
        return "NaN"
    if math.isinf(number):
        return str(number)
    decimal = Decimal(repr(float(number))).normalize()
    if decimal == 0 or 1e-4 <= abs(number) < 1e16:
        return f"{abs(decimal) if decimal == 0 else decimal:f}"
    return f"{decimal:e}".replace("e+", "e")

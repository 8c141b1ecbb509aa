"""The bits of numbers, and rounding to float32 in a direction and to the nearest."""

from __future__ import annotations

import math
import struct
from fractions import Fraction

import numpy as np

from ....stdlib.builtins.facts import LARGEST_FLOAT
from .records import Bits, Kind

_FRACTION, _LEAST_EXPONENT = 23, -126


def bits_of(number: float, kind: Kind) -> Bits:
    """The bits of a float32, of an integer, or of a condition, which is 0 or 1."""
    if kind != "float":
        return f"{int(number) & 0xFFFFFFFF:08x}"
    return struct.pack(">f", number + 0.0).hex()


def rounded(number: Fraction) -> float:
    """The nearest float32, an even one in the middle between two; infinite beyond the largest."""
    if not number:
        return 0.0
    magnitude = abs(number)
    exponent = magnitude.numerator.bit_length() - magnitude.denominator.bit_length()
    if magnitude < Fraction(2) ** exponent:
        exponent -= 1
    step = Fraction(2) ** (max(exponent, _LEAST_EXPONENT) - _FRACTION)
    found = round(magnitude / step) * step
    nearest = math.inf if found > LARGEST_FLOAT else float(found)
    return -nearest if number < 0 else nearest


def least_float32(end: float) -> float:
    """The least float32 that is not below a number."""
    with np.errstate(over="ignore"):
        found = np.float32(end)
        up = np.nextafter(found, np.float32(np.inf))
    return float(up if float(found) < end else found)


def most_float32(end: float) -> float:
    """The greatest float32 that is not above a number."""
    return -least_float32(-end)

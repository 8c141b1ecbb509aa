"""Writes constants: the shortest text that every language reads as the same number."""

from __future__ import annotations

import math
import struct
from functools import lru_cache

from ...compiler.ir.types import ScalarKind
from ...stdlib.builtins.facts import LARGEST_FLOAT, SMALLEST_NORMAL
from ..description.spellings import Literals

_LOWEST = -(2**31)
_LARGEST_TEXT = "3.4028234e38"
"""Rounded down: Tint refuses a decimal above the largest float32, though it rounds to this."""


def literal(value: float, kind: ScalarKind, style: Literals) -> str:
    """One lane of a constant."""
    if kind == "bool":
        return style.true if value else style.false
    if kind == "float":
        return decimal(float(value)) + style.float_suffix
    if kind == "uint":
        return f"{int(value)}{style.uint_suffix}"
    # The lowest integer is the sign change of a number that does not fit.
    return f"{_LOWEST + 1} - 1" if value == _LOWEST else str(int(value))


def decimal(value: float) -> str:
    """The shortest decimal that reads back as ``value`` rounded to float32, with a point in it.

    Magnitudes below the smallest normal number are written as zero, which they may count as: DXC
    crashes where a choice has one of them as a side.
    """
    # The sign is looked at, too: as keys, 0.0 and -0.0 are equal.
    return _shortest(value, math.copysign(1.0, value))


@lru_cache(maxsize=8192)
def _shortest(value: float, _sign: float) -> str:
    single = _rounded(value)
    if abs(single) < SMALLEST_NORMAL:
        return "-0.0" if math.copysign(1.0, single) < 0 else "0.0"
    if abs(single) == LARGEST_FLOAT:
        return f"-{_LARGEST_TEXT}" if single < 0 else _LARGEST_TEXT
    # A number of up to six digits survives rounding to float32: the text with six digits finds it.
    digits = next(
        text for count in range(6, 10) if _rounded(float(text := f"{single:.{count}g}")) == single
    )
    mantissa, _, exponent = f"{float(digits)!r}".partition("e")
    if exponent:
        return f"{mantissa}e{int(exponent)}"
    return mantissa


def _rounded(value: float) -> float:
    """``value`` as a float32; infinite beyond its range, as candidates for the last ones are."""
    try:
        result: float = struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)
    return result

"""Reads the language's literals: colours such as ``#b5651d``, and angles such as ``30deg``."""

from __future__ import annotations

import math
import re

from ....compiler.srgb import linear

_LITERAL = re.compile(r"#([0-9a-fA-F]{3}|[0-9a-fA-F]{6}|[0-9a-fA-F]{8})")


_ANGLE_UNITS = {"deg": math.pi / 180.0, "rad": 1.0}


def color_channels(text: str) -> tuple[int, ...] | None:
    """Three or four channels in 0..255, the colours as sRGB; ``None`` if it is not a literal."""
    literal = _LITERAL.fullmatch(text)
    if literal is None:
        return None
    digits = literal[1]
    if len(digits) == 3:
        digits = "".join(digit * 2 for digit in digits)
    return tuple(bytes.fromhex(digits))


def color_lanes(text: str) -> tuple[float, ...] | None:
    """Three or four lanes in 0..1, the colours in linear light; ``None`` if it is not a literal."""
    channels = color_channels(text)
    if channels is None:
        return None
    return (*map(linear, channels[:3]), *(channel / 255 for channel in channels[3:]))


def angle(text: str) -> float | None:
    """An angle in radians; ``None`` if the text is not a number with a unit."""
    unit = _ANGLE_UNITS.get(text[-3:])
    try:
        return None if unit is None else float(text[:-3]) * unit
    except ValueError:
        return None

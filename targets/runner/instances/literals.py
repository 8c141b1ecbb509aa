"""Reads the language's literals: colours such as ``#b5651d``, and numbers such as ``30deg``."""

from __future__ import annotations

import re

from ....compiler.srgb import linear
from ....compiler.units import ANGLES, LENGTHS, parted, value_of

_LITERAL = re.compile(r"#([0-9a-fA-F]{3}|[0-9a-fA-F]{6}|[0-9a-fA-F]{8})")


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


def measured(text: str, meaning: str | None) -> float | None:
    """An angle in radians, or else a length in metres.

    ``None`` if the text is not a number with such a unit.
    """
    digits, unit = parted(text)
    wanted = ANGLES if meaning == "angle" else LENGTHS
    try:
        return value_of(digits, unit) if unit in wanted else None
    except ValueError:
        return None

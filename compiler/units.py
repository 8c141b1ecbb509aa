"""Units behind numbers: ``30deg`` is an angle in radians, ``5mm`` a length in metres.

The grammar has the same names in its token ``NUMBER``. The checker, the exporters and the readers
of hosts' texts ask for values here.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf, radians, tau
from types import MappingProxyType

ANGLES = ("deg", "rad", "turn")
"""The units of angles; a whole turn is 360 degrees."""
LENGTHS: Mapping[str, str] = MappingProxyType({
    "nm": "1e-9", "um": "1e-6", "mm": "1e-3", "cm": "1e-2", "m": "1", "km": "1e3",
    "in": "0.0254", "ft": "0.3048", "yd": "0.9144", "mi": "1609.344",
})  # fmt: skip
"""The units of lengths, in metres: exact, as they are defined."""
UNITS = (*ANGLES, *LENGTHS)
_WORDS = MappingProxyType({
    "degree": "deg", "radian": "rad", "nanometer": "nm", "nanometre": "nm", "micron": "um",
    "micrometer": "um", "micrometre": "um", "millimeter": "mm", "millimetre": "mm",
    "centimeter": "cm", "centimetre": "cm", "meter": "m", "metre": "m", "kilometer": "km",
    "kilometre": "km", "inch": "in", "foot": "ft", "feet": "ft", "yard": "yd", "mile": "mi",
})  # fmt: skip


def parted(text: str) -> tuple[str, str]:
    """The digits of a number and its unit, which is empty if it has none."""
    digits = text.rstrip("abcdefghijklmnopqrstuvwxyz")
    unit = text[len(digits) :]
    return (digits, unit) if unit in UNITS else (text, "")


def value_of(digits: str, unit: str) -> float:
    """The number in radians or metres, rounded once; infinite if it is too large."""
    value = float(digits)
    if unit == "deg":
        return radians(value)
    if unit == "turn":
        return value * tau
    if unit in LENGTHS and 0 < abs(value) < inf:
        from decimal import Decimal

        return float(Decimal(digits) * Decimal(LENGTHS[unit]))
    return value


def named(word: str) -> str:
    """The unit that a word means, as of ``millimeters``; empty if it means none."""
    word = word.lower()
    for known in (word, word.removesuffix("s"), word.removesuffix("es")):
        unit = known if known in UNITS else _WORDS.get(known, "")
        if unit:
            return unit
    return ""


def listed() -> str:
    """The names of all units, for messages."""
    lengths = ", ".join(f"`{unit}`" for unit in LENGTHS)
    angles = ", ".join(f"`{unit}`" for unit in ANGLES)
    return f"units are {angles} for angles and {lengths} for lengths"

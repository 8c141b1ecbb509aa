"""The domain over which programs are compared: between which numbers each variable lies.

A declared range counts. What has none gets the range of its kind below, unless the user names one;
``docs/same.md`` lists them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from ...stdlib.builtins.facts import Fact
from ...support.frozen import frozen
from ..ir.meaning import Meaning

Range = tuple[float, float]

NUMBERS: Range = (-10.0, 10.0)
"""The range of floats about which nothing is said: of each lane of points, vectors and matrices."""
COLOURS: Range = (0.0, 1.0)
"""The range of each lane of a colour, and of what is read of a texture of floats."""
ANGLES: Range = (-math.pi, math.pi)
LANES: Range = (-1.0, 1.0)
"""The range of each lane of a direction or a normal."""
WHOLE: Range = (-16.0, 16.0)
"""The range of whole numbers about which nothing is said, as far as their type has them."""
_WIDEST = 1e9
"""Ranges wider than this say nothing about what is meant."""


@frozen
class Domain:
    """What the user says about parameters and inputs."""

    ranges: Mapping[str, Range]
    """Ranges by the names of values, or of single lanes of them."""
    settings: Mapping[str, tuple[float, ...]]
    """Values by name: for each lane one, or one for all."""

    def range_of(self, name: str, kind: str, fact: Fact, meaning: Meaning | None) -> Range:
        """The range of a lane."""
        for prefix, given in self.ranges.items():
            if is_of(name, prefix):
                return given
        if kind == "b":
            return (0.0, 1.0)
        usual = WHOLE if kind == "i" else _usual(meaning)
        low, high = fact.lo, fact.hi
        if high - low <= _WIDEST:
            return low, high
        if low > -_WIDEST:
            return low, max(usual[1], low + usual[1] - usual[0])
        if high < _WIDEST:
            return min(usual[0], high - usual[1] + usual[0]), high
        return usual

    def set_to(self, name: str, lane: int) -> float | None:
        """The number that a lane of a value is set to; ``None`` for most."""
        for prefix, values in self.settings.items():
            if is_of(name, prefix):
                return values[lane] if len(values) > 1 else values[0]
        return None

    @property
    def names(self) -> tuple[str, ...]:
        """All names that the user has named."""
        return (*self.ranges, *self.settings)


def is_of(name: str, prefix: str) -> bool:
    """True if a lane has a name, or is a part of what has it."""
    return name == prefix or name.startswith((f"{prefix}.", f"{prefix}["))


def _usual(meaning: Meaning | None) -> Range:
    if meaning is None:
        return NUMBERS
    if meaning.kind in ("rgb", "rgba"):
        return COLOURS
    if meaning.kind == "angle":
        return ANGLES
    return LANES if meaning.kind in ("direction", "normal") else NUMBERS

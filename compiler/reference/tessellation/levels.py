"""The meaning of a patch's levels: into how many steps an edge is divided, and where these end."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from ...ir.tessellation import MOST_LEVEL, Spacing

ONE = 1 << 16
"""The length of an edge in units of its places."""
HALF = ONE // 2

_RANGES: Mapping[Spacing, tuple[int, int]] = {
    "equal": (1, MOST_LEVEL),
    "fractional_even": (2, MOST_LEVEL),
    "fractional_odd": (1, MOST_LEVEL - 1),
}
"""The limits to which levels are clamped."""
_MORE_THAN_ONE = 1 + 2**-16
"""The least level inside of a patch whose edges are divided, as otherwise there is no inside."""


class EdgeSteps:
    """The places at which an edge is divided, from one end to the other.

    With a fractional spacing they move on between those of two whole levels as the level rises. The
    first half is computed, and the second one is its mirror image: both ends of an edge look alike.
    """

    def __init__(self, level: float, spacing: Spacing) -> None:
        """``level`` is within the range of the spacing, and whole if the steps are equal."""
        self.is_odd = level % 2 == 1 if spacing == "equal" else spacing == "fractional_odd"
        half = (_fixed(level) + 1) // 2
        if self.is_odd or half == HALF:
            half += HALF
        below, above = half // ONE, -(-half // ONE)
        self._share = half - below * ONE
        """The fraction by which the places have moved on to those of the level above."""
        self._in_half = above
        self._new = self._in_half + 1 if below == above else self._newest(below)
        """The number of the place that the level above has, and the one below has not."""
        self._below, self._above = (
            _reciprocal(2 * segments - self.is_odd) for segments in (below, above)
        )

    @property
    def count(self) -> int:
        """The number of places, both ends among them."""
        return 2 * self._in_half + (not self.is_odd)

    @property
    def between(self) -> int:
        """The number of steps of the first half, without the one in the middle of an odd number."""
        return self._in_half - self.is_odd

    def place(self, number: int) -> int:
        """The place where a step ends; number 0 is the beginning of the edge."""
        is_second_half = number >= self._in_half
        if is_second_half:
            number = 2 * self._in_half - number - self.is_odd
        if number == self._in_half:
            return HALF
        before = number - (number > self._new)
        moved = before * self._below * (ONE - self._share) + number * self._above * self._share
        place = (moved + HALF) // ONE
        return ONE - place if is_second_half else place

    def _newest(self, below: int) -> int:
        """Places appear in the order of reversed bits, so that they are evenly spread."""
        if not self.is_odd:
            return 2 * _without_highest_bit(below) + 1
        return 0 if below == 1 else 2 * _without_highest_bit(below - 1) + 1


def steps_of(
    spacing: Spacing, edges: Sequence[float], inside: Sequence[float]
) -> tuple[list[EdgeSteps], list[EdgeSteps]] | None:
    """The steps of the edges of a patch, and of its inside; ``None`` if it is not to be drawn.

    That is so if the level of an edge is not above zero, or no number.
    """
    if not all(level > 0 for level in edges):
        return None
    least, most = _RANGES[spacing]
    outer, inner = ([_clamped(x, least, most) for x in levels] for levels in (edges, inside))
    if any(level > 1 for level in (*outer, *inner)):
        inner = [max(level, _MORE_THAN_ONE) for level in inner]
    if spacing == "equal":
        outer, inner = ([float(math.ceil(x)) for x in levels] for levels in (outer, inner))
    return [EdgeSteps(level, spacing) for level in outer], [
        EdgeSteps(level, spacing) for level in inner
    ]


def _clamped(level: float, least: float, most: float) -> float:
    return min(max(level, least), most) if level > least else least


def _fixed(level: float) -> int:
    """A level in units of places, to the nearest even one."""
    return round(level * ONE)


def _reciprocal(segments: int) -> int:
    return (2 * ONE + segments) // (2 * segments) if segments else 0


def _without_highest_bit(number: int) -> int:
    return number - (1 << number.bit_length() - 1) if number else 0

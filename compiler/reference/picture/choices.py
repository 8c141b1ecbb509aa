"""Computes something for every choice of whole numbers that a device may make, and their hull.

A texel's index, a layer or a level is a whole number that follows from a coordinate. Where the
coordinate's interval contains several, a device may have any of them. That is so for few pixels,
so each pixel is computed once with the numbers of its exact value, and only those pixels once more
for each other choice.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..bounds import Bounded, exact, hull
from .scene import Floats, Ints

MOST = 64
"""The most choices that are tried for a pixel; if there are more, it may have any texel."""
_AT_ONCE = 1 << 14
"""About how many further choices are computed at once, which limits memory."""

Part = slice | Ints
"""The pixels for which something is computed."""
ALL: Part = slice(None)


@dataclass(frozen=True, slots=True)
class Choice:
    """A whole number for each pixel, from ``first`` to ``last``; ``home`` is the exact value's.

    Arrays are (pixels,), or single numbers. If ``first is last``, no pixel has a choice.
    """

    home: Ints
    first: Ints
    last: Ints

    @property
    def is_sure(self) -> bool:
        """True if no pixel has a choice."""
        return self.first is self.last

    def mapped(self, change: Callable[[Ints], Ints]) -> Choice:
        """The choice with its numbers changed by a function that never decreases."""
        if self.is_sure:
            return sure(change(self.home))
        return Choice(*map(change, (self.home, self.first, self.last)))

    def limited(self, least: Any, most: Any) -> Choice:
        """The choice between the nearest numbers in a range."""
        return self.mapped(lambda number: np.clip(number, least, most))

    def at(self, part: Part) -> Choice:
        """The choices of some pixels."""
        return self.mapped(lambda number: at(part, number))

    @staticmethod
    def of(lane: Bounded) -> Choice:
        """The whole numbers that a lane of integers may be."""
        if lane.is_exact:
            return sure(lane.value)
        return Choice(lane.value, lane.low, lane.high)


def sure(number: Any) -> Choice:
    """A number without a choice."""
    home = np.asarray(number, dtype=np.int64)
    return Choice(home, home, home)


def at(part: Part, array: Any) -> Any:
    """The elements for some pixels, of an array (…, pixels) or of a single number."""
    return array if isinstance(part, slice) or not np.ndim(array) else array[..., part]


def lane_at(part: Part, lane: Bounded) -> Bounded:
    """The lane of some pixels."""
    return lane if isinstance(part, slice) else lane.mapped(lambda array: at(part, array))


Compute = Callable[[Part, list[Ints]], Bounded]
"""Computes lanes (lanes, pixels) for some pixels, with one number of each choice."""
Anything = Callable[[Ints], tuple[Floats, Floats]]
"""The least and the greatest that some pixels may have, whatever is chosen."""


def hull_of_choices(choices: Sequence[Choice], compute: Compute, anything: Anything) -> Bounded:
    """The value for the choices of the exact value, and the hull for all choices together."""
    found = compute(ALL, [choice.home for choice in choices])
    unsure = [choice for choice in choices if not choice.is_sure]
    if not unsure:
        return found
    counts = [np.minimum(each.last - each.first, MOST) + 1 for each in unsure]
    total = np.asarray(np.multiply.reduce(counts))
    wide = np.flatnonzero(total > MOST)
    several = np.flatnonzero((total > 1) & (total <= MOST))
    for pixels in _portions(several, total[several]):
        owner, numbers = _others(choices, pixels, total[pixels])
        found = with_hull(found, owner, compute(owner, numbers))
    if len(wide):
        low, high = anything(wide)
        found = with_hull(found, wide, Bounded(low, low, high))
    return found


def with_hull(found: Bounded, owner: Part, more: Bounded) -> Bounded:
    """The lanes (lanes, pixels), with further possible values of a device in some of the pixels.

    ``owner`` says which pixel each of ``more`` belongs to, in ascending order.
    """
    if isinstance(owner, slice):
        return hull(found, more)
    if not len(owner):
        return found
    begins = np.flatnonzero(np.diff(owner, prepend=-1))
    pixels = owner[begins]
    low, high = np.array(found.low), np.array(found.high)
    least = np.minimum.reduceat(more.low, begins, axis=-1)
    greatest = np.maximum.reduceat(more.high, begins, axis=-1)
    low[..., pixels] = np.minimum(low[..., pixels], least)
    high[..., pixels] = np.maximum(high[..., pixels], greatest)
    return Bounded(found.value, low, high)


def replaced(found: Bounded, pixels: Ints, more: Bounded) -> Bounded:
    """The lanes (lanes, pixels), with other ones for some pixels."""
    value = np.array(found.value)
    value[..., pixels] = more.value
    if found.is_exact and more.is_exact:
        return exact(value)
    low, high = np.array(found.low), np.array(found.high)
    low[..., pixels], high[..., pixels] = more.low, more.high
    return Bounded(value, low, high)


def _portions(pixels: Ints, total: Ints) -> list[Ints]:
    """The pixels in groups that have about as many choices as are computed at once."""
    if not len(pixels):
        return []
    group = np.cumsum(total) // _AT_ONCE
    return np.split(pixels, np.flatnonzero(np.diff(group)) + 1)


def _others(choices: Sequence[Choice], pixels: Ints, total: Ints) -> tuple[Ints, list[Ints]]:
    """Every choice of some pixels but that of the exact value, and the pixel that each is for."""
    owner = np.repeat(pixels, total)
    begins = np.cumsum(total) - total
    turn = np.arange(len(owner)) - np.repeat(begins, total)
    numbers: list[Ints] = []
    is_other = np.zeros(len(owner), dtype=np.bool_)
    for choice in choices:
        first, last, home = (at(owner, each) for each in (choice.first, choice.last, choice.home))
        turn, step = np.divmod(turn, last - first + 1)
        numbers.append(first + step)
        is_other |= numbers[-1] != home
    return owner[is_other], [number[is_other] for number in numbers]

"""The array library with which kernels are evaluated whose work groups join values.

``kernel.py`` makes one for each run. Its arrays have an element for each invocation; so many of
these, one after the other, are a work group. The last group may have fewer.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .bounds import Bounded, Bounds, Errors
from .bounds.bounded import as_bounded
from .namespace import Binary, WorkGroups


class InGroups(Bounds, WorkGroups):
    """Lanes with bounds, one for each of ``count`` invocations in groups of ``size``."""

    def __init__(self, errors: Errors, count: int, size: int) -> None:
        super().__init__(errors)
        self._count, self._size = count, size
        self._index = np.arange(count)
        self._place = self._index % size
        first = self._index - self._place
        self._present = np.minimum(count - first, size)
        """How many invocations the group of each one has."""

    def all_joined(self, join: Binary, x: Any) -> Bounded:
        """Pairs are joined, the second half of a group with the first one, until one is left."""
        found = self._of_each(x)
        reach = _power_of_two(self._size) // 2
        while reach:
            joins = (self._place < reach) & (self._place + reach < self._present)
            later = found.take(np.minimum(self._index + reach, max(self._count - 1, 0)), 0)
            found = self.where(joins, join(found, later), found)
            reach //= 2
        return found.take(self._index - self._place, 0)

    def joined_through(self, join: Binary, x: Any) -> Bounded:
        """What is before is joined from a distance of 1, then of 2, of 4 … (Hillis and Steele)."""
        found = self._of_each(x)
        reach = 1
        while reach < self._size:
            earlier = found.take(np.maximum(self._index - reach, 0), 0)
            found = self.where(self._place >= reach, join(earlier, found), found)
            reach *= 2
        return found

    def at_the_one_before(self, x: Any, first: Any) -> Bounded:
        """A shift by one invocation."""
        before = self._of_each(x).take(np.maximum(self._index - 1, 0), 0)
        found: Bounded = self.where(self._place > 0, before, np.full_like(before.value, first))
        return found

    def anywhere(self, condition: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Whether a condition holds anywhere in the group of each invocation."""
        group = self._index // self._size
        found: NDArray[np.bool_] = np.bincount(group, condition)[group] > 0
        return found

    def _of_each(self, x: Any) -> Bounded:
        """The lane with an element for each invocation, also where all have the same."""
        return as_bounded(x).spread((self._count,))


def _power_of_two(number: int) -> int:
    """The least power of two that is not below a number."""
    return 1 << (number - 1).bit_length()

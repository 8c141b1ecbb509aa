"""The array libraries with which kernels are evaluated whose work groups join values.

``kernel.py`` makes one for each run: with bounds, or with plain arrays. Its arrays have an element
for each invocation; so many of these, one after the other, are a work group. The last group may
have fewer.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .bounds import Bounded, Bounds, Errors
from .bounds.bounded import as_bounded
from .namespace import Binary, Lane, WorkGroups


class Groups(WorkGroups):
    """Joins the values of ``count`` invocations, in groups of ``size``."""

    def __init__(self, count: int, size: int) -> None:
        self._count, self._size = count, size
        self._index = np.arange(count)
        self._place = self._index % size
        first = self._index - self._place
        self._present = np.minimum(count - first, size)
        """The number of invocations of the group of each one."""

    @abstractmethod
    def where(self, condition: Any, x: Any, y: Any, /) -> Lane:
        """The choice of the array library."""

    @abstractmethod
    def _of_each(self, x: Lane) -> Lane:
        """The lane with an element for each invocation, also where all have the same."""

    def all_joined(self, join: Binary, x: Lane) -> Lane:
        """Pairs are joined, the second half of a group with the first one, until one is left."""
        found = self._of_each(x)
        reach = _power_of_two(self._size) // 2
        while reach:
            joins = (self._place < reach) & (self._place + reach < self._present)
            later = found.take(np.minimum(self._index + reach, max(self._count - 1, 0)), 0)
            found = self.where(joins, join(found, later), found)
            reach //= 2
        return found.take(self._index - self._place, 0)

    def joined_through(self, join: Binary, x: Lane) -> Lane:
        """Joins with earlier lanes at a distance of 1, then of 2, of 4 … (Hillis and Steele)."""
        found = self._of_each(x)
        reach = 1
        while reach < self._size:
            earlier = found.take(np.maximum(self._index - reach, 0), 0)
            found = self.where(self._place >= reach, join(earlier, found), found)
            reach *= 2
        return found

    def at_the_one_before(self, x: Lane, first: Lane) -> Lane:
        """A shift by one invocation."""
        found = self._of_each(x)
        before = found.take(np.maximum(self._index - 1, 0), 0)
        at_first = np.full_like(found.value if isinstance(found, Bounded) else found, first)
        return self.where(self._place > 0, before, at_first)

    def anywhere(self, condition: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """True where a condition holds anywhere in the group of an invocation."""
        group = self._index // self._size
        found: NDArray[np.bool_] = np.bincount(group, condition)[group] > 0
        return found


class InGroups(Bounds, Groups):
    """Lanes with bounds."""

    def __init__(self, errors: Errors, count: int, size: int) -> None:
        Bounds.__init__(self, errors)
        Groups.__init__(self, count, size)

    def _of_each(self, x: Any) -> Bounded:
        return as_bounded(x).spread((self._count,))


class PlainInGroups(Groups):
    """Plain arrays: all that is not of groups are NumPy's functions."""

    def where(self, condition: Any, x: Any, y: Any, /) -> Lane:
        return np.where(condition, x, y)

    def __getattr__(self, name: str) -> Any:
        return getattr(np, name)

    def _of_each(self, x: Any) -> NDArray[Any]:
        return np.broadcast_to(x, (self._count,))


def _power_of_two(number: int) -> int:
    """The least power of two that is not below a number."""
    return 1 << (number - 1).bit_length()

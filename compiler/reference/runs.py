"""Asks for the least or the largest of neighbouring numbers, and joins values with neighbours.

A run of neighbours is covered by two of a length that is a power of two (Bender and Farach-Colton,
"The LCA Problem Revisited", 2000), so a long run takes no more time than a short one. Runs are
where rounding may tip which element is read (``storage_buffers.py``) or scattered to
(``scattering.py``).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


class Extremes:
    """The least, or the largest, of each run of some numbers."""

    def __init__(self, choose: np.ufunc, numbers: Array) -> None:
        """``choose`` is NumPy's ``minimum`` or ``maximum``."""
        self._choose = choose
        self._levels = [numbers]
        """The extremes of runs for each exponent of two as length: one begins at each number."""

    def of(self, first: Array, last: Array) -> Array:
        """The extremes of many runs at once, which have at least one number."""
        first, last = np.broadcast_arrays(first, last)
        found = np.empty(first.shape, self._levels[0].dtype)
        for exponent, here in _by_length(first, last):
            level = self._level(exponent)
            ends = level[first[here]], level[last[here] + 1 - (1 << exponent)]
            found[here] = self._choose(*ends)
        return found

    def _level(self, exponent: int) -> Array:
        while len(self._levels) <= exponent:
            half, shorter = 1 << (len(self._levels) - 1), self._levels[-1]
            self._levels.append(self._choose(shorter[:-half], shorter[half:]))
        return self._levels[exponent]


def joined_with_runs(
    join: np.ufunc, neutral: int, numbers: Array, first: Array, last: Array, values: Array
) -> Array:
    """Numbers, each of them joined with the values of all runs that it is in.

    Joining twice must be the same as joining once. Joining with ``neutral`` changes nothing.
    """
    rows = dict(_by_length(first, last))
    found = np.full_like(numbers, neutral)
    for exponent in range(max(rows, default=-1), -1, -1):
        if exponent in rows:
            here = rows[exponent]
            join.at(found, first[here], values[here])
            join.at(found, last[here] + 1 - (1 << exponent), values[here])
        if exponent:
            # A run is the two halves that begin where it does and in its middle.
            half = 1 << (exponent - 1)
            halves = found.copy()
            halves[half:] = join(halves[half:], found[:-half])
            found = halves
    joined: Array = join(numbers, found)
    return joined


def added_to_runs(numbers: Array, first: Array, last: Array, values: Array) -> Array:
    """Numbers, to each of which the values of all runs are added that it is in."""
    steps = np.zeros(len(numbers) + 1, numbers.dtype)
    np.add.at(steps, first, values)
    np.subtract.at(steps, last + 1, values)
    added: Array = numbers + np.cumsum(steps[:-1])
    return added


def _by_length(first: Array, last: Array) -> list[tuple[int, Array]]:
    """The runs by length: at least a power of two, and less than twice as long.

    Each group comes with the exponent.
    """
    _, above = np.frexp((last - first + 1).astype(np.float64))
    return [(int(each) - 1, above == each) for each in np.unique(above)]

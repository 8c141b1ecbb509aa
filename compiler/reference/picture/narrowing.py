"""Narrows the bounds of pixels that are wide, by the cases of their decisions.

``drawing.py`` calls it for the pixels that it has just shaded. Few are wide, and only these are
evaluated again, once for each combination of what their decisions may be.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..bounds import as_bounded
from ..bounds.deciding import MOST
from ..namespace import Lanes
from .scene import Bools, Floats, Ints

WIDE = 2.0**-4
"""The part of the largest magnitude of a lane from which its bounds are wide."""
FEW, FEW_OF = 40, 1 / 16
"""As many pixels, or this part of those that are shaded at once, may be wide: they prove enough."""
TRIED = 32
"""The number of quads that are tried first."""
PAYS = 0.875
"""The others are evaluated if not more than this part of the pixels that were tried stay wide."""

CasesOf = Callable[[Ints, Ints], tuple[list[Lanes], Ints]]
"""A function that evaluates the quads of these numbers, each in the case of a number.

It returns the targets, and how many decisions each pixel has.
"""
EVERY = 2**MOST
"""The number of cases of a pixel with the most decisions."""


@dataclass(frozen=True, slots=True)
class Colours:
    """What pixels were found to have."""

    targets: Sequence[Floats]
    """(3, pixels, 4) for each target: values and their ends, which are narrowed in place."""
    lane: Ints
    """(pixels,): the number of each one's lane among those of all quads."""
    side: int


def narrow(found: Colours, evaluated: CasesOf) -> None:
    """Narrow the bounds of pixels that are wide, unless they are few.

    Some of them are tried first, and show whether it pays.
    """
    if not found.targets:
        return
    wide = _any_wide(found)
    if np.count_nonzero(wide) <= max(FEW, FEW_OF * len(wide)):
        return
    of_quad = found.lane // found.side**2
    quads = np.unique(of_quad[wide])
    tried = quads[:: -(-len(quads) // TRIED)]
    some = np.isin(of_quad, tried) & wide
    _narrow(found, evaluated, some, tried)
    if np.count_nonzero(some & _any_wide(found)) <= PAYS * np.count_nonzero(some):
        _narrow(found, evaluated, wide & ~some, np.setdiff1d(quads, tried))


def _narrow(found: Colours, evaluated: CasesOf, some: Bools, quads: Ints) -> None:
    """Narrow the bounds of some pixels, which are in these quads."""
    size = found.side**2
    quad, pixel = np.divmod(found.lane[some], size)
    at = np.searchsorted(quads, quad), pixel
    limits = [_limits(target) for target in found.targets]
    ends = _ends(evaluated, quads, limits, found.side)
    for target, (low, high) in zip(found.targets, ends, strict=True):
        known = low[at] <= high[at]
        target[1, some] = np.where(known, np.fmax(target[1, some], low[at]), target[1, some])
        target[2, some] = np.where(known, np.fmin(target[2, some], high[at]), target[2, some])


def _any_wide(found: Colours) -> Bools:
    wide: Bools = np.logical_or.reduce([_wide(target) for target in found.targets])
    return wide


def _wide(target: Floats) -> Bools:
    """(pixels,): where some lane has wide bounds."""
    _value, low, high = target
    wide: Bools = (~(high - low <= _limits(target))).any(axis=-1)
    return wide


def _limits(target: Floats) -> Floats:
    """(4,): how far apart the bounds of a lane may be that is not wide."""
    value = target[0]
    limits: Floats = WIDE * np.where(np.isfinite(value), np.abs(value), 0.0).max(
        axis=0, initial=0.0
    )
    return limits


def _ends(
    evaluated: CasesOf, quads: Ints, limits: Sequence[Floats], side: int
) -> list[tuple[Floats, Floats]]:
    """The ends of each target by all cases, (pixels, lanes), for all pixels of some quads.

    Cases only widen them, so quads that are as wide as ``limits`` are left, and nothing is known of
    them.
    """
    shape = len(quads), side**2, 4
    found = [(np.full(shape, np.inf), np.full(shape, -np.inf)) for _ in limits]
    most, first = np.zeros(len(quads), np.int64), 0
    left = np.arange(len(quads))
    # Of few quads, all cases together take hardly longer than one.
    at_once = EVERY if len(quads) <= TRIED else 1
    while len(left):
        numbers = range(first, first + at_once)
        targets, counts = evaluated(np.repeat(numbers, len(left)), np.tile(quads[left], at_once))
        for lanes, ends in zip(targets, found, strict=True):
            _join(ends, left, lanes, at_once)
        wide = [
            (high[left] - low[left] > limit).any(axis=-1)
            for limit, (low, high) in zip(limits, found, strict=True)
        ]
        hopeless = np.logical_or.reduce(wide).all(axis=-1)
        for low, high in found:
            low[left[hopeless]], high[left[hopeless]] = -np.inf, np.inf
        of_quads = counts.reshape(at_once, len(left), -1).max(axis=(0, -1))
        most[left] = np.maximum(most[left], of_quads)
        first += at_once
        left = left[~hopeless & (first < 2 ** np.minimum(most[left], MOST))]
    return found


def _join(found: tuple[Floats, Floats], quads: Ints, lanes: Lanes, cases: int) -> None:
    """Widens the ends of some quads by those of some cases; of missing lanes nothing is known."""
    low, high = found
    pixels = low.shape[1]
    for k, lane in enumerate(map(as_bounded, lanes)):
        least, largest = (
            np.broadcast_to(end, (cases * len(quads), *_square(pixels))).reshape(cases, -1, pixels)
            for end in (lane.low, lane.high)
        )
        # Ends that are NaN say nothing.
        least = np.where(np.isnan(least), -np.inf, least).min(axis=0)
        largest = np.where(np.isnan(largest), np.inf, largest).max(axis=0)
        low[quads, :, k] = np.minimum(low[quads, :, k], least)
        high[quads, :, k] = np.maximum(high[quads, :, k], largest)


def _square(pixels: int) -> tuple[int, int]:
    side = round(pixels**0.5)
    return side, side

"""Proves that two programs are equal in parts of the space of their variables (branch and bound).

A box in which the bounds of the difference are not tight enough is halved, along the variable to
which most of the difference may be due. The search goes on until nothing is left, or until so many
boxes have been looked at as its caller allows.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...support.frozen import frozen
from .boxes import Bound, Region, bound
from .numbers import Array

MOST_NUMBERS = 4_000_000
"""The most numbers that the boxes of one step take, for each end."""
MOST_AT_ONCE = 256
_NARROWEST = 2.0**-40
"""The width of boxes, as a part of the range, that are not halved any more."""


@frozen
class Proof:
    """What was proven of a region."""

    proven: float
    """The share of the space in which both are equal, from 0 to 1."""
    bound: float
    """The largest difference that there may be in what is proven."""
    boxes: int
    """The number of boxes that were looked at."""
    open_low: tuple[float, ...] = ()
    """The ends of the largest box that is not proven, for each variable."""
    open_high: tuple[float, ...] = ()
    open_bound: float = 0.0
    """The largest difference that there may be in all that is not proven."""

    @property
    def is_complete(self) -> bool:
        """True if nothing is left open."""
        return not self.open_low


Look = Callable[[Array, Array], bool]
"""Called with the ends of boxes that are open; returns True to end the search."""


def subdivided(
    region: Region,
    epsilon: float,
    most: int,
    look: Look = lambda _low, _high: False,
    tell: Callable[[float], None] = lambda _share: None,
) -> Proof:
    """Proves as much of a region as ``most`` boxes allow."""
    # Of ranges without an end nothing is known; their numbers are no warning.
    with np.errstate(all="ignore"):
        search = _Search(region, epsilon)
        while search.goes_on(most):
            search.step(look)
            tell(search.proven)
            if search.is_ended:
                break
        return search.proof()


class _Search:
    def __init__(self, region: Region, epsilon: float) -> None:
        self._region, self._epsilon = region, epsilon
        spans = [term.span for term in region.variables]
        self._low = np.array([[span.low] for span in spans], np.float64).reshape(-1, 1)
        self._high = np.array([[span.high] for span in spans], np.float64).reshape(-1, 1)
        self._is_whole = np.array([term.kind != "f" for term in region.variables], bool)
        self._width = np.maximum(self._high - self._low, 1e-300)
        self._share = np.ones(1)
        self._bound = bound(region, self._low, self._high, epsilon)
        self._stuck: list[tuple[Array, Array, float, float]] = []
        """Boxes that are too narrow: their ends, shares and bounds."""
        self.proven, self._largest, self._boxes = 0.0, 0.0, 1
        self.is_ended = False
        size = (len(region.inside) + 1) * (len(region.variables) + 4)
        self._at_once = int(np.clip(MOST_NUMBERS // size, 1, MOST_AT_ONCE))
        self._settle()

    def goes_on(self, most: int) -> bool:
        """True if a box is open, and more may be looked at."""
        return bool(len(self._share)) and self._boxes < most

    def step(self, look: Look) -> None:
        """Halves the largest boxes."""
        order = np.argsort(-self._share, kind="stable")
        chosen, rest = order[: self._at_once], order[self._at_once :]
        low, high = self._low[:, chosen], self._high[:, chosen]
        if look(low, high):
            self.is_ended = True
            return
        axis = self._axis(chosen)
        columns = np.arange(len(chosen))
        middle = 0.5 * (low[axis, columns] + high[axis, columns])
        whole = self._is_whole[axis]
        left_end = np.where(whole, np.floor(middle), middle)
        right_end = np.where(whole, np.floor(middle) + 1.0, middle)
        lows, highs = np.repeat(low, 2, axis=1), np.repeat(high, 2, axis=1)
        highs[axis, columns * 2] = left_end
        lows[axis, columns * 2 + 1] = right_end
        count = np.where(whole, high[axis, columns] - low[axis, columns] + 1.0, 1.0)
        part = np.where(whole, (left_end - low[axis, columns] + 1.0) / count, 0.5)
        shares = np.repeat(self._share[chosen], 2)
        shares[0::2] *= part
        shares[1::2] *= 1.0 - part
        made = bound(self._region, lows, highs, self._epsilon)
        self._boxes += len(shares)
        self._low = np.concatenate([self._low[:, rest], lows], axis=1)
        self._high = np.concatenate([self._high[:, rest], highs], axis=1)
        self._share = np.concatenate([self._share[rest], shares])
        self._bound = _joined(_chosen(self._bound, rest), made)
        self._settle()

    def _axis(self, chosen: Array) -> Array:
        """For each box, the variable along which it is halved."""
        low, high = self._low[:, chosen], self._high[:, chosen]
        width = (high - low) / self._width
        slopes = self._bound.slopes[:, chosen]
        open_width = np.where(width > _NARROWEST, width, 0.0)
        total = slopes.sum(axis=0)
        rough = self._bound.share[chosen] > 2.0 * total
        return np.where(
            rough | (total == 0),
            open_width.argmax(axis=0),
            (slopes * (open_width > 0)).argmax(axis=0),
        )

    def _settle(self) -> None:
        """Puts aside what is proven, and what is too narrow to be halved."""
        done = self._bound.share <= 1.0
        self.proven += float(self._share[done].sum())
        self._largest = max(self._largest, float(self._bound.difference[done].max(initial=0.0)))
        width = (self._high - self._low) / self._width
        stuck = ~done & (width.max(axis=0, initial=0.0) <= _NARROWEST)
        for number in np.flatnonzero(stuck):
            self._stuck.append((
                self._low[:, number], self._high[:, number],
                float(self._share[number]), float(self._bound.difference[number]),
            ))  # fmt: skip
        left = np.flatnonzero(~done & ~stuck)
        self._low, self._high = self._low[:, left], self._high[:, left]
        self._share, self._bound = self._share[left], _chosen(self._bound, left)

    def proof(self) -> Proof:
        """What was proven."""
        opened = [
            *self._stuck,
            *zip(self._low.T, self._high.T, self._share, self._bound.difference, strict=True),
        ]
        if not opened:
            return Proof(1.0, self._largest, self._boxes)
        low, high, _, _ = max(opened, key=lambda each: each[2])
        worst = max(float(each[3]) for each in opened)
        proven = min(self.proven, 1.0 - 2.0**-53)
        return Proof(proven, self._largest, self._boxes, tuple(map(float, low)),
                     tuple(map(float, high)), worst)  # fmt: skip


def _chosen(of: Bound, numbers: Array) -> Bound:
    return Bound(of.difference[numbers], of.share[numbers], of.slopes[:, numbers])


def _joined(one: Bound, other: Bound) -> Bound:
    return Bound(
        np.concatenate([one.difference, other.difference]),
        np.concatenate([one.share, other.share]),
        np.concatenate([one.slopes, other.slopes], axis=1),
    )

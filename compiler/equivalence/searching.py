"""Looks for a point at which two programs differ: at random, where comparisons tip, and uphill.

``comparing.py`` asks it before it tries to prove anything, and again inside of boxes for which no
proof was found.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ...support.frozen import frozen
from .exact import exact_values
from .numbers import Array, Numbers, Points
from .points import Places
from .term import Term, below
from .terms import Terms

POINTS = 4096
"""The number of points of one round."""
KEPT = 64
"""The number of points from which the search goes uphill."""
TIMES = 16
"""The number of points that are tried around each of these in a step."""
CLIMBS = 12
MOST_CONDITIONS = 24
HALVINGS = 50
_LARGEST = 3.4e38
"""Beyond this, no device has a number: nothing is compared there."""
_SHRINKING = 0.5
_EDGES = 32
"""The number of points around a difference that tell if it is on the edge of a comparison only."""


@frozen
class Found:
    """A point at which a lane of both programs differs by more than is allowed."""

    lane: int
    """The number of the lane."""
    first: float
    second: float
    seed: int
    """The seed of what textures and buffers hold."""
    values: Mapping[int, float]
    """The numbers of the variables, by their ids."""
    is_edge: bool
    """True if both are alike all around: they differ where compared numbers are equal."""


def allowed(epsilon: float, x: Array, y: Array) -> Array:
    """How much two numbers may differ: ``epsilon`` of the larger one, or of 1."""
    return epsilon * np.maximum(1.0, np.maximum(np.abs(x), np.abs(y)))


class Search:
    """The search for a point at which some lanes of both programs differ."""

    def __init__(
        self, terms: Terms, first: Sequence[Term], second: Sequence[Term], epsilon: float, seed: int
    ) -> None:
        self._terms, self._first, self._second = terms, first, second
        self._epsilon, self._seed = epsilon, seed
        self._cone = below([*first, *second])
        self.places = Places(self._cone, seed)
        self.worst = 0.0
        """The largest difference that was seen, as a part of what is allowed."""
        self.seen = 0
        """The number of points that were tried."""

    def found(self, rounds: int) -> Found | None:
        """A point at which they differ; ``None`` if none was found."""
        for _ in range(rounds):
            self._seed += 1
            points = self.places.points(POINTS)
            found = self.among(points, POINTS) or self._at_edges(points) or self._uphill(points)
            if found is not None:
                return found
        return None

    def among(self, points: Points, count: int) -> Found | None:
        """The point with the largest difference, if that is more than is allowed."""
        share, lane = self._shares(points, count)
        order = np.argsort(share)[::-1][:8]
        edge = None
        for at in order[share[order] > 1.0]:
            one = {id_: np.asarray(each)[[at]] for id_, each in points.items()}
            found = self.confirmed(one, int(lane[at]), self._seed)
            if found is not None and not found.is_edge:
                return found
            edge = edge or found
        return edge

    def _shares(self, points: Points, count: int) -> tuple[Array, Array]:
        """For each point the largest difference of a lane, as a part of what is allowed."""
        numbers = Numbers(points, count, seed=self._seed)
        first, second = numbers.of(self._first), numbers.of(self._second)
        self._numbers = numbers
        self.seen += count
        worst, lane = np.zeros(count), np.zeros(count, np.int64)
        for number, (x, y) in enumerate(zip(first, second, strict=True)):
            share = _share(x, y, self._epsilon)
            lane = np.where(share > worst, number, lane)
            worst = np.maximum(share, worst)
        self.worst = max(self.worst, float(worst.max(initial=0.0)))
        return worst, lane

    def _uphill(self, points: Points) -> Found | None:
        """Points around those with the largest differences, nearer and nearer."""
        share, _ = self._shares(points, POINTS)
        scale = 0.25
        for _ in range(CLIMBS):
            best = np.argsort(share)[::-1][:KEPT]
            if not share[best[0]] > 0:
                return None
            points = self.places.around(points, best, TIMES, scale)
            found = self.among(points, KEPT * TIMES)
            if found is not None:
                return found
            share, _ = self._shares(points, KEPT * TIMES)
            scale *= _SHRINKING
        return None

    def _at_edges(self, points: Points) -> Found | None:
        """Points where a comparison tips, and just before."""
        numbers = Numbers(points, POINTS, seed=self._seed)
        conditions = [term for term in self._cone if term.op in ("less", "equal")]
        for term in conditions[-MOST_CONDITIONS:]:
            (holds,) = numbers.of([term])
            if holds.all() or not holds.any():
                continue
            there = self.places.between(points, holds, HALVINGS, term)
            count = len(next(iter(there.values())))
            found = self.among(there, count)
            if found is not None:
                return found
        return None

    # --- making sure ------------------------------------------------------------------------------

    def differing(self, point: Points, lane: int, seed: int) -> tuple[float, float] | None:
        """Both numbers of a lane at a point, if they differ in wider floats, too."""
        self._seed = seed
        wide = Numbers({id_: _wide(each) for id_, each in point.items()}, 1, np.longdouble, seed)
        (first,), (second,) = wide.of([self._first[lane]]), wide.of([self._second[lane]])
        x, y = float(first[0]), float(second[0])
        return (x, y) if _share(np.asarray(x), np.asarray(y), self._epsilon) > 1.0 else None

    def confirmed(self, point: Points, lane: int, seed: int) -> Found | None:
        """The point, if it is no error of rounding that makes the difference."""
        both = self.differing(point, lane, seed)
        if both is None:
            return None
        is_edge = not self._differs_around(point, lane)
        if is_edge and not self._is_exact(point, lane):
            return None
        values = {term.id: float(point[term.id][0]) for term in self.places.variables}
        return Found(lane, *both, seed, values, is_edge)

    def _differs_around(self, point: Points, lane: int) -> bool:
        """True if the lane differs at a point close by, too."""
        for scale in (1e-3, 1e-6, 1e-9):
            around = self.places.around(point, np.zeros(1, np.int64), _EDGES, scale, by_all=True)
            numbers = Numbers(around, _EDGES, seed=self._seed)
            # The textures' numbers are those of the first point only at that point.
            (x,), (y,) = numbers.of([self._first[lane]]), numbers.of([self._second[lane]])
            if (_share(x, y, self._epsilon)[1:] > 1.0).any():
                return True
        return not self.places.variables

    def _is_exact(self, point: Points, lane: int) -> bool:
        """True if exact arithmetic gives different numbers as well."""
        values = {id_: np.asarray(each)[0] for id_, each in point.items()}
        found = exact_values([self._first[lane], self._second[lane]], values)
        if found is None:
            return False
        x, y = (np.asarray(float(each)) for each in found)
        return bool(_share(x, y, self._epsilon) > 1.0)


def _wide(values: Array) -> Array:
    array = np.asarray(values)
    return array.astype(np.longdouble) if array.dtype.kind == "f" else array


def _share(x: Array, y: Array, epsilon: float) -> Array:
    """The difference as a part of what is allowed; 0 where a number is beyond those of devices."""
    x, y = np.asarray(x, np.float64), np.asarray(y, np.float64)
    counts = (np.abs(x) <= _LARGEST) & (np.abs(y) <= _LARGEST)
    with np.errstate(all="ignore"):
        return np.where(counts, np.abs(x - y) / allowed(epsilon, x, y), 0.0)

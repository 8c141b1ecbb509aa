"""Points at which two programs are compared: random ones, and those where mistakes show.

Mistakes show at the ends of ranges, at zero, at defaults, and where a comparison tips. Of each
variable some points have such a number, and all others a random one.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from .numbers import Array, Numbers, Points
from .term import Term, value_of

NEAR = 0.01
"""The distance of a value at a neighbouring pixel, as a part of the range."""
_CLOSE = (1e-1, 1e-2, 1e-4, 1e-7)
"""The distances from a special number, as parts of the range, that are tried."""


class Places:
    """Makes points for the variables of some terms."""

    def __init__(self, terms: Sequence[Term], seed: int) -> None:
        """``terms`` are all that matter, with the variables among them."""
        self.variables = [term for term in terms if term.op == "variable"]
        self._chance = np.random.default_rng(seed)
        self._special = _special_numbers(terms)

    def points(self, count: int, boldness: float = 1.0) -> dict[int, Array]:
        """So many points; the first one has all defaults.

        Up to a share of ``boldness`` of a point's numbers are special ones.
        """
        shares = self._chance.uniform(0.0, boldness, count)
        found = {}
        for term in self.variables:
            found[term.id] = self._numbers(term, count, shares)
        return self._settled(found)

    def around(
        self, points: Points, best: Array, times: int, scale: float, *, by_all: bool = False
    ) -> dict[int, Array]:
        """Points near some of those that are given; the first of each is one of these.

        With ``by_all``, all variables change, and not only some of them.
        """
        found = {}
        count = len(best) * times
        moved = self._chance.uniform(0.0, 1.0, (len(self.variables), count))
        rate = np.ones(count) if by_all else self._chance.uniform(0.0, 1.0, count)
        for number, term in enumerate(self.variables):
            variable = term.data
            base = np.repeat(np.asarray(points[term.id])[best], times)
            if variable.kind == "f":
                width = (variable.high - variable.low) * scale
                step = self._chance.normal(0.0, 1.0, count) * width
                step = np.where(moved[number] < rate, step, 0.0)
                step[::times] = 0.0
                base = np.clip(base + step, variable.low, variable.high)
            found[term.id] = base
        return self._settled(found)

    def between(self, points: Points, holds: Array, steps: int, of: Term) -> dict[int, Array]:
        """Points on both sides of the places where a condition tips, found by halving."""
        yes, no = np.flatnonzero(holds), np.flatnonzero(~holds)
        count = min(len(yes), len(no), 16)
        yes, no = self._chance.permutation(yes)[:count], self._chance.permutation(no)[:count]
        one = {id_: np.asarray(each)[yes] for id_, each in points.items()}
        other = {id_: np.asarray(each)[no] for id_, each in points.items()}
        for _ in range(steps):
            middle = {id_: _middle(one[id_], other[id_]) for id_ in one}
            (there,) = Numbers(middle, count).of([of])
            one = {id_: np.where(there, middle[id_], one[id_]) for id_ in one}
            other = {id_: np.where(there, other[id_], middle[id_]) for id_ in other}
        return {id_: np.concatenate([one[id_], other[id_]]) for id_ in one}

    def _numbers(self, term: Term, count: int, boldness: Array) -> Array:
        """The numbers of one variable."""
        variable, chance = term.data, self._chance
        low, high = variable.low, variable.high
        if variable.kind == "b":
            return chance.uniform(0.0, 1.0, count) < 0.5
        found = chance.uniform(low, high, count)
        ends = [low, high, *(value for value in (0.0, 1.0) if low <= value <= high)]
        ends += [variable.default] * 2 if variable.default is not None else []
        ends += self._special.get(term.id, [])
        special = np.asarray(ends)[chance.integers(0, len(ends), count)]
        near = chance.choice(_CLOSE, count) * (high - low) * chance.uniform(-1.0, 1.0, count)
        special = np.where(chance.uniform(0.0, 1.0, count) < 0.5, special, special + near)
        found = np.where(chance.uniform(0.0, 1.0, count) < boldness * 0.8, special, found)
        found = np.clip(found, low, high)
        if variable.default is not None:
            found[: max(1, count // 16)] = np.clip(variable.default, low, high)
        return np.rint(found).astype(np.int64) if variable.kind == "i" else found

    def _settled(self, points: dict[int, Array]) -> dict[int, Array]:
        """The points with vectors of length one, and values at neighbours near a pixel's own."""
        vectors: dict[str, list[Term]] = {}
        by_name = {term.data.name: term for term in self.variables}
        for term in self.variables:
            if term.data.vector:
                vectors.setdefault(term.data.vector, []).append(term)
            own = by_name.get(term.data.near)
            if own is not None and term.data.kind == "f":
                is_first = term.data.name.endswith("0")
                step = (points[term.id] - own.data.low) * (0.0 if is_first else NEAR)
                points[term.id] = points[own.id] + step
        for lanes in vectors.values():
            length = np.sqrt(sum(points[lane.id] ** 2 for lane in lanes))
            for number, lane in enumerate(lanes):
                unit = points[lane.id] / np.where(length == 0, 1.0, length)
                points[lane.id] = np.where(length == 0, 1.0 if number == 0 else 0.0, unit)
        return points


def _middle(x: Array, y: Array) -> Array:
    if x.dtype == bool:
        return x
    return (x + y) // 2 if x.dtype.kind == "i" else 0.5 * (x + y)


def _special_numbers(terms: Iterable[Term]) -> dict[int, list[float]]:
    """The numbers with which variables are compared, by the ids of the variables."""
    found: dict[int, list[float]] = {}
    for term in terms:
        if term.op not in ("less", "equal", "min", "max"):
            continue
        for one, other in (term.args, term.args[::-1]):
            value = value_of(one)
            if value is None:
                continue
            variable, factor = _scaled(other)
            if variable is not None and factor:
                found.setdefault(variable.id, []).append(float(value) / factor)
    return found


def _scaled(term: Term) -> tuple[Term | None, float]:
    """The variable of which a term is a multiple, and the factor; ``None`` if it is none."""
    factor = 1.0
    while term.op in ("mul", "float"):
        by = value_of(term.args[0]) if term.op == "mul" else None
        if term.op == "mul" and by is None:
            return None, factor
        factor *= float(by) if by is not None else 1.0
        term = term.args[-1]
    return (term if term.op == "variable" else None), factor

"""Makes a point at which two programs differ simple: defaults, zeros and short numbers.

A person reads it. ``comparing.py`` calls ``simplest`` with a point that the search has found.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from .numbers import Array
from .searching import Found, Search
from .term import Term

MOST_TRIALS = 300
"""The number of simpler points that are tried."""
_PLACES = (0, 1, 2, 3, 4)
"""The decimal places to which numbers are rounded, if both programs still differ there."""
Values = Mapping[int, float]


class _Trials:
    def __init__(self, search: Search, found: Found) -> None:
        self._search, self._found = search, found
        self.values = dict(found.values)
        self._left = MOST_TRIALS

    def accepts(self, change: Values) -> bool:
        """True if both programs differ in the same lane after a change, which then stays."""
        values = {**self.values, **change}
        if values == self.values:
            return True
        if self._left <= 0:
            return False
        self._left -= 1
        if not self._differs(values):
            return False
        self.values = values
        return True

    def _differs(self, values: Values) -> bool:
        found, point = self._found, self._point(values)
        if found.is_edge:
            return self._search.confirmed(point, found.lane, found.seed) is not None
        return self._search.differing(point, found.lane, found.seed) is not None

    def _point(self, values: Values) -> dict[int, Array]:
        return {term.id: _array(term, values[term.id]) for term in self._search.places.variables}

    def result(self) -> Found:
        """The simplest point that was found."""
        found = self._found
        other = self._search.confirmed(self._point(self.values), found.lane, found.seed)
        return found if other is None or other.is_edge != found.is_edge else other


def simplest(search: Search, found: Found) -> Found:
    """A simpler point at which both programs differ, too."""
    trials = _Trials(search, found)
    groups = list(_groups(search.places.variables))
    _to_start(trials, groups)
    for group in groups:
        (term, *others) = group
        if others or term.kind != "f" or term.data.near:
            continue
        value = trials.values[term.id]
        for places in _PLACES:
            rounded = round(value, places)
            inside = term.span.low <= rounded <= term.span.high
            if rounded == value or (inside and trials.accepts({term.id: rounded})):
                break
    return trials.result()


def _groups(variables: Sequence[Term]) -> Iterator[list[Term]]:
    """The variables, those of one vector of length one together."""
    vectors: dict[str, list[Term]] = {}
    for term in variables:
        if term.data.vector:
            vectors.setdefault(term.data.vector, []).append(term)
        else:
            yield [term]
    yield from vectors.values()


def _to_start(trials: _Trials, groups: list[list[Term]]) -> None:
    """Sets as many variables as possible to what they start with: all, or else by halves."""
    pending = [groups]
    while pending:
        some = pending.pop()
        change = {term.id: value for group in some for term, value in _starts(group)}
        if not some or trials.accepts(change) or len(some) == 1:
            continue
        middle = len(some) // 2
        pending += [some[:middle], some[middle:]]


def _starts(group: list[Term]) -> Iterator[tuple[Term, float]]:
    for term in group:
        yield term, start_of(term)


def start_of(term: Term) -> float:
    """What a variable is as long as nothing else is wanted: its default, or near zero.

    A vector of length one points along z.
    """
    default = term.data.default
    if term.data.vector:
        return float(term.data.name.endswith(".z"))
    if default is not None and term.span.low <= default <= term.span.high:
        return float(default)
    return float(min(max(0.0, term.span.low), term.span.high))


def _array(term: Term, value: float) -> Array:
    kinds = {"b": bool, "i": np.int64, "f": np.float64}
    return np.asarray([value]).astype(kinds[term.kind])

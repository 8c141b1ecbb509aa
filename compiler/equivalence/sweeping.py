"""Finds terms of one program that are equal to terms of the other, from the leaves to the results.

So do checkers of circuits ("SAT sweeping"; Kuehlmann and Krohm, "Equivalence Checking Using Cuts
and Heaps", 1997). Two terms that are alike at many random points are probably equal. If algebra
proves it, the second program gets the first one's term in place of its own, and from there up both
are one graph. A program that was changed at one place then differs at this place only.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

import numpy as np

from .numbers import Array, Numbers
from .points import Places
from .polynomials import Algebra
from .products import is_linear
from .term import Term, below
from .terms import Terms

SAMPLES = 48
"""The number of points at which terms have to be alike before algebra is asked."""
DRAWN = 256
"""The number of points of which the best ones are taken."""
MOST_WORK = 400_000
"""The number of products after which algebra is not asked any more."""
MOST_CANDIDATES = 4
_ALIKE = 1e-9
"""The difference, relative to the larger number, up to which values are alike."""


def swept(
    terms: Terms, first: Sequence[Term], second: Sequence[Term], seed: int
) -> tuple[list[Term], list[Term]]:
    """The results of both programs, with one term for each two that are proven to be equal."""
    found = _Sweep(terms, first, second, seed)
    return found.results()


class _Sweep:
    def __init__(
        self, terms: Terms, first: Sequence[Term], second: Sequence[Term], seed: int
    ) -> None:
        self._terms, self._first, self._second = terms, first, second
        cone = below([*first, *second])
        self._numbers = _sampled(cone, seed)
        self._algebra = Algebra(terms)
        ours, theirs = ({term.id for term in below(each)} for each in (first, second))
        self._shared = ours & theirs
        """The ids of terms that both programs have."""
        self._no_sums = {id_ for id_ in self._shared if not is_linear(terms.all[id_])}
        self._classes: dict[tuple[str, int], list[Term]] = defaultdict(list)

    def results(self) -> tuple[list[Term], list[Term]]:
        """Both programs' results."""
        known: dict[int, Term] = {}
        cone = below([*self._first, *self._second])
        simple = [self._terms.constant(0.0), self._terms.constant(1.0)]
        self._numbers.of(simple)
        for term in (*simple, *(term for term in cone if not term.args)):
            known[term.id] = term
            self._note(term)
        for term in cone:
            if term.id not in known:
                known[term.id] = self._merged(term, known)
        first, second = ([known[t.id] for t in each] for each in (self._first, self._second))
        return first, second

    def _merged(self, term: Term, known: dict[int, Term]) -> Term:
        """An older term that is equal, or else the same operation of its new arguments."""
        args = [known[arg.id] for arg in term.args]
        value = self._numbers.known[term.id]
        same = all(new is old for new, old in zip(args, term.args, strict=True))
        new = term if same else self._terms.term(self._terms.make(term.op, args, term.data))
        self._numbers.known.setdefault(new.id, value)
        candidates = self._candidates(new)
        if any(candidate is new for candidate in candidates):
            return new
        for candidate in candidates[:MOST_CANDIDATES]:
            if self._are_equal(new, candidate):
                new_ones = below([candidate], self._shared)
                self._shared.update(each.id for each in new_ones)
                self._no_sums.update(each.id for each in new_ones if not is_linear(each))
                return candidate
        self._note(new)
        return new

    def _are_equal(self, new: Term, candidate: Term) -> bool:
        if self._algebra.work >= MOST_WORK:
            return False
        return self._algebra.are_equal(new, candidate, (self._shared, self._no_sums))

    def _candidates(self, term: Term) -> list[Term]:
        """The terms that are alike at all points."""
        value = self._value(term)
        if value is None:
            return []
        found = {
            other.id: other
            for key in _keys(term, value)
            for other in self._classes.get(key, ())
            if _are_alike(value, self._value(other))
        }
        return list(found.values())

    def _note(self, term: Term) -> None:
        """Let a term be found by the numbers that it has."""
        value = self._value(term)
        if value is not None:
            for key in _keys(term, value):
                self._classes[key].append(term)

    def _value(self, term: Term) -> Array | None:
        """The term's numbers; ``None`` if some are beyond those of floats."""
        value = np.broadcast_to(np.asarray(self._numbers.known[term.id], np.float64), (SAMPLES,))
        return value if np.isfinite(value).all() else None


def _sampled(cone: Sequence[Term], seed: int) -> Numbers:
    """The numbers of all terms at points where as many as possible are finite."""
    drawn = Places(cone, seed).points(DRAWN, boldness=0.2)
    numbers = Numbers(drawn, DRAWN, seed=seed)
    with np.errstate(all="ignore"):
        lacking = np.zeros(DRAWN)
        for value in numbers.of(cone):
            lacking += ~np.isfinite(np.asarray(value, np.float64))
    best = np.argsort(lacking, kind="stable")[:SAMPLES]
    found = Numbers({id_: each[best] for id_, each in drawn.items()}, SAMPLES, seed=seed)
    found.of(cone)
    return found


def _keys(term: Term, value: Array) -> Iterator[tuple[str, int]]:
    """Keys of which alike numbers have at least one in common."""
    weight = float(np.abs(value).sum())
    if weight == 0:
        yield term.kind, 0
        return
    place = np.log(weight) / 1e-6
    yield term.kind, int(np.floor(place))
    yield term.kind, int(np.floor(place + 0.5)) + 1_000_000_000


def _are_alike(x: Array, y: Array | None) -> bool:
    if y is None:
        return False
    scale = np.maximum(np.abs(x), np.abs(y)).max()
    return bool((np.abs(x - y) <= _ALIKE * np.maximum(scale, 1e-30)).all())

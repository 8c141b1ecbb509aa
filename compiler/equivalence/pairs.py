"""Bounds of the difference of two terms that are built alike, by that of their arguments.

``boxes.py`` asks for them. ``sqrt(a + 0.1)`` and ``sqrt(a + 0.10001)`` each lie in a wide interval,
and the difference of two intervals is as wide as both. But their difference is that of the
arguments, times a slope of the root between them (mean value theorem). So two formulas that differ
in a coefficient are compared in one large box instead of many small ones, however many variables
they have. Terms that are not built alike have the difference of their own bounds.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from ...stdlib.builtins.facts import SMALLEST_NORMAL
from .numbers import Array
from .term import Term

_ROUNDING = 2.0**-44
"""The part of a result by which float64 may be off: far more than it is."""
_COMMUTING = ("add", "mul", "min", "max")


class Ends(NamedTuple):
    """Two numbers between which something lies, for each box; NaN where nothing is known."""

    low: Array
    high: Array


class Pairs:
    """Differences of terms in some boxes; each pair is looked at once."""

    def __init__(self, known: Mapping[int, Any], count: int) -> None:
        """``known`` has the bounds of all terms by themselves, in so many boxes."""
        self._known, self._count = known, count
        self._found: dict[tuple[int, int], Ends] = {}

    def difference(self, first: Term, second: Term) -> Ends:
        """Two numbers between which the first term minus the second one lies."""
        pending = [(first, second)]
        while pending:
            one, other = pending[-1]
            key = one.id, other.id
            if key in self._found:
                pending.pop()
                continue
            inner = self._arguments(one, other)
            missing = [each for each in inner if (each[0].id, each[1].id) not in self._found]
            if missing:
                pending += missing
                continue
            self._found[key] = self._by_rule(one, other, inner)
            pending.pop()
        return self._found[first.id, second.id]

    def _arguments(self, one: Term, other: Term) -> list[tuple[Term, Term]]:
        """The arguments of two terms that are built alike, in pairs; empty if they are not."""
        if one is other or (one.op, one.data) != (other.op, other.data):
            return []
        if one.op not in _RULES or one.kind != "f":
            return []
        ours, theirs = list(one.args), list(other.args)
        # Nothing is known of what lies behind the variables of a region.
        if len(ours) != len(theirs) or any(x.id not in self._known for x in (*ours, *theirs)):
            return []
        if one.op in _COMMUTING and _fit(ours, theirs[::-1]) > _fit(ours, theirs):
            theirs.reverse()
        if one.op == "where" and ours[0] is not theirs[0]:
            return []
        return list(zip(ours, theirs, strict=True))[one.op == "where" :]

    def _by_rule(self, one: Term, other: Term, inner: list[tuple[Term, Term]]) -> Ends:
        if one is other:
            return Ends(np.zeros(self._count), np.zeros(self._count))
        alone = self._apart(one, other)
        if not inner:
            return alone
        places = [(self._of(x), self._of(y), self._found[x.id, y.id]) for x, y in inner]
        low, high = _RULES[one.op](*places)
        margin = _ROUNDING * np.maximum(np.abs(low), np.abs(high))
        # Where a rule says nothing, there is a NaN, which these leave out.
        return Ends(np.fmax(low - margin, alone.low), np.fmin(high + margin, alone.high))

    def _of(self, term: Term) -> Ends:
        number = self._known[term.id]
        low, high = (np.asarray(end, np.float64) for end in (number.low, number.high))
        return Ends(np.broadcast_to(low, (self._count,)), np.broadcast_to(high, (self._count,)))

    def _apart(self, one: Term, other: Term) -> Ends:
        """The difference of the bounds that both terms have by themselves."""
        x, y = self._of(one), self._of(other)
        return _plus(x, Ends(-y.high, -y.low))


def _fit(ours: list[Term], theirs: list[Term]) -> int:
    """Rates how well two lists of arguments fit: the same terms, or else the same operations."""
    return sum(2 if x is y else x.op == y.op for x, y in zip(ours, theirs, strict=True))


Place = tuple[Ends, Ends, Ends]
"""The bounds of an argument in both terms, and those of its difference."""


def _times(one: Ends, other: Ends) -> Ends:
    """The product; that with a difference of zero is zero, however steep a slope is."""
    parts = [np.where((x == 0) | (y == 0), 0.0, x * y) for x in one for y in other]
    return Ends(np.minimum.reduce(parts), np.maximum.reduce(parts))


def _plus(one: Ends, other: Ends) -> Ends:
    """The sum, rounded outward: what cancels leaves the rounding of both."""
    low, high = one.low + other.low, one.high + other.high
    return Ends(
        low - _ROUNDING * (np.abs(one.low) + np.abs(other.low)),
        high + _ROUNDING * (np.abs(one.high) + np.abs(other.high)),
    )


def _hull(*all_: Ends) -> Ends:
    return Ends(
        np.minimum.reduce([each.low for each in all_]),
        np.maximum.reduce([each.high for each in all_]),
    )


def _between(place: Place) -> Ends:
    """The interval of the argument, in both terms and on the way from one to the other."""
    return _hull(place[0], place[1])


def _known_where(condition: Array, ends: Ends) -> Ends:
    return Ends(np.where(condition, ends.low, np.nan), np.where(condition, ends.high, np.nan))


def _mul(x: Place, y: Place) -> Ends:
    """``a b - c d`` is ``a (b - d) + d (a - c)``, and also ``c (b - d) + b (a - c)``."""
    one = _plus(_times(x[0], y[2]), _times(y[1], x[2]))
    other = _plus(_times(x[1], y[2]), _times(y[0], x[2]))
    return Ends(np.maximum(one.low, other.low), np.minimum(one.high, other.high))


def _reciprocal(x: Place) -> Ends:
    """``1/a - 1/c`` is ``(c - a) / (a c)``; with a zero between them it may be anything."""
    where = _between(x)
    slopes = Ends(*(np.sort([-1.0 / where.low**2, -1.0 / where.high**2], axis=0)))
    return _known_where(_is_away(where), _times(slopes, x[2]))


def _is_away(where: Ends) -> Array:
    """True if all of it lies on one side of zero, and not too near."""
    return (where.low >= SMALLEST_NORMAL) | (where.high <= -SMALLEST_NORMAL)


def _abs(x: Place) -> Ends:
    """No number is farther from another one than its magnitude is from the other's."""
    where, most = _between(x), np.maximum(np.abs(x[2].low), np.abs(x[2].high))
    low = np.where(where.low >= 0, x[2].low, np.where(where.high <= 0, -x[2].high, -most))
    high = np.where(where.low >= 0, x[2].high, np.where(where.high <= 0, -x[2].low, most))
    return Ends(low, high)


def _least_or_greatest(x: Place, y: Place) -> Ends:
    """Of two pairs, the least ones, or the greatest, differ by no more than one of the pairs."""
    return _hull(x[2], y[2])


def _sqrt(x: Place) -> Ends:
    where = _between(x)
    return _known_where(
        where.low >= SMALLEST_NORMAL, _times(_falling(lambda at: 0.5 / np.sqrt(at), where), x[2])
    )


def _inverse_root(x: Place) -> Ends:
    where = _between(x)
    rising = _falling(lambda at: 0.5 * at**-1.5, where)
    slopes = Ends(-rising.high, -rising.low)
    return _known_where(where.low >= SMALLEST_NORMAL, _times(slopes, x[2]))


def _falling(slope: Callable[[Array], Array], where: Ends) -> Ends:
    return Ends(slope(where.high), slope(where.low))


def _power(x: Place, y: Place) -> Ends:
    """The slope along the base is ``b a^(b - 1)``, and along the exponent ``ln(a) a^b``."""
    base, exponent = _between(x), _between(y)
    lowered = Ends(exponent.low - 1.0, exponent.high - 1.0)
    along = _times(_times(exponent, _corners(base, lowered)), x[2])
    log = Ends(np.log(base.low), np.log(base.high))
    up = _times(_times(log, _corners(base, exponent)), y[2])
    return _known_where(base.low >= SMALLEST_NORMAL, _plus(along, up))


def _corners(base: Ends, exponent: Ends) -> Ends:
    """A power is monotone along the base and along the exponent."""
    found = [a**b for a in base for b in exponent]
    return Ends(np.minimum.reduce(found), np.maximum.reduce(found))


def _exp2(x: Place) -> Ends:
    where = _between(x)
    slopes = Ends(np.log(2.0) * np.exp2(where.low), np.log(2.0) * np.exp2(where.high))
    return _times(slopes, x[2])


def _log2(x: Place) -> Ends:
    where = _between(x)
    slopes = _falling(lambda at: 1.0 / (np.log(2.0) * at), where)
    return _known_where(where.low >= SMALLEST_NORMAL, _times(slopes, x[2]))


def _within(low: float, high: float) -> Callable[[Place], Ends]:
    """The rule of a function whose slope is between two numbers everywhere."""

    def rule(x: Place) -> Ends:
        return _times(Ends(np.full_like(x[2].low, low), np.full_like(x[2].low, high)), x[2])

    return rule


_RULES: Mapping[str, Callable[..., Ends]] = {
    "add": lambda x, y: _plus(x[2], y[2]),
    "mul": _mul,
    "reciprocal": _reciprocal,
    "abs": _abs,
    "min": _least_or_greatest,
    "max": _least_or_greatest,
    "where": _least_or_greatest,
    "sqrt": _sqrt,
    "inverse_root": _inverse_root,
    "power": _power,
    "exp2": _exp2,
    "log2": _log2,
    "sin": _within(-1.0, 1.0),
    "cos": _within(-1.0, 1.0),
    "tanh": _within(0.0, 1.0),
    "arctan": _within(0.0, 1.0),
}
"""For each operation that is continuous, the difference of two of them."""

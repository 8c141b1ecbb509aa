"""Affine forms: how a lane's error depends on errors that it shares with other lanes.

An interval forgets that two lanes are off by the same error, so a loop that corrects itself seems
to lose digits in every turn (``t = t + distance(origin + t * ray)``), and so does a difference of
two values at nearly the same place. A form remembers a few errors, such as those of interpolated
values and of a loop's states: a device's value is

    value + sum(terms[e] * e) + rest,   where -1 <= e <= 1 for each shared error e,

and the magnitude of ``rest`` is limited. Source: de Figueiredo and Stolfi, "Affine Arithmetic:
Concepts and Applications", 2004; terms here are few, and all else goes into ``rest``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import count

import numpy as np

from .rounding import Array

_numbers = count()


Errors = tuple[int, ...]
"""The numbers of shared errors, in ascending order."""
Terms = tuple[Array, ...]

MOST = 12
"""The number of errors of its own that a stored lane keeps; all others become one."""
MANY = 4 * MOST
"""The number of errors that any lane keeps.

Otherwise, a loop that adds up lanes which share nothing would have more of them in every iteration.
"""


@dataclass(slots=True, eq=False)
class Form:
    """The errors of one lane."""

    errors: Errors
    terms: Terms
    """For each shared error, how much it contributes at most, with its sign: arrays of one shape.

    They are arrays of their own, and not the rows of one, as most forms have terms of another one
    unchanged.
    """
    rest: Array
    """The largest magnitude of all other errors together."""
    _shared: Array | None = None
    """The sum of the magnitudes of its terms, once it is known."""

    @property
    def radius(self) -> Array:
        """The possible distance of the lane from its value; NaN where the form says nothing."""
        if not self.errors:
            return self.rest
        if self._shared is None:
            self._shared = _total(self.terms)
        return self._shared + self.rest

    def scaled(self, factor: Array) -> Form:
        """The form of a multiple of the lane."""
        terms = tuple([term * factor for term in self.terms])
        return Form(self.errors, terms, self.rest * np.abs(factor))

    def negated(self) -> Form:
        """The form of the lane with the other sign."""
        return Form(self.errors, tuple([-term for term in self.terms]), self.rest, self._shared)

    def plus(self, other: Form) -> Form:
        """The form of the sum of two lanes."""
        rest = self.rest + other.rest
        if not other.errors:
            return Form(self.errors, self.terms, rest, self._shared)
        if not self.errors:
            return Form(other.errors, other.terms, rest, other._shared)
        errors, one, two = _together(self.errors, other.errors)
        return Form(errors, _merged(self.terms, one, other.terms, two), rest)._limited()

    def widened(self, by: Array) -> Form:
        """The form with a further error of its own."""
        return Form(self.errors, self.terms, self.rest + by, self._shared)

    def or_else(self, other: Form) -> Form | None:
        """The form of a lane that is one of two, if they share the same errors."""
        if self.errors != other.errors:
            return None
        pairs = zip(self.terms, other.terms, strict=True)
        apart = _total([x - y for x, y in pairs]) if self.errors else 0.0
        return Form(self.errors, self.terms, np.maximum(self.rest, other.rest) + apart)

    def shared(self) -> Form:
        """The form of a lane whose whole error is shared from now on.

        It keeps the errors that it shares with others, and the rest becomes one more. Of too many,
        the smallest join the rest.
        """
        form = self._largest()
        terms = _of_one_shape((*form.terms, form.rest))
        return Form((*form.errors, next(_numbers)), terms, np.zeros_like(terms[-1]))

    def _limited(self) -> Form:
        """The form with its largest errors, if it has too many."""
        return self if len(self.errors) <= MANY else self._largest()

    def _largest(self) -> Form:
        """The form with its largest errors; the others are a part of the rest."""
        if len(self.errors) <= MOST:
            return self
        order = np.argsort([np.abs(term).max() for term in self.terms]).tolist()
        kept, merged = sorted(order[-MOST:]), order[:-MOST]
        rest = self.rest + _total([self.terms[i] for i in merged])
        errors, terms = (tuple([each[i] for i in kept]) for each in (self.errors, self.terms))
        return Form(errors, terms, rest)


def alone(radius: Array) -> Form:
    """The form of a lane whose error nobody shares."""
    return Form((), (), radius)


def chosen(
    is_first: Array, is_second: Array | None, x: Form, y: Form, otherwise: Array = 0.0
) -> Form:
    """The form of the first lane, or of the second, or of neither with the radius ``otherwise``.

    ``is_second`` is ``None`` where one of both is chosen for certain.
    """
    if _is_all(is_first, x, y):
        return x
    is_second = ~is_first if is_second is None else is_second & ~is_first
    if _is_all(is_second, y, x):
        return y
    errors, one, two = _together(x.errors, y.errors)
    terms = _merged(_only(is_first, x.terms), one, _only(is_second, y.terms), two)
    rest = np.where(is_first, x.rest, np.where(is_second, y.rest, otherwise))
    return Form(errors, terms, rest)._limited()


def curved(form: Form, slope: Array, slopes_at_ends: tuple[Array, Array], radius: Array) -> Form:
    """The form of a function of a lane whose derivative never turns within the lane's interval.

    The function's mean value theorem: its change is the derivative at some place between, times the
    change of the operand; so what the derivative at the value leaves out is within the derivative's
    change. A lane without an error has none afterwards, however steep the function is.
    """
    first, last = slopes_at_ends
    bend = np.maximum(np.abs(first - slope), np.abs(last - slope))
    certain = radius == 0
    if certain.any():
        slope, bend = np.where(certain, 0.0, slope), np.where(certain, 0.0, bend)
    return form.scaled(slope).widened(bend * radius)


Places = tuple[int, ...]
"""The places of errors among those of a form, or ``_NOWHERE``."""
_NOWHERE = -1


@lru_cache(maxsize=256)
def _together(x: Errors, y: Errors) -> tuple[Errors, Places, Places]:
    """The errors of two forms, and the place of each in both."""
    errors = tuple(sorted({*x, *y}))
    places = ({error: place for place, error in enumerate(some)} for some in (x, y))
    first, second = (tuple([known.get(each, _NOWHERE) for each in errors]) for known in places)
    return errors, first, second


def _is_all(is_first: Array, x: Form, y: Form) -> bool:
    """True if ``x`` is chosen everywhere, and has the errors and the elements of ``y``, too."""
    shape = np.shape(is_first)
    return (
        np.count_nonzero(is_first) == np.size(is_first)
        and np.shape(x.rest) == shape
        and (not x.errors or np.shape(x.terms[0]) == shape)
        and np.shape(y.rest) in ((), shape)
        and (not y.errors or np.shape(y.terms[0]) in ((), shape))
        and (not y.errors or set(x.errors).issuperset(y.errors))
    )


def _merged(x: Terms, one: Places, y: Terms, two: Places) -> Terms:
    """The sums of the terms of the same errors."""

    def term(first: int, second: int) -> Array:
        if first == _NOWHERE:
            return y[second]
        return x[first] if second == _NOWHERE else x[first] + y[second]

    return _of_one_shape(list(map(term, one, two)))


def _of_one_shape(terms: Sequence[Array]) -> Terms:
    """Terms, each of which has an element for each element of the others."""
    shapes = {np.shape(term) for term in terms}
    return tuple(terms if len(shapes) <= 1 else np.broadcast_arrays(*terms))


def _total(terms: Sequence[Array]) -> Array:
    """The sum of the magnitudes of terms of one shape."""
    if np.size(terms[0]) == 1:
        # Of single numbers, one call of NumPy for all takes less time.
        return np.add.reduce(np.abs(np.array(terms)))
    total = np.abs(terms[0])
    for term in terms[1:]:
        total += np.abs(term)
    return total


def _only(condition: Array, terms: Terms) -> Terms:
    """The terms where a condition holds, and zeros elsewhere.

    The bits of a number are taken or not, which is several times as fast as ``np.where``.
    """
    mask = -condition.astype(np.int64)
    return tuple([(term.view(np.int64) & mask).view(np.float64) for term in terms])


Derivative = Callable[[Array], Array]
"""The derivative of a function, which rises everywhere or falls everywhere."""

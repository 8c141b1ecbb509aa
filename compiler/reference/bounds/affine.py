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

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import count
from typing import NamedTuple

import numpy as np

from .rounding import Array

_numbers = count()


Errors = tuple[int, ...]
"""The numbers of shared errors, in ascending order."""

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
    terms: Array
    """(errors, …): how much each shared error contributes at most, with its sign."""
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
            self._shared = np.add.reduce(np.abs(self.terms))
        return self._shared + self.rest

    def scaled(self, factor: Array) -> Form:
        """The form of a multiple of the lane."""
        terms = _with_axes(self.terms, np.ndim(factor)) * factor if self.errors else self.terms
        return Form(self.errors, terms, self.rest * np.abs(factor))

    def negated(self) -> Form:
        """The form of the lane with the other sign."""
        return Form(self.errors, -self.terms, self.rest, self._shared)

    def plus(self, other: Form) -> Form:
        """The form of the sum of two lanes."""
        rest = self.rest + other.rest
        if not other.errors:
            return Form(self.errors, self.terms, rest, self._shared)
        if not self.errors:
            return Form(other.errors, other.terms, rest, other._shared)
        if self.errors == other.errors:
            return Form(self.errors, _joined(self.terms, other.terms), rest)
        errors, one, two = _together(self.errors, other.errors)
        return Form(errors, _merged(self.terms, one, other.terms, two), rest)._limited()

    def widened(self, by: Array) -> Form:
        """The form with a further error of its own."""
        return Form(self.errors, self.terms, self.rest + by, self._shared)

    def or_else(self, other: Form) -> Form | None:
        """The form of a lane that is one of two, if they share the same errors."""
        if self.errors != other.errors:
            return None
        apart = np.abs(_joined(self.terms, -other.terms)).sum(axis=0) if self.errors else 0.0
        return Form(self.errors, self.terms, np.maximum(self.rest, other.rest) + apart)

    def shared(self) -> Form:
        """The form of a lane whose whole error is shared from now on.

        It keeps the errors that it shares with others, and the rest becomes one more. Of too many,
        the smallest join the rest.
        """
        form = self._largest()
        terms = np.broadcast_arrays(*form.terms, form.rest) if form.errors else [form.rest]
        errors = (*form.errors, next(_numbers))
        return Form(errors, np.stack(terms), np.zeros_like(terms[-1]))

    def _limited(self) -> Form:
        """The form with its largest errors, if it has too many."""
        return self if len(self.errors) <= MANY else self._largest()

    def _largest(self) -> Form:
        """The form with its largest errors; the others are a part of the rest."""
        if len(self.errors) <= MOST:
            return self
        sizes = np.abs(self.terms).reshape(len(self.errors), -1).max(axis=1)
        order = np.argsort(sizes)
        kept, merged = sorted(order[-MOST:].tolist()), order[:-MOST]
        rest = self.rest + np.abs(self.terms[merged]).sum(axis=0)
        return Form(tuple(self.errors[i] for i in kept), self.terms[kept], rest)


def alone(radius: Array) -> Form:
    """The form of a lane whose error nobody shares."""
    return Form((), _NO_TERMS, radius)


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
    axes = max(map(np.ndim, (is_first, is_second, x.rest, y.rest)))
    terms = _NO_TERMS
    if x.errors:
        terms = _only(is_first, _with_axes(x.terms, axes))
    if y.errors:
        others = _only(is_second, _with_axes(y.terms, axes))
        terms = _merged(terms, one, others, two) if x.errors else others
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


_NO_TERMS = np.zeros((0,))


class _Places(NamedTuple):
    """The places of one form's terms among the terms of two forms."""

    size: int
    """The number of terms of both forms together."""
    rows: slice | list[int]
    """A slice, if no other terms are between them: NumPy is faster with one."""

    @classmethod
    def of(cls, some: Errors, errors: Errors) -> _Places:
        """The places of some of the errors among all of them."""
        places = [errors.index(error) for error in some]
        first, count = min(places, default=0), len(places)
        adjoin = places == list(range(first, first + count))
        return cls(len(errors), slice(first, first + count) if adjoin else places)


@lru_cache(maxsize=1024)
def _together(x: Errors, y: Errors) -> tuple[Errors, _Places, _Places]:
    errors = tuple(sorted({*x, *y}))
    return errors, _Places.of(x, errors), _Places.of(y, errors)


def _is_all(is_first: Array, x: Form, y: Form) -> bool:
    """True if ``x`` is chosen everywhere, and has the errors and the elements of ``y``, too."""
    shape = np.shape(is_first)
    return (
        np.count_nonzero(is_first) == np.size(is_first)
        and np.shape(x.rest) == shape
        and (x.terms.shape[1:] == shape or not x.errors)
        and np.shape(y.rest) in ((), shape)
        and y.terms.shape[1:] in ((), shape)
        and (not y.errors or set(x.errors).issuperset(y.errors))
    )


def _joined(x: Array, y: Array) -> Array:
    """The sums of the terms of the same errors."""
    if x.ndim == y.ndim:
        return x + y
    axes = max(x.ndim, y.ndim) - 1
    return _with_axes(x, axes) + _with_axes(y, axes)


def _with_axes(terms: Array, axes: int) -> Array:
    """Terms of a lane with fewer axes than another, so that they broadcast together with it."""
    missing = axes + 1 - terms.ndim
    if missing <= 0:
        return terms
    return terms.reshape(terms.shape[0], *[1] * missing, *terms.shape[1:])


def _merged(x: Array, one: _Places, y: Array, two: _Places) -> Array:
    """The sums of the terms of the same errors, for terms of different errors."""
    if x.shape[1:] != y.shape[1:]:
        return _joined(_placed(x, one), _placed(y, two))
    terms = _placed(x, one) if one.size > len(x) else x.copy()
    terms[two.rows] += y
    return terms


def _placed(terms: Array, places: _Places) -> Array:
    """Terms in their places among more terms, which are zero."""
    if places.size == len(terms):
        return terms
    placed = np.zeros((places.size, *terms.shape[1:]))
    placed[places.rows] = terms
    return placed


def _only(condition: Array, terms: Array) -> Array:
    """The terms where a condition holds, and zeros elsewhere.

    The bits of a number are taken or not, which is several times as fast as ``np.where``.
    """
    mask = -condition.astype(np.int64)
    only: Array = (terms.view(np.int64) & mask).view(np.float64)
    return only


Derivative = Callable[[Array], Array]
"""The derivative of a function, which rises everywhere or falls everywhere."""

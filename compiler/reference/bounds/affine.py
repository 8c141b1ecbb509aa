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

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import count

import numpy as np

from .rounding import Array

_numbers = count()

KEPT = 8
"""How many terms a state keeps from one turn of a loop to the next; each costs time."""
_WIDER = 1.25
"""A form that is that much wider than the interval is given up for it."""


@dataclass(frozen=True, slots=True, eq=False)
class Form:
    """The errors of one lane."""

    terms: Mapping[int, Array]
    """By the number of a shared error: how much it contributes at most, with its sign."""
    rest: Array
    """The largest magnitude of all other errors together."""

    @property
    def radius(self) -> Array:
        """By how much the lane may differ from its value."""
        return sum(map(np.abs, self.terms.values()), self.rest)

    def scaled(self, factor: Array) -> Form:
        """The form of a multiple of the lane."""
        terms = {error: term * factor for error, term in self.terms.items()}
        return Form(terms, self.rest * np.abs(factor))

    def plus(self, other: Form) -> Form:
        """The form of the sum of two lanes."""
        terms = dict(self.terms)
        for error, term in other.terms.items():
            terms[error] = terms[error] + term if error in terms else term
        return Form(terms, self.rest + other.rest)

    def widened(self, by: Array) -> Form:
        """The form with a further error of its own."""
        return Form(self.terms, self.rest + by)


def shared(radius: Array) -> Form:
    """The form of a lane whose whole error is shared from now on."""
    return Form({next(_numbers): radius}, np.zeros_like(radius))


def carried(form: Form | None, radius: Array) -> Form:
    """The form of a state in the next turn of its loop, from its form and its radius.

    All of its error is shared then: it keeps its largest terms, so that two states do not forget
    what they share (the lanes of a vector that is rotated in each turn, for instance), and the rest
    becomes one new error. Where its interval is known to be narrower, all of it becomes one.
    """
    if form is None or not form.terms:
        return shared(radius)
    largest = sorted(form.terms, key=lambda error: -_size(form.terms[error]))
    rest = sum((np.abs(form.terms[error]) for error in largest[KEPT:]), form.rest)
    terms = {error: form.terms[error] for error in largest[:KEPT]}
    narrower = ~(form.radius <= _WIDER * radius)
    if narrower.any():
        terms = {error: np.where(narrower, 0.0, term) for error, term in terms.items()}
        rest = np.where(narrower, radius, rest)
    return Form({**terms, next(_numbers): rest}, np.zeros_like(rest))


def _size(term: Array) -> float:
    """How large a term is at some elements; each element alone would cost too much."""
    return float(np.nansum(np.abs(np.ravel(term)[:: max(1, np.size(term) // 64)])))


def alone(radius: Array) -> Form:
    """The form of a lane whose error nobody shares."""
    return Form({}, radius)


def chosen(is_first: Array, is_second: Array, x: Form, y: Form, otherwise: Array) -> Form:
    """The form of the first lane, or of the second, or of neither with this radius."""
    terms: dict[int, Array] = {}
    for error in dict.fromkeys((*x.terms, *y.terms)):
        first, second = x.terms.get(error, 0.0), y.terms.get(error, 0.0)
        terms[error] = np.where(is_first, first, np.where(is_second, second, 0.0))
    return Form(terms, np.where(is_first, x.rest, np.where(is_second, y.rest, otherwise)))


def curved(form: Form, slope: Array, slopes_at_ends: tuple[Array, Array], radius: Array) -> Form:
    """The form of a function of a lane whose derivative never turns within the lane's interval.

    The function's mean value theorem: its change is the derivative at some place between, times the
    change of the operand; so what the derivative at the value leaves out is within the derivative's
    change.
    """
    first, last = slopes_at_ends
    bend = np.maximum(np.abs(first - slope), np.abs(last - slope))
    return form.scaled(slope).widened(bend * radius)


Derivative = Callable[[Array], Array]
"""The derivative of a function, which rises everywhere or falls everywhere."""

"""Bounds of the difference of two programs over boxes, by the bounds of the reference.

A box says between which numbers each variable lies. Bounds of all numbers in it follow as those of
a device's errors do (``compiler/reference/bounds``): they are intervals that share what depends on
one variable (affine forms), so what is alike in both programs cancels.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from ...stdlib.builtins.facts import SMALLEST_NORMAL
from ...support.frozen import frozen
from ..reference.bounds import Bounded, Bounds, exact, remembered
from .numbers import Array
from .pairs import Ends, Pairs
from .polynomials import Algebra
from .term import Term, below
from .terms import Terms

_ROUNDING = 2.0**-44
"""The part of a function's result by which float64 may be off: far more than it is."""


@frozen
class Region:
    """The part of two programs in which they differ, and the terms on which it depends."""

    first: tuple[Term, ...]
    second: tuple[Term, ...]
    differences: tuple[Term, ...]
    """The difference of each two results, in which some of what is alike has cancelled."""
    variables: tuple[Term, ...]
    inside: tuple[Term, ...]
    """The terms between the variables and the results, arguments before users."""


def cut(terms: Terms, first: Sequence[Term], second: Sequence[Term]) -> Region:
    """The region below two programs' results, down to the largest terms that both have.

    What both have may be any number between its ends; where these are not known, it is a part of
    the region, too.
    """
    ours, theirs = ({term.id for term in below(each)} for each in (first, second))
    shared = ours & theirs
    ends = {id_ for id_ in shared if _is_limited(terms.all[id_])}
    return _region(terms, first, second, ends)


def whole(terms: Terms, first: Sequence[Term], second: Sequence[Term]) -> Region:
    """The region from the variables that come from outside."""
    return _region(terms, first, second, set())


def _is_limited(term: Term) -> bool:
    return bool(np.isfinite(term.span.low) and np.isfinite(term.span.high))


def _region(terms: Terms, first: Sequence[Term], second: Sequence[Term], ends: set[int]) -> Region:
    algebra = Algebra(terms)
    differences = [
        algebra.difference(x, y, ends - {x.id, y.id}) for x, y in zip(first, second, strict=True)
    ]
    variables: dict[int, Term] = {}
    inside: dict[int, Term] = {}
    pending = [*first, *second, *differences]
    while pending:
        term = pending.pop()
        if term.id in variables or term.id in inside:
            continue
        is_outside = term.op in ("variable", "read", "element", "crossed")
        if term.op != "constant" and (is_outside or term.id in ends):
            variables[term.id] = term
        else:
            inside[term.id] = term
            pending += term.args
    outside = tuple(variables[id_] for id_ in sorted(variables))
    between = tuple(inside[id_] for id_ in sorted(inside))
    return Region(tuple(first), tuple(second), tuple(differences), outside, between)


@frozen
class Bound:
    """What is known of the difference in some boxes."""

    difference: Array
    """For each box, the largest difference that there may be; infinite if nothing is known."""
    share: Array
    """The same as a part of what is allowed."""
    slopes: Array
    """For each variable and box, how much of the difference may be due to it."""


def bound(region: Region, low: Array, high: Array, epsilon: float) -> Bound:
    """The bounds of the difference in boxes, whose ends have a row for each variable."""
    library = Bounds(_rounding)
    known: dict[int, Any] = {}
    numbers = []
    for term, least, most in zip(region.variables, low, high, strict=True):
        known[term.id] = lane = _lane(term.kind, least, most)
        form = getattr(lane, "form", None)
        numbers.append(form.errors[-1] if form is not None and form.errors else -1)
    with np.errstate(all="ignore"):
        for term in region.inside:
            known[term.id] = _evaluated(term, known, library)
        pairs = Pairs(known, low.shape[1])
        found = [
            _difference(
                known[x.id],
                known[y.id],
                known[d.id],
                pairs.difference(x, y),
                epsilon,
                numbers,
                low.shape,
            )
            for x, y, d in zip(region.first, region.second, region.differences, strict=True)
        ]
    return Bound(
        np.maximum.reduce([each.difference for each in found]),
        np.maximum.reduce([each.share for each in found]),
        np.add.reduce([each.slopes for each in found]),
    )


def _difference(
    x: Any,
    y: Any,
    made: Any,
    paired: Ends,
    epsilon: float,
    numbers: Sequence[int],
    shape: tuple[int, int],
) -> Bound:
    """The bounds of the difference of one lane: the least of three, which all hold."""
    count = shape[1]
    if x.kind == "b":
        x, y = _as_number(x), _as_number(y)
    most = np.minimum(_farthest(x - y, count), _farthest(made, count))
    most = np.fmin(most, np.maximum(np.abs(paired.low), np.abs(paired.high)))
    least = np.maximum(_nearest(x), _nearest(y))
    share = most / (epsilon * np.maximum(1.0, np.where(np.isnan(least), 0.0, least)))
    slopes = np.zeros(shape)
    form = made.form
    if form is not None:
        for error, part in zip(form.errors, form.terms, strict=True):
            if error in numbers:
                row = numbers.index(error)
                slopes[row] += np.nan_to_num(np.abs(part) / epsilon, posinf=0.0)
    return Bound(most, share, slopes)


def _farthest(x: Bounded, count: int) -> Array:
    """The largest magnitude that a number may have; infinite if nothing is known of it."""
    most = np.maximum(np.abs(x.low), np.abs(x.high))
    return np.broadcast_to(np.where(np.isnan(most), np.inf, most), (count,))


def _nearest(x: Bounded) -> Array:
    """The least magnitude that a number may have."""
    return np.maximum(np.maximum(x.low, -x.high), 0.0)


def _as_number(x: Bounded) -> Bounded:
    low, high = (np.asarray(end, np.float64) for end in (x.low, x.high))
    return Bounded(low, low, high) if not x.is_exact else exact(low)


def _lane(kind: str, low: Array, high: Array) -> Any:
    """A variable between its ends."""
    if kind == "b":
        low, high = low > 0.5, high > 0.5
        return Bounded(low, low, high)
    if kind == "i":
        low, high = low.astype(np.int64), high.astype(np.int64)
        return Bounded(low, low, high)
    return remembered(Bounded(0.5 * (low + high), low, high))


def _rounding(_name: str, _operand: Array, result: Array) -> Array:
    return result * _ROUNDING


def _evaluated(term: Term, known: Mapping[int, Any], library: Bounds) -> Any:
    if term.op == "constant":
        return _constant(*term.data)
    args = [known[arg.id] for arg in term.args]
    return _OPERATIONS[term.op](library, *args)


def _constant(value: Fraction, kind: str) -> Bounded:
    if kind != "f":
        return exact(np.asarray(bool(value) if kind == "b" else int(value))[()])
    number = np.float64(value.numerator / value.denominator)
    if Fraction(float(number)) == value:
        return exact(number)
    return Bounded(number, np.nextafter(number, -np.inf), np.nextafter(number, np.inf))


def _inverse(library: Bounds, x: Bounded) -> Any:
    tiny = abs(x) < exact(np.float64(SMALLEST_NORMAL))
    one, zero = exact(np.float64(1.0)), exact(np.float64(0.0))
    return library.where(tiny, zero, library.divide(one, library.where(tiny, one, x)))


def _reciprocal(library: Bounds, x: Bounded) -> Bounded:
    return library.divide(exact(np.float64(1.0)), x)


def _inverse_root(library: Bounds, x: Bounded) -> Bounded:
    return library.inversesqrt(library.maximum(x, exact(np.float64(SMALLEST_NORMAL))))


_OPERATIONS: Mapping[str, Callable[..., Any]] = {
    "add": lambda _l, x, y: x + y,
    "mul": lambda _l, x, y: x * y,
    "reciprocal": _reciprocal,
    "inverse": _inverse,
    "abs": lambda _l, x: abs(x),
    "min": lambda library, x, y: library.minimum(x, y),
    "max": lambda library, x, y: library.maximum(x, y),
    "where": lambda library, condition, x, y: library.where(condition, x, y),
    "sqrt": lambda library, x: library.sqrt(x),
    "inverse_root": _inverse_root,
    "power": lambda library, x, y: library.power(x, y),
    "exp2": lambda library, x: library.exp2(x),
    "log2": lambda library, x: library.log2(x),
    "sin": lambda library, x: library.sin(x),
    "cos": lambda library, x: library.cos(x),
    "tanh": lambda library, x: library.tanh(x),
    "arcsin": lambda library, x: library.arcsin(x),
    "arctan": lambda library, x: library.arctan(x),
    "arctan2": lambda library, y, x: library.arctan2(y, x),
    "arcsinh": lambda library, x: library.arcsinh(x),
    "arccosh": lambda library, x: library.arccosh(x),
    "arctanh": lambda library, x: library.arctanh(x),
    "floor": lambda library, x: library.floor(x),
    "rint": lambda library, x: library.rint(x),
    "trunc": lambda library, x: library.trunc(x),
    "float": lambda library, x: library.float64(x),
    "int": lambda library, x: library.int64(x),
    "mantissa": lambda library, x: library.frexp(x)[0],
    "exponent": lambda library, x: library.frexp(x)[1],
    "less": lambda _l, x, y: x < y,
    "equal": lambda _l, x, y: x == y,
    "not": lambda library, x: library.logical_not(x),
    "and": lambda library, x, y: library.logical_and(x, y),
    "bit_and": lambda _l, x, y: x & y,
    "bit_or": lambda _l, x, y: x | y,
    "bit_xor": lambda _l, x, y: x ^ y,
    "shift_left": lambda _l, x, y: x << y,
    "shift_right": lambda _l, x, y: x >> y,
    "quotient": lambda _l, x, y: x // y,
    "remainder": lambda _l, x, y: x % y,
}
"""The operations of terms for lanes with bounds."""

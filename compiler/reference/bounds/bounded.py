"""The lanes of an evaluation with bounds: an exact value, and where a device's value may lie.

``functions.py`` has the functions of these lanes; together they take the place of NumPy and its
arrays in the reference's definitions of the builtins. Intervals as in Moore, "Interval Analysis",
1966: every operation contains all results for operands within their intervals, rounded as a device
may round them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import count
from typing import Any

import numpy as np

from ....stdlib.builtins.facts import SMALLEST_NORMAL, ULP
from . import whole
from .affine import Form, alone, chosen
from .operators import Operators
from .orders import Single, Sum, Term, in_any_order, is_coarse
from .products import products, square
from .rounding import (
    ROUNDED_UP,
    SUBNORMAL_STEP,
    Array,
    all_fit,
    constant_ends,
    is_float32,
    lost,
    of_device,
    outward,
    relative_error,
    rounding_error,
)

_numbers = count()

_STEP = 2.0**-52
"""The largest error of a float64, relative to the number."""


class Bounded(Operators):
    """One lane: arrays of the same kind (float64, int64 or bool) that broadcast together.

    ``value`` is the exact value of the program. A conforming device has a value from ``low`` to
    ``high``. Of a condition, ``low`` says where it certainly holds, and ``high`` where it may hold.
    Ends that are NaN say nothing.
    """

    __slots__ = (
        "_factors", "_magnitude", "_number", "_of", "_radius", "_sum", "form", "high", "low",
        "value",
    )  # fmt: skip
    __array_ufunc__ = None
    """NumPy leaves operations with these lanes to the methods below."""
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, value: Array, low: Array, high: Array, form: Form | None = None) -> None:
        """``form`` limits the interval further, if it is known how errors are shared."""
        self.value, self.low, self.high, self.form = value, low, high, form
        self._radius: Array | None = None
        self._magnitude: Array | None = None
        self._sum: Sum | None = None
        self._factors = 0
        """The number of multiplications that made it."""
        self._number = next(_numbers)
        self._of: frozenset[int] = frozenset()
        """The numbers of all its factors, if it is a product."""
        if form is not None:
            radius = form.radius
            # The end that is a number counts, if the form or the interval says nothing.
            self.low = np.fmax(low, value - radius)
            self.high = np.fmin(high, value + radius)

    @property
    def is_exact(self) -> bool:
        """True if every device has exactly ``value`` everywhere."""
        return self.low is self.high

    @property
    def kind(self) -> str:
        """``f`` for floats, ``i`` for integers, ``b`` for conditions."""
        return "i" if (found := np.asarray(self.value).dtype.kind) == "u" else found

    @property
    def ndim(self) -> int:
        """The number of axes."""
        return max(np.ndim(self.value), np.ndim(self.low), np.ndim(self.high))

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape that all three arrays broadcast to."""
        return np.broadcast_shapes(np.shape(self.value), np.shape(self.low), np.shape(self.high))

    @property
    def magnitude(self) -> Array:
        """The largest magnitude that a device may have."""
        if self._magnitude is None:
            self._magnitude = np.maximum(np.abs(self.low), np.abs(self.high))
        return self._magnitude

    @property
    def radius(self) -> Array:
        """The possible distance of a device's value from the exact one, to the farther side."""
        if self._radius is None:
            farther = np.maximum(self.high - self.value, self.value - self.low)
            self._radius = farther * ROUNDED_UP
        return self._radius

    @property
    def rounding(self) -> Array:
        """The possible rounding error of a sum or a product on a device, in any order."""
        made = self._sum
        times, magnitude = (
            (self._factors, self.magnitude) if made is None else (made.roundings, made.magnitude)
        )
        return relative_error(times) * magnitude + times * SMALLEST_NORMAL

    @property
    def any_form(self) -> Form:
        """The form of its error, or one that shares no error with other lanes."""
        return alone(self.radius) if self.form is None else self.form

    def __bool__(self) -> bool:
        """True if a condition that is the same for all elements certainly holds."""
        return bool(np.all(self.low))

    def any(self) -> bool:
        """True if a condition may hold anywhere."""
        return bool(np.any(self.high))

    def made_as(self, other: Bounded) -> Bounded:
        """Note, of a new lane, that it is made of the same terms and factors as another one."""
        self._sum, self._factors, self._of = other._sum, other._factors, other._of
        return self

    def within(self, low: Array, high: Array) -> Bounded:
        """The lane, if it is known that it lies between these ends, which are in its interval."""
        made = Bounded(self.value, low, high)
        made.form = self.form
        return made

    def mapped(self, change: Callable[[Array], Array]) -> Bounded:
        """The lane with all arrays changed in their shape or order only."""
        value = change(np.asarray(self.value))
        if self.is_exact:
            return exact(value)
        return Bounded(value, change(np.asarray(self.low)), change(np.asarray(self.high)))

    def spread(self, shape: tuple[int, ...]) -> Bounded:
        """The lane, broadcast to a shape."""
        return self.mapped(lambda array: np.broadcast_to(array, shape))

    def take(self, indices: Any, axis: int) -> Bounded:
        """Some elements along an axis, as NumPy's ``take`` returns them."""
        return self.spread(self.shape).mapped(lambda array: array.take(indices, axis))

    def repeat(self, times: int, axis: int) -> Bounded:
        """Every element several times along an axis, as NumPy's ``repeat`` returns them."""
        return self.mapped(lambda array: array.repeat(times, axis))

    # --- sums and products ------------------------------------------------------------------------

    def __add__(self, other: Any) -> Bounded:
        return _added(self, as_bounded(other))

    def __sub__(self, other: Any) -> Bounded:
        if self is other:
            return exact(np.zeros_like(self.value))
        return self + -as_bounded(other)

    def __mul__(self, other: Any) -> Bounded:
        return _multiplied(self, as_bounded(other))

    def __truediv__(self, divisor: float) -> Bounded:
        """A quotient by a constant, or a product with its reciprocal.

        Its error is 2.5 ulp (WGSL, the table of accuracies). ``Bounds.divide`` divides by other
        lanes.
        """
        quotient = Bounded(self.value / divisor, *products(self, exact(1.0 / divisor)))
        return widened(quotient, 2.5 * ULP * quotient.magnitude)

    def __neg__(self) -> Bounded:
        made = exact(-self.value)
        if not self.is_exact:
            made = Bounded(made.value, -self.high, -self.low)
            made.form = None if self.form is None else self.form.negated()
            made._radius, made._magnitude = self._radius, self._magnitude
        made._number = self._number
        return made.made_as(self)

    def __abs__(self) -> Bounded:
        if self.is_exact:
            return exact(np.abs(self.value))
        inside = (self.low <= 0) & (self.high >= 0)
        low = np.minimum(np.abs(self.low), np.abs(self.high))
        form = None
        if self.form is not None:
            form = chosen(self.low >= 0, self.high <= 0, self.form, self.form.negated(),
                          self.radius)  # fmt: skip
        return Bounded(np.abs(self.value), np.where(inside, 0, low), self.magnitude, form)

    # --- comparisons ------------------------------------------------------------------------------

    def __lt__(self, other: Any) -> Bounded:
        other = as_bounded(other)
        return _condition(self, other, np.less, self.high < other.low, self.low >= other.high)

    def __le__(self, other: Any) -> Bounded:
        other = as_bounded(other)
        return _condition(self, other, np.less_equal, self.high <= other.low, self.low > other.high)

    def __eq__(self, other: Any) -> Bounded:  # type: ignore[override]
        other = as_bounded(other)
        points = (self.low == self.high) & (other.low == other.high) & (self.low == other.low)
        apart = (self.high < other.low) | (self.low > other.high)
        return _condition(self, other, np.equal, points, apart)

    def __ne__(self, other: Any) -> Bounded:  # type: ignore[override]
        return negated(self == other)

    # --- whole numbers ----------------------------------------------------------------------------

    def __invert__(self) -> Bounded:
        return Bounded(~self.value, ~self.high, ~self.low) if not self.is_exact else exact(
            ~self.value)  # fmt: skip

    def _whole(self, operation: whole.Operation, other: Any) -> Bounded:
        """An operation on whole numbers, which does not round."""
        y = as_bounded(other)
        value = operation.of(self.value, y.value)
        if self.is_exact and y.is_exact:
            return exact(value)
        return Bounded(value, *operation.ends((self.low, self.high), (y.low, y.high)))

    def _lane(self, other: Any) -> Bounded:
        return as_bounded(other)


# --- making lanes ---------------------------------------------------------------------------------


def exact(value: Any) -> Bounded:
    """A lane that every device has exactly, such as an integer."""
    array = np.asarray(value)[()]
    return Bounded(array, array, array)


def joined(parts: Sequence[Bounded]) -> Bounded:
    """The elements of several lanes of one axis, one behind the other."""
    value = np.concatenate([part.value for part in parts])
    if all(part.is_exact for part in parts):
        return exact(value)
    low, high = (np.concatenate([getattr(part, end) for part in parts]) for end in ("low", "high"))
    return Bounded(value, low, high)


def constant(value: float) -> Bounded:
    """A constant of a text, which a compiler rounds to the nearest float32."""
    number = np.float64(value)
    return exact(number) if is_float32(number) else Bounded(number, *constant_ends(number))


def as_bounded(lane: Any) -> Bounded:
    """A lane as it is; a Python float as a constant of a text; anything else as exact."""
    if isinstance(lane, Bounded):
        return lane
    return constant(lane) if isinstance(lane, float) else exact(lane)


def widened(x: Bounded, by: Array) -> Bounded:
    """The lane of a device whose function has an absolute error of its own.

    Among subnormal numbers, the nearest one may be farther away than the error.
    """
    by = by + SUBNORMAL_STEP
    low, high = of_device(x.low - by, x.high + by)
    form = x.form
    if form is not None:
        form = form.widened(by + lost(np.maximum(np.abs(low), np.abs(high))))
    return Bounded(x.value, low, high, form)


# --- operations -----------------------------------------------------------------------------------


def negated(condition: Bounded) -> Bounded:
    """The negation of a condition."""
    if condition.is_exact:
        return exact(np.logical_not(condition.value))
    return Bounded(~condition.value, ~condition.high, ~condition.low)


def _condition(x: Bounded, y: Bounded, compare: Any, holds: Array, fails: Array) -> Bounded:
    value = compare(x.value, y.value)
    if x.is_exact and y.is_exact:
        return exact(value)
    return Bounded(value, holds, np.logical_not(fails))


def correctly_rounded(
    value: Array, low: Array, high: Array, form: Form | None = None, times: int = 1
) -> Bounded:
    """The result of a correctly rounded operation, from the ends of its exact results.

    ``times`` says how often it may be rounded: in another order, results that are less than half
    as large are, too, whose steps are not finer beside them.
    """
    if np.asarray(value).dtype.kind != "f":
        return exact(value) if low is high else Bounded(value, low, high)
    if low is high and times == 1 and is_float32(value):
        return exact(value)
    if times == 1 and form is None:
        return Bounded(value, *outward(low, high))
    magnitude = np.maximum(np.abs(low), np.abs(high))
    error = rounding_error(magnitude, times)
    farthest = magnitude + error
    fits = all_fit(farthest)
    if times == 1:
        low, high = outward(low, high, fits=fits)
    else:
        low, high = of_device(low - error, high + error, fits=fits)
    if form is not None:
        form = form.widened(error + lost(farthest, fits=fits))
    return Bounded(value, low, high, form)


def _added(x: Bounded, y: Bounded) -> Bounded:
    """A sum, with the error that any order of its terms may have."""
    value = x.value + y.value
    are_exact = x.is_exact and y.is_exact
    low, high = (value, value) if are_exact else (x.low + y.low, x.high + y.high)
    if are_exact and x.kind == "f" and not _is_whole_sum(value, x.value, y.value):
        low, high = value - _STEP * np.abs(value), value + _STEP * np.abs(value)
    form = None if x.form is None and y.form is None else x.any_form.plus(y.any_form)
    made = correctly_rounded(value, low, high, form)
    if made.kind != "f":
        return made
    terms = _term(x), _term(y)
    before = [term.roundings for term in terms if isinstance(term, Sum)]
    is_exact = are_exact and made.is_exact and all(map(_is_coarse, (x, y)))
    # A common factor may be taken out: then the sum of the others is rounded, too.
    roundings = 2 if (x._of | {x._number}) & (y._of | {y._number}) else 1
    sum_ = Sum(roundings + sum(before), terms, is_exact)
    if sum_.roundings > 1 and not is_exact:
        more = in_any_order(sum_)
        low, high = np.minimum(made.low, low - more), np.maximum(made.high, high + more)
        made = Bounded(value, low, high, None if made.form is None else made.form.widened(more))
    for term in terms:
        if isinstance(term, Sum):
            term.settle()
    made._sum = sum_
    return made


def _multiplied(x: Bounded, y: Bounded) -> Bounded:
    """A product, with the error that any order of its factors may have.

    In another order other products round, on either side. Orders with partial products that are
    no normal numbers, where those of the written order are, are not allowed for.
    """
    value = x.value * y.value
    factors = x._factors + y._factors + 1
    if x.is_exact and y.is_exact:
        made = correctly_rounded(value, value, value, times=factors)
    else:
        ends = square(x) if x is y else products(x, y)
        made = correctly_rounded(value, *ends, _product_form(x, y), times=factors)
    if made.kind == "f":
        made._factors = factors
        made._of = x._of | y._of | {x._number, y._number}
    return made


def _is_whole_sum(value: Array, x: Array, y: Array) -> bool:
    """True if float64 holds a sum exactly; otherwise a device may round it to either side."""
    return bool((value - x == y).all() and (value - y == x).all())


def _term(lane: Bounded) -> Term:
    if lane._sum is not None:
        return lane._sum
    return Single(lane.low, lane.high, lane.magnitude)


def _product_form(x: Bounded, y: Bounded) -> Form | None:
    if x.form is None and y.form is None:
        return None
    if y.is_exact:
        assert x.form is not None
        return x.form.scaled(y.value)
    if x.is_exact:
        return _product_form(y, x)
    form = x.any_form.scaled(y.value).plus(y.any_form.scaled(x.value))
    return form.widened(x.radius * y.radius)


def _is_coarse(lane: Bounded) -> bool:
    return is_coarse(lane.value) if lane._sum is None else lane._sum.is_exact

"""The lanes of an evaluation with bounds: an exact value, and where a device's value may lie.

``functions.py`` has the functions of these lanes; together they take the place of NumPy and its
arrays in the reference's definitions of the builtins. Intervals as in Moore, "Interval Analysis",
1966: every operation contains all results for operands within their intervals, rounded as a device
may round them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....stdlib.builtins.facts import SMALLEST_NORMAL
from . import whole
from .affine import Form, alone, chosen, shared
from .rounding import (
    SUBNORMAL_STEP,
    ULP,
    Array,
    constant_ends,
    is_float32,
    of_device,
    outward,
)

_EXACT_SUM = 2.0**12
"""Sums of multiples of its reciprocal are exact in any order while they stay below it."""


@dataclass(slots=True, eq=False)
class _Sum:
    """That a lane is a sum, whose terms a compiler may add in another order."""

    additions: int
    left: Bounded
    right: Bounded
    is_exact: bool
    """Whether every partial sum of its terms is a float32."""
    widened: Array = 0.0
    """By how much the lane was widened because of the order of its terms."""
    _magnitude: Array | None = None

    @property
    def magnitude(self) -> Array:
        """The sum of the magnitudes of all terms, which limits every partial sum."""
        if self._magnitude is None:
            self._magnitude = _terms(self.left) + _terms(self.right)
        return self._magnitude


@dataclass(slots=True, eq=False)
class _Product:
    """That a lane is a product, whose factors a compiler may multiply in another order."""

    multiplications: int
    low: Array
    high: Array
    """The ends of the product, if no multiplication of its factors rounded."""

    def rounded(self) -> tuple[Array, Array]:
        """The ends of the product, rounded after each multiplication in any order."""
        error = self.error
        return of_device(self.low - error, self.high + error)

    @property
    def error(self) -> Array:
        """How much all roundings together may change."""
        largest = np.maximum(np.abs(self.low), np.abs(self.high))
        return self.multiplications * (ULP * largest + SUBNORMAL_STEP)


class Bounded:
    """One lane: arrays of the same kind (float64, int64 or bool) that broadcast together.

    ``value`` is what the program means. A conforming device has a value from ``low`` to ``high``.
    Of a condition, ``low`` says where it certainly holds, and ``high`` where it may hold. Ends that
    are NaN say nothing.
    """

    __slots__ = ("_product", "_radius", "_sum", "form", "high", "low", "value")
    __array_ufunc__ = None
    """NumPy leaves operations with these lanes to the methods below."""
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, value: Array, low: Array, high: Array, form: Form | None = None) -> None:
        """``form`` limits the interval further, if it is known how errors are shared."""
        self.value, self.low, self.high, self.form = value, low, high, form
        if form is not None:
            radius = form.radius
            self.low = _tighter(np.fmax, low, value - radius)
            self.high = _tighter(np.fmin, high, value + radius)
        self._radius: Array | None = None
        self._sum: _Sum | None = None
        self._product: _Product | None = None

    @property
    def is_exact(self) -> bool:
        """Whether every device has exactly ``value`` everywhere."""
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
        return np.maximum(np.abs(self.low), np.abs(self.high))

    @property
    def radius(self) -> Array:
        """By how much a device's value may differ from the exact one, to the farther side."""
        if self._radius is None:
            self._radius = np.maximum(self.high - self.value, self.value - self.low)
        return self._radius

    @property
    def any_form(self) -> Form:
        """Its form, or one that shares no error."""
        return alone(self.radius) if self.form is None else self.form

    def __bool__(self) -> bool:
        """Whether a condition that is the same for all elements certainly holds."""
        return bool(np.all(self.low))

    def any(self) -> bool:
        """Whether a condition may hold anywhere."""
        return bool(np.any(self.high))

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
        other = as_bounded(other)
        return _added(self, other, self.low + other.low, self.high + other.high)

    def __sub__(self, other: Any) -> Bounded:
        if self is other:
            return exact(np.zeros_like(self.value))
        return self + -as_bounded(other)

    def __mul__(self, other: Any) -> Bounded:
        return _multiplied(self, as_bounded(other))

    def __truediv__(self, divisor: float) -> Bounded:
        """A quotient by a constant, or a product with its reciprocal: 2.5 ulp (WGSL, "Accuracy of
        Concrete Floating Point Expressions"); ``Bounds.divide`` divides by other lanes."""
        quotient = Bounded(self.value / divisor, *products(self, exact(1.0 / divisor)))
        return widened(quotient, 2.5 * ULP * quotient.magnitude)

    def __neg__(self) -> Bounded:
        made = exact(-self.value)
        if not self.is_exact:
            form = None if self.form is None else self.form.scaled(-1.0)
            made = Bounded(made.value, -self.high, -self.low, form)
        made._sum = self._sum
        if (product := self._product) is not None:
            made._product = _Product(product.multiplications, -product.high, -product.low)
        return made

    def __abs__(self) -> Bounded:
        if self.is_exact:
            return exact(np.abs(self.value))
        inside = (self.low <= 0) & (self.high >= 0)
        low = np.minimum(np.abs(self.low), np.abs(self.high))
        form = None
        if self.form is not None:
            form = chosen(self.low >= 0, self.high <= 0, self.form, self.form.scaled(-1.0),
                          self.radius)  # fmt: skip
        return Bounded(np.abs(self.value), np.where(inside, 0, low), self.magnitude, form)

    def __radd__(self, other: Any) -> Bounded:
        return as_bounded(other) + self

    def __rsub__(self, other: Any) -> Bounded:
        return as_bounded(other) + -self

    def __rmul__(self, other: Any) -> Bounded:
        return as_bounded(other) * self

    # --- comparisons ------------------------------------------------------------------------------

    def __lt__(self, other: Any) -> Bounded:
        other = as_bounded(other)
        return _condition(self, other, np.less, self.high < other.low, self.low >= other.high)

    def __le__(self, other: Any) -> Bounded:
        other = as_bounded(other)
        return _condition(self, other, np.less_equal, self.high <= other.low, self.low > other.high)

    def __gt__(self, other: Any) -> Bounded:
        return as_bounded(other) < self

    def __ge__(self, other: Any) -> Bounded:
        return as_bounded(other) <= self

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

    def __and__(self, other: Any) -> Bounded:
        return _whole(whole.bit_and, self, other)

    def __or__(self, other: Any) -> Bounded:
        return _whole(whole.bit_or, self, other)

    def __xor__(self, other: Any) -> Bounded:
        return _whole(whole.bit_xor, self, other)

    def __lshift__(self, other: Any) -> Bounded:
        return _whole(whole.shifted_left, self, other)

    def __rshift__(self, other: Any) -> Bounded:
        return _whole(whole.shifted_right, self, other)

    def __floordiv__(self, other: Any) -> Bounded:
        return _whole(whole.quotient, self, other)

    def __mod__(self, other: Any) -> Bounded:
        return _whole(whole.remainder, self, other)

    def __rand__(self, other: Any) -> Bounded:
        return as_bounded(other) & self

    def __ror__(self, other: Any) -> Bounded:
        return as_bounded(other) | self

    def __rxor__(self, other: Any) -> Bounded:
        return as_bounded(other) ^ self

    def __rlshift__(self, other: Any) -> Bounded:
        return as_bounded(other) << self

    def __rrshift__(self, other: Any) -> Bounded:
        return as_bounded(other) >> self

    def __rfloordiv__(self, other: Any) -> Bounded:
        return as_bounded(other) // self

    def __rmod__(self, other: Any) -> Bounded:
        return as_bounded(other) % self


# --- making lanes ---------------------------------------------------------------------------------


def exact(value: Any) -> Bounded:
    """A lane that every device has exactly, such as an integer."""
    array = np.asarray(value)[()]
    return Bounded(array, array, array)


def given(value: Any) -> Bounded:
    """A lane from outside, such as a vertex input; devices may flush what is subnormal."""
    array = np.asarray(value)[()]
    if array.dtype.kind != "f" or is_float32(array):
        return exact(array)
    return Bounded(array, *constant_ends(array))


def remembered(lane: Any) -> Any:
    """A lane whose error is shared by all that is computed from it."""
    if not isinstance(lane, Bounded) or lane.is_exact or lane.kind != "f":
        return lane
    made = Bounded(lane.value, lane.low, lane.high, shared(lane.radius))
    made._sum, made._product = lane._sum, lane._product
    return made


def constant(value: float) -> Bounded:
    """A constant of a text, which a compiler rounds to the nearest float32."""
    number = np.float64(value)
    return exact(number) if is_float32(number) else Bounded(number, *constant_ends(number))


def as_bounded(lane: Any) -> Bounded:
    """A lane as it is; a Python float as a constant of a text; anything else as exact."""
    if isinstance(lane, Bounded):
        return lane
    return constant(lane) if isinstance(lane, float) else exact(lane)


def between(value: Array, low: Array, high: Array) -> Bounded:
    """A lane with a device's value from ``low`` to ``high``, which need not contain ``value``."""
    return Bounded(value, np.minimum(value, low), np.maximum(value, high))


def hull(x: Bounded, y: Bounded) -> Bounded:
    """The value of ``x``, on a device any value that ``x`` or ``y`` may have."""
    return Bounded(x.value, np.minimum(x.low, y.low), np.maximum(x.high, y.high))


def widened(x: Bounded, by: Array) -> Bounded:
    """The lane of a device whose function has an absolute error of its own.

    The error may be less than the distance of subnormal numbers, of which it is the nearest one.
    """
    by = by + SUBNORMAL_STEP
    low, high = of_device(x.low - by, x.high + by)
    form = None if x.form is None else x.form.widened(by + _lost(low, high))
    return Bounded(x.value, low, high, form)


def _tighter(choose: Callable[[Array, Array], Array], end: Array, limit: Array) -> Array:
    """An end of an interval, limited further unless one of the two numbers says nothing."""
    found = choose(end, limit)
    unknown = np.isnan(end)
    return np.where(unknown, end, found) if unknown.any() else found


def _lost(low: Array, high: Array) -> Array:
    """What a form has to allow for besides rounding: subnormal numbers, and those too large."""
    if np.isfinite(low).all() and np.isfinite(high).all():
        return SMALLEST_NORMAL
    return np.where(np.isfinite(low) & np.isfinite(high), SMALLEST_NORMAL, np.inf)


# --- operations -----------------------------------------------------------------------------------


def products(x: Bounded, y: Bounded) -> tuple[Array, Array]:
    """The ends of all products; NaN where one may be infinite and the other one zero."""
    return _products((x.low, x.high), (y.low, y.high))


def _products(x: whole.Ends, y: whole.Ends) -> tuple[Array, Array]:
    a, b, c, d = (one * other for one in x for other in y)
    low = np.minimum(np.minimum(a, b), np.minimum(c, d))
    high = np.maximum(np.maximum(a, b), np.maximum(c, d))
    if np.isfinite(low).all() and np.isfinite(high).all():
        return low, high
    nothing = (_is_infinite(*x) & _has_zero(*y)) | (_has_zero(*x) & _is_infinite(*y))
    return np.where(nothing, np.nan, low), np.where(nothing, np.nan, high)


def _is_infinite(low: Array, high: Array) -> Array:
    return ~(np.isfinite(low) & np.isfinite(high))


def _has_zero(low: Array, high: Array) -> Array:
    return (low <= 0) & (high >= 0)


def negated(condition: Bounded) -> Bounded:
    """Where a condition does not hold."""
    if condition.is_exact:
        return exact(np.logical_not(condition.value))
    return Bounded(~condition.value, ~condition.high, ~condition.low)


def _condition(x: Bounded, y: Bounded, compare: Any, holds: Array, fails: Array) -> Bounded:
    value = compare(x.value, y.value)
    if x.is_exact and y.is_exact:
        return exact(value)
    return Bounded(value, holds, np.logical_not(fails))


def _rounded(value: Array, low: Array, high: Array, form: Form | None = None) -> Bounded:
    """The result of a correctly rounded operation, from the ends of its exact results."""
    if np.asarray(value).dtype.kind != "f":
        return exact(value) if low is high else Bounded(value, low, high)
    if low is high and is_float32(value):
        return exact(value)
    low, high = outward(low, high)
    if form is not None:
        form = form.widened(ULP * np.maximum(np.abs(low), np.abs(high)) + _lost(low, high))
    return Bounded(value, low, high, form)


def _added(x: Bounded, y: Bounded, low: Array, high: Array) -> Bounded:
    """A sum, with the error that any order of its terms may have.

    GLSL and HLSL let a compiler reassociate what is not ``precise``, and WGSL does so as well
    ("Reassociation and Fusion"). Each of n additions rounds a partial sum, which no order makes
    larger than the sum of all magnitudes (Higham, "Accuracy and Stability", section 4.2).
    """
    value = x.value + y.value
    if x.is_exact and y.is_exact:
        low = high = value
    form = None if x.form is None and y.form is None else x.any_form.plus(y.any_form)
    made = _rounded(value, low, high, form)
    if made.kind != "f":
        return made
    before = [lane._sum for lane in (x, y) if lane._sum is not None]
    sum_ = _Sum(1 + sum(each.additions for each in before), x, y, _in_any_order(x, y, made))
    if before and not sum_.is_exact:
        sum_.widened = sum_.additions * (ULP * sum_.magnitude + SMALLEST_NORMAL)
        more = sum_.widened - sum([each.widened for each in before])
        form = None if form is None else form.widened(more)
        made = Bounded(
            value, np.minimum(made.low, low - more), np.maximum(made.high, high + more), form
        )
    made._sum = sum_
    return made


def _multiplied(x: Bounded, y: Bounded) -> Bounded:
    """A product, with the error that any order of its factors may have.

    In another order other products round, on either side. Orders with partial products that are
    no normal numbers, where those of the written order are, are not allowed for.
    """
    value = x.value * y.value
    if x.is_exact and y.is_exact:
        ends = value, value
        made = _rounded(value, value, value)
    else:
        ends = _square(x) if x is y else products(x, y)
        made = _rounded(value, *ends, _product_form(x, y))
    if made.kind != "f":
        return made
    before = [lane._product for lane in (x, y) if lane._product is not None]
    if not before:
        made._product = _Product(1, *ends)
        return made
    total = 1 + sum(each.multiplications for each in before)
    product = _Product(total, *_products(_unrounded(x), _unrounded(y)))
    low, high = product.rounded()
    form = None if made.form is None else made.form.widened(product.error)
    again = Bounded(value, np.minimum(made.low, low), np.maximum(made.high, high), form)
    again._product = product
    return again


def _unrounded(lane: Bounded) -> tuple[Array, Array]:
    """The ends of a lane; of a product, before its multiplications rounded."""
    product = lane._product
    return (lane.low, lane.high) if product is None else (product.low, product.high)


def _square(x: Bounded) -> tuple[Array, Array]:
    nearest = np.minimum(np.abs(x.low), np.abs(x.high))
    near = np.where((x.low <= 0) & (x.high >= 0), 0.0, nearest)
    return near * near, x.magnitude**2


def _product_form(x: Bounded, y: Bounded) -> Form | None:
    if x.form is None and y.form is None:
        return None
    form = x.any_form.scaled(y.value).plus(y.any_form.scaled(x.value))
    return form.widened(x.radius * y.radius)


def _in_any_order(x: Bounded, y: Bounded, made: Bounded) -> bool:
    """Whether adding the terms in any order is exact: they are small multiples of a fraction."""
    if not (x.is_exact and y.is_exact and made.is_exact):
        return False
    return all(_is_coarse(lane) for lane in (x, y))


def _is_coarse(lane: Bounded) -> bool:
    if lane._sum is not None:
        return lane._sum.is_exact
    scaled = lane.value * _EXACT_SUM
    return bool((np.abs(lane.value) < _EXACT_SUM / 64).all() and (np.rint(scaled) == scaled).all())


def _terms(lane: Bounded) -> Array:
    return lane.magnitude if lane._sum is None else lane._sum.magnitude


def _whole(operation: whole.Operation, x: Bounded, other: Any) -> Bounded:
    """An operation on whole numbers, which does not round."""
    y = as_bounded(other)
    value = operation.of(x.value, y.value)
    if x.is_exact and y.is_exact:
        return exact(value)
    low, high = operation.ends((x.low, x.high), (y.low, y.high))
    return Bounded(value, low, high)

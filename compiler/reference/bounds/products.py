"""The ends of products, and what becomes of them where a compiler takes factors in another order.

``bounded.py`` makes its products with these.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from ....stdlib.builtins.facts import LARGEST_FLOAT, SMALLEST_NORMAL
from .affine import Form
from .rounding import SUBNORMAL_STEP, Array, lost, of_device, rounding_error

_USUAL = 2.0**8
"""Of factors up to this one it is enough to know the largest of all elements."""
_MAY_OVERFLOW = 0.5 * LARGEST_FLOAT
_ALL_NORMAL = 4.0 * SMALLEST_NORMAL
"""Beyond these, the roundings of many factors do not matter."""


class Interval(Protocol):
    """What a product needs to know of its factors."""

    value: Array
    low: Array
    high: Array
    form: Form | None

    @property
    def is_exact(self) -> bool:
        """Whether every device has exactly ``value``."""

    @property
    def magnitude(self) -> Array:
        """The largest magnitude that a device may have."""

    @property
    def radius(self) -> Array:
        """By how much a device's value may differ."""

    @property
    def any_form(self) -> Form:
        """Its form, or one that shares no error."""


def products(x: Interval, y: Interval) -> tuple[Array, Array]:
    """The ends of all products; NaN where one may be infinite and the other one zero."""
    if y.is_exact:
        one, other = x.low * y.value, x.high * y.value
        return np.minimum(one, other), np.maximum(one, other)
    if x.is_exact:
        return products(y, x)
    a, b, c, d = x.low * y.low, x.low * y.high, x.high * y.low, x.high * y.high
    low = np.minimum(np.minimum(a, b), np.minimum(c, d))
    high = np.maximum(np.maximum(a, b), np.maximum(c, d))
    if np.isfinite((high - low).sum()):
        return low, high
    nothing = (_is_infinite(x) & _has_zero(y)) | (_has_zero(x) & _is_infinite(y))
    return np.where(nothing, np.nan, low), np.where(nothing, np.nan, high)


def square(x: Interval) -> tuple[Array, Array]:
    """The ends of all squares."""
    nearest = np.minimum(np.abs(x.low), np.abs(x.high))
    near = np.where(_has_zero(x), 0, nearest)
    return near * near, x.magnitude**2


def product_form(x: Interval, y: Interval) -> Form | None:
    """The form of a product, if one of its factors has one."""
    if x.form is None and y.form is None:
        return None
    if y.is_exact:
        assert x.form is not None
        return x.form.scaled(y.value)
    if x.is_exact:
        return product_form(y, x)
    form = x.any_form.scaled(y.value).plus(y.any_form.scaled(x.value))
    return form.widened(x.radius * y.radius)


def growth(x: Interval) -> Array:
    """How much larger a factor may make a product: its magnitude, or 1 if that is more.

    Usual factors have one number for all elements, so that usual products take no more time.
    """
    above = np.maximum.reduce(x.high, axis=None, initial=1.0)
    below = np.minimum.reduce(x.low, axis=None, initial=-1.0)
    largest = max(above, -below)
    return largest if largest <= _USUAL else np.maximum(x.magnitude, 1.0)


def in_any_order(
    low: Array, high: Array, form: Form | None, times: int, grown: Array
) -> tuple[Array, Array, Form | None]:
    """The ends and the form of a product of several factors, rounded ``times`` times.

    ``grown`` is the product of what ``growth`` says of its factors: no order has a larger partial
    product, and the factors that are still missing from one never make it larger by more. So a
    partial product may overflow only where ``grown`` does, and it may be subnormal only where the
    result is small beside ``grown``: then it may be flushed to zero, or be off by half of itself.
    """
    magnitude = np.maximum(np.abs(low), np.abs(high))
    error = rounding_error(magnitude, times, SUBNORMAL_STEP * grown)
    smallest = _ALL_NORMAL * grown
    low, high = of_device(low - error, high + error, smallest)
    if form is not None:
        form = form.widened(error + lost(magnitude + error, smallest))
    over = grown > _MAY_OVERFLOW
    if not np.count_nonzero(over):
        return low, high, form
    low = np.where(over & (low <= 0), -np.inf, low)
    high = np.where(over & (high >= 0), np.inf, high)
    return low, high, None if form is None else form.widened(np.where(over, np.inf, 0.0))


def _is_infinite(x: Interval) -> Array:
    return ~(np.isfinite(x.low) & np.isfinite(x.high))


def _has_zero(x: Interval) -> Array:
    return (x.low <= 0) & (x.high >= 0)

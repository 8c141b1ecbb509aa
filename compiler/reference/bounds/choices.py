"""Choices between two lanes with bounds, by a condition or by their size.

``functions.py`` has NumPy's functions by these.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .affine import chosen
from .bounded import Bounded, as_bounded, exact
from .lanes import hull
from .rounding import Array


def of_conditions(function: Callable[[Any, Any], Array], x: Any, y: Any) -> Bounded:
    """Joins two conditions by ``and`` or ``or``: a function that never falls."""
    x, y = as_bounded(x), as_bounded(y)
    value = function(x.value, y.value)
    if x.is_exact and y.is_exact:
        return exact(value)
    return Bounded(value, function(x.low, y.low), function(x.high, y.high))


def of_ends(
    function: Callable[[Array, Array], Array], wins: Callable[[Array, Array], Array], x: Any, y: Any
) -> Bounded:
    """The lesser or the greater number."""
    x, y = as_bounded(x), as_bounded(y)
    value = function(x.value, y.value)
    if x.is_exact and y.is_exact:
        return exact(value)
    low, high = function(x.low, y.low), function(x.high, y.high)
    if x.form is None and y.form is None:
        return Bounded(value, low, high)
    first = wins(x.low, y.high) & wins(x.high, y.low)
    if first.all():
        return Bounded(value, low, high, chosen(first, None, x.any_form, y.any_form))
    second = wins(y.low, x.high) & wins(y.high, x.low)
    farther = Bounded(value, low, high).radius
    form = chosen(first, second, x.any_form, y.any_form, farther)
    return Bounded(value, low, high, form)


def certain_choice(value: Array, is_first: Array, x: Bounded, y: Bounded) -> Bounded:
    """``x`` or ``y``, which is certain."""
    low, high = np.where(is_first, x.low, y.low), np.where(is_first, x.high, y.high)
    if x.form is None and y.form is None:
        return Bounded(value, low, high)
    return Bounded(value, low, high, chosen(is_first, None, x.any_form, y.any_form))


def open_choice(value: Array, is_first: Array, is_second: Array, x: Bounded, y: Bounded) -> Bounded:
    """``x``, ``y``, or anything between them where it may be either."""
    both = hull(x, y)
    low = np.where(is_first, x.low, np.where(is_second, y.low, both.low))
    high = np.where(is_first, x.high, np.where(is_second, y.high, both.high))
    if x.form is None and y.form is None:
        return Bounded(value, low, high)
    farther = Bounded(value, low, high).radius
    return Bounded(value, low, high, chosen(is_first, is_second, x.any_form, y.any_form, farther))

"""Lanes with bounds, made from other lanes without an operation of the program.

Whoever evaluates with bounds calls these: to begin with what comes from outside, and to say what is
known of a lane besides the operation that made it.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .bounded import Bounded, correctly_rounded, exact
from .rounding import Array, constant_ends, is_float32


def given(value: Any) -> Bounded:
    """A lane from outside, such as a vertex input; devices may flush subnormal numbers."""
    array = np.asarray(value)[()]
    if array.dtype.kind != "f" or is_float32(array):
        return exact(array)
    return Bounded(array, *constant_ends(array))


def remembered(lane: Any) -> Any:
    """A lane whose error is shared by all that is computed from it."""
    if not isinstance(lane, Bounded) or lane.is_exact or lane.kind != "f":
        return lane
    made = Bounded(lane.value, lane.low, lane.high, lane.any_form.shared())
    return made.made_as(lane)


def all_remembered(value: tuple[Any, ...]) -> tuple[Any, ...]:
    """A value whose lanes' errors are shared by all that is computed from them."""
    return tuple(
        all_remembered(lane) if isinstance(lane, tuple) else remembered(lane) for lane in value
    )


def between(value: Array, low: Array, high: Array) -> Bounded:
    """A lane with a device's value from ``low`` to ``high``, which need not contain ``value``."""
    return Bounded(value, np.minimum(value, low), np.maximum(value, high))


def hull(x: Bounded, y: Bounded) -> Bounded:
    """The value of ``x``, on a device any value that ``x`` or ``y`` may have."""
    return Bounded(x.value, np.minimum(x.low, y.low), np.maximum(x.high, y.high))


def either(x: Bounded, y: Bounded) -> Bounded:
    """The result of one of two formulas for the same value."""
    found = hull(x, y)
    if x.form is not None and y.form is not None:
        found = Bounded(x.value, found.low, found.high, x.form.or_else(y.form))
    return found


def rounded(x: Bounded) -> Bounded:
    """The lane of a device that rounds this result correctly."""
    return correctly_rounded(x.value, x.low, x.high, x.form)


def limited(x: Bounded, low: Array, high: Array) -> Bounded:
    """The lane, of which is known that it is between these, too."""
    return x.within(np.maximum(x.low, low), np.minimum(x.high, high)).made_as(x)

"""What comes of the values that the invocations of a kernel scatter, and what may on a device.

``kernel.py`` calls ``joined`` for each buffer that is scattered to. All that counts is which
values are joined, as the order does not matter. Where rounding may tip whether, where or what an
invocation joins, a device may have any of the results.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..ir.kernel import ScatterOperator, ends, neutral
from ..ir.shader import Store
from ..ir.types import INT
from .bounds import Bounded

Array = NDArray[Any]

JOINING: Mapping[ScatterOperator, Any] = {
    "add": np.add,
    "min": np.minimum,
    "max": np.maximum,
    "and": np.bitwise_and,
    "or": np.bitwise_or,
}
"""The functions of NumPy that join two arrays of integers."""


def joined(
    store: Store, length: int, value: Bounded, place: Bounded, condition: Bounded
) -> tuple[Array, Array, Array]:
    """What ``length`` elements become, and the least and the most that a device may have."""
    operator = store.operator
    assert operator is not None
    signed = store.buffer.type.element == INT
    start = np.full(length, neutral(operator, signed=signed), np.int64)
    exact, low, high = start.copy(), start.copy(), start.copy()
    values, places = _integers(value.value), _integers(place.value)
    chosen = np.asarray(condition.value, np.bool_) & (places >= 0) & (places < length)
    JOINING[operator].at(exact, places[chosen], values[chosen])
    certain = _certain(value, place, condition)
    sure = chosen & certain
    JOINING[operator].at(low, places[sure], values[sure])
    JOINING[operator].at(high, places[sure], values[sure])
    everything = ends(signed=signed)
    for at in np.flatnonzero(~certain):
        for element in _possible(place, condition, int(at), length):
            joining = int(value.low[at]), int(value.high[at])
            low[element], high[element] = _widened(
                operator, (int(low[element]), int(high[element])), joining, everything
            )
    least, most = everything
    around = (low < least) | (high > most)
    if (low != high).any():
        low, high = np.where(around, least, low), np.where(around, most, high)
    return (
        _wrapped(exact, signed=signed),
        _wrapped(low, signed=signed),
        _wrapped(high, signed=signed),
    )


def _integers(values: Any) -> Array:
    made: Array = np.asarray(values).astype(np.int64)
    return made


def _certain(value: Bounded, place: Bounded, condition: Bounded) -> Array:
    """Which invocations do the same on every device."""
    holds = np.asarray(condition.low, np.bool_) == np.asarray(condition.high, np.bool_)
    never: Array = ~np.asarray(condition.high, np.bool_)
    same = _integers(value.low) == _integers(value.high)
    there: Array = same & (_integers(place.low) == _integers(place.high))
    certain: Array = never | (holds & there)
    return certain


def _possible(place: Bounded, condition: Bounded, at: int, length: int) -> Iterator[int]:
    """The elements that an invocation may choose."""
    if np.asarray(condition.high)[at]:
        first, last = max(int(place.low[at]), 0), min(int(place.high[at]), length - 1)
        yield from range(first, last + 1)


def _widened(
    operator: ScatterOperator,
    known: tuple[int, int],
    value: tuple[int, int],
    everything: tuple[int, int],
) -> tuple[int, int]:
    """The ends of an element with which a value may be joined, or not."""
    low, high = known
    if operator == "add":
        return low + min(0, value[0]), high + max(0, value[1])
    if operator == "min":
        return min(low, value[0]), high
    if operator == "max":
        return low, max(high, value[1])
    return everything


def _wrapped(values: Array, *, signed: bool) -> Array:
    """Sums as 32 bits hold them."""
    whole: Array = values & 0xFFFFFFFF
    wrapped: Array = np.where(whole >= 2**31, whole - 2**32, whole) if signed else whole
    return wrapped

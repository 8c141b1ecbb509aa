"""Joins the values that the invocations of a kernel scatter, with the bounds of a device.

``kernel.py`` calls ``joined`` for each buffer that is scattered to. All that counts is which values
are joined, as the order does not matter. Where rounding may tip whether, where or what an
invocation joins, a device may have any of the results.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..ir.kernel import ScatterOperator, ends, neutral
from ..ir.shader import Store
from ..ir.types import INT
from .bounds import Bounded
from .runs import added_to_runs, joined_with_runs

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
    """The new values of ``length`` elements, and the least and the most that a device may have."""
    operator = store.operator
    assert operator is not None
    signed = store.buffer.type.element == INT
    start = np.full(length, neutral(operator, signed=signed), np.int64)
    found = start.copy()
    values, places = _integers(value.value), _integers(place.value)
    chosen = np.asarray(condition.value, np.bool_) & (places >= 0) & (places < length)
    JOINING[operator].at(found, places[chosen], values[chosen])
    joins = _Joins.of(length, value, place, condition)
    low, high = _ends(operator, start, joins, ends(signed=signed))
    return (
        _wrapped(found, signed=signed),
        _wrapped(low, signed=signed),
        _wrapped(high, signed=signed),
    )


@dataclass(frozen=True, slots=True)
class _Joins:
    """The values that invocations may join, without those that join nothing."""

    low: Array
    high: Array
    """The least and the greatest value."""
    first: Array
    last: Array
    """The first and the last element that it may be joined with."""
    certain: Array
    """True if it is joined for certain, and its element is known."""

    @classmethod
    def of(cls, length: int, value: Bounded, place: Bounded, condition: Bounded) -> _Joins:
        low, high = _integers(value.low), _integers(value.high)
        least, most = _integers(place.low), _integers(place.high)
        first, last = np.maximum(least, 0), np.minimum(most, length - 1)
        here = np.asarray(condition.high, np.bool_) & (first <= last)
        certain = np.asarray(condition.low, np.bool_) & (least == most)
        return cls(*(each[here] for each in (low, high, first, last, certain)))

    def chosen(self, which: Array) -> _Joins:
        """The joins that ``which`` selects."""
        every = (self.low, self.high, self.first, self.last, self.certain)
        return _Joins(*(each[which] for each in every))


def _ends(
    operator: ScatterOperator, start: Array, joins: _Joins, everything: tuple[int, int]
) -> tuple[Array, Array]:
    """The least and the most that elements may become."""
    certain = joins.certain
    if operator in ("and", "or"):
        # The bits of a number that is between two others may be anything.
        certain = certain & (joins.low == joins.high)
    sure, may = joins.chosen(certain), joins.chosen(~certain)
    low, high = start.copy(), start.copy()
    JOINING[operator].at(low, sure.first, sure.low)
    JOINING[operator].at(high, sure.first, sure.high)
    least, most = everything
    match operator:
        case "add":
            low = added_to_runs(low, may.first, may.last, np.minimum(may.low, 0))
            high = added_to_runs(high, may.first, may.last, np.maximum(may.high, 0))
        case "min":
            low = joined_with_runs(np.minimum, most, low, may.first, may.last, may.low)
        case "max":
            high = joined_with_runs(np.maximum, least, high, may.first, may.last, may.high)
        case "and" | "or":
            ones = np.ones_like(may.first)
            touched = added_to_runs(np.zeros_like(start), may.first, may.last, ones) > 0
            low, high = np.where(touched, least, low), np.where(touched, most, high)
    around = (low != high) & ((low < least) | (high > most))
    return np.where(around, least, low), np.where(around, most, high)


def _integers(values: Any) -> Array:
    made: Array = np.asarray(values).astype(np.int64)
    return made


def _wrapped(values: Array, *, signed: bool) -> Array:
    """Sums as 32 bits hold them."""
    whole: Array = values & 0xFFFFFFFF
    wrapped: Array = np.where(whole >= 2**31, whole - 2**32, whole) if signed else whole
    return wrapped

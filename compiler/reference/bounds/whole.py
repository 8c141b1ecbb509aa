"""Intervals of whole numbers: bit operations, shifts, quotients and remainders.

``Bounded`` has them as its operators. Few programs compute with integers that a device may have
otherwise (such as a ``floor`` that may tip), so functions that are not monotone are evaluated at
both ends of an interval of two numbers, and any wider one says nothing.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any

import numpy as np

from .rounding import Array

Ends = tuple[Array, Array]

LEAST, LARGEST = -(2**31), 2**32 - 1
"""The ends of all integers of 32 bits, with a sign or without one."""


@dataclass(frozen=True, slots=True)
class Operation:
    """An operation on whole numbers."""

    of: Callable[[Any, Any], Any]
    """The operation itself."""
    ends: Callable[[Ends, Ends], Ends]
    """Between which numbers its results are, for operands between these."""


def _at_corners(of: Callable[[Any, Any], Any], x: Ends, y: Ends) -> Ends:
    found = [np.asarray(of(a, b)) for a in _distinct(x) for b in _distinct(y)]
    return reduce(np.minimum, found), reduce(np.maximum, found)


def _distinct(ends: Ends) -> Sequence[Array]:
    """Both ends of an interval, or one of them, if they are the same everywhere."""
    low, high = ends
    return (low,) if low is high or np.array_equal(low, high) else ends


def _monotone(of: Callable[[Any, Any], Any]) -> Operation:
    """An operation whose extremes are at the ends of its operands."""
    return Operation(of, lambda x, y: _at_corners(of, x, y))


def _jumping(of: Callable[[Any, Any], Any]) -> Operation:
    """An operation that is known only at single numbers."""

    def ends(x: Ends, y: Ends) -> Ends:
        low, high = _at_corners(of, x, y)
        wide = _is_wide(x) | _is_wide(y)
        if not wide.any():
            return low, high
        return np.where(wide, LEAST, low), np.where(wide, LARGEST, high)

    return Operation(of, ends)


def _is_wide(ends: Ends) -> Array:
    """True where an interval has more than two numbers."""
    return np.asarray(ends[1] - ends[0] > 1)


def _modulo(
    of: Callable[[Any, Any], Any],
    size: Callable[[Array], Array],
    otherwise: Operation | None = None,
) -> Operation:
    """An operation that repeats itself with a period, and is the identity within each.

    ``size`` is the period for a second operand, or 0 if there is none; then it is like
    ``otherwise``.
    """
    jumping = otherwise or _jumping(of)

    def ends(x: Ends, y: Ends) -> Ends:
        period = np.where(y[0] == y[1], size(y[0]), 0)
        divisor = np.maximum(period, 1)
        together = (period > 0) & (x[0] // divisor == x[1] // divisor)
        if together.all():
            return of(x[0], y[0]), of(x[1], y[0])
        low, high = jumping.ends(x, y)
        low = np.where(together, of(x[0], y[0]), np.where(period > 0, 0, low))
        high = np.where(together, of(x[1], y[0]), np.where(period > 0, divisor - 1, high))
        return low, high

    return Operation(of, ends)


def _by_bits(of: Callable[[Any, Any], Any]) -> Operation:
    """An operation whose every bit depends on the same bit of the operands only.

    Numbers of an interval share the bits above the highest one in which its ends differ.
    """
    jumping = _jumping(of)

    def ends(x: Ends, y: Ends) -> Ends:
        low, high = jumping.ends(x, y)
        wide = _is_wide(x) | _is_wide(y)
        if not wide.any():
            return low, high
        other = y[0]
        below = _filled(x[0] ^ x[1])
        shared = of(x[0] & ~below, other) & ~below
        possible = of(below, other) | of(np.zeros_like(below), other)
        certain = (y[0] == y[1]) & ((x[0] >= 0) == (x[1] >= 0))
        least = np.where(certain, shared, LEAST)
        most = np.where(certain, shared | (possible & below), LARGEST)
        return np.where(wide, least, low), np.where(wide, most, high)

    return Operation(of, ends)


def _filled(number: Array) -> Array:
    """All bits up to the highest one that is set."""
    for by in (1, 2, 4, 8, 16, 32):
        number = number | (number >> by)
    return number


def _mask_size(mask: Array) -> Array:
    """One more than a mask of the lowest bits; 0 for any other number."""
    return np.where((mask > 0) & (mask & (mask + 1) == 0), mask + 1, 0)


bit_and = _modulo(operator.and_, _mask_size, _by_bits(operator.and_))
bit_or = _by_bits(operator.or_)
bit_xor = _by_bits(operator.xor)
shifted_left = _monotone(operator.lshift)
shifted_right = _monotone(operator.rshift)
quotient = _monotone(operator.floordiv)
"""Quotients by divisors that are certainly positive, or certainly negative."""
remainder = _modulo(operator.mod, lambda divisor: np.maximum(divisor, 0))

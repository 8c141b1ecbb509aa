"""What other orders of terms and of factors may make of a sum or a product.

GLSL and HLSL let a compiler reassociate what is not ``precise``, and WGSL does so as well
("Reassociation and Fusion"). ``bounded.py`` asks here how much wider a lane has to be for it. A
lane remembers that it is a sum or a product until it is rounded by anything else.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ....stdlib.builtins.facts import SMALLEST_NORMAL
from .affine import Form
from .rounding import SUBNORMAL_STEP, ULP, Array, Ends, of_device, products

_EXACT_SUM = 2.0**12
"""Sums of multiples of its reciprocal are exact in any order while they stay below it."""


class Lane(Protocol):
    """What is asked of a ``Bounded``."""

    value: Array
    low: Array
    high: Array
    form: Form | None
    sum: Sum | None
    product: Product | None

    @property
    def is_exact(self) -> bool: ...

    @property
    def magnitude(self) -> Array: ...


@dataclass(frozen=True, slots=True, eq=False)
class Sum:
    """That a lane is a sum, whose terms a compiler may add in another order."""

    roundings: int
    """How many operations round in any order; taking out a common factor is one more."""
    parts: Sequence[Lane]
    """The two terms of a first addition; of a longer sum, ``magnitudes`` are known instead."""
    magnitudes: Array
    is_exact: bool
    """Whether every partial sum of its terms is a float32."""
    error: Array
    """By how much the lane was widened because of the order of its terms."""

    @property
    def magnitude(self) -> Array:
        """The sum of the magnitudes of all terms, which limits every partial sum."""
        if not self.parts:
            return self.magnitudes
        left, right = self.parts
        return left.magnitude + right.magnitude


@dataclass(frozen=True, slots=True)
class Wider:
    """What a sum has to contain besides itself, because of other orders."""

    ends: Ends
    error: Array
    """How much its form is off in addition."""


@dataclass(frozen=True, slots=True, eq=False)
class Product:
    """That a lane is a product, whose factors a compiler may multiply in another order."""

    multiplications: int
    low: Array
    high: Array
    """The ends of the product, if no multiplication of its factors rounded."""

    def negated(self) -> Product:
        """The product with the other sign."""
        return Product(self.multiplications, -self.high, -self.low)

    def rounded(self) -> Ends:
        """The ends of the product, rounded after each multiplication in any order."""
        error = self.error
        return of_device(self.low - error, self.high + error)

    @property
    def error(self) -> Array:
        """How much all roundings together may change."""
        largest = np.maximum(np.abs(self.low), np.abs(self.high))
        return self.multiplications * (ULP * largest + SUBNORMAL_STEP)


def summed(x: Lane, y: Lane, made: Lane) -> tuple[Sum, Wider | None]:
    """The sum of two lanes, which is ``made`` in the written order, and what others make of it.

    Each of n additions rounds a partial sum, which no order makes larger than the sum of all
    magnitudes (Higham, "Accuracy and Stability of Numerical Algorithms", section 4.2). Of terms
    that are products, drivers take out common factors: ``a * c + b * c`` becomes ``c * (a + b)``.
    """
    before = [lane.sum for lane in (x, y) if lane.sum is not None]
    is_exact = x.is_exact and y.is_exact and made.is_exact and _is_coarse(x) and _is_coarse(y)
    if not before and (x.product is None or y.product is None):
        return Sum(1, (x, y), 0.0, is_exact, 0.0), None
    roundings = sum((each.roundings for each in before), 1 if before else 2)
    magnitudes = _terms(x) + _terms(y)
    if is_exact:
        return Sum(roundings, (), magnitudes, True, 0.0), None
    error = roundings * (ULP * magnitudes + SMALLEST_NORMAL)
    found = Sum(roundings, (), magnitudes, False, error)
    if not before:
        return found, _factored(x, y, error)
    more = error - sum(each.error for each in before)
    return found, Wider((x.low + y.low - more, x.high + y.high + more), more)


def _factored(x: Lane, y: Lane, error: Array) -> Wider:
    """The sum of two products with a common factor that is taken out.

    It rounds as often as the products do, but not on the same side. Forms allow for both sides.
    """
    (x_low, x_high), (y_low, y_high) = _unrounded(x), _unrounded(y)
    rounded = [lane.product.error for lane in (x, y) if lane.form is None and lane.product]
    return Wider((x_low + y_low - error, x_high + y_high + error), sum(rounded, 0.0))


def multiplied(x: Lane, y: Lane, ends: Ends) -> tuple[Product, bool]:
    """The product of two lanes, which has these ends, and whether its order can matter.

    In another order other products round, on either side. Orders with partial products that are
    no normal numbers, where those of the written order are, are not allowed for.
    """
    before = [lane.product for lane in (x, y) if lane.product is not None]
    if not before:
        return Product(1, *ends), False
    total = 1 + sum(each.multiplications for each in before)
    return Product(total, *products(_unrounded(x), _unrounded(y))), True


def _is_coarse(lane: Lane) -> bool:
    """Whether a term is a small multiple of a fraction, or an exact sum of such terms."""
    if lane.sum is not None:
        return lane.sum.is_exact
    scaled = lane.value * _EXACT_SUM
    return bool((np.abs(lane.value) < _EXACT_SUM / 64).all() and (np.rint(scaled) == scaled).all())


def _terms(lane: Lane) -> Array:
    return lane.magnitude if lane.sum is None else lane.sum.magnitude


def _unrounded(lane: Lane) -> Ends:
    """The ends of a lane; of a product, before its multiplications rounded."""
    product = lane.product
    return (lane.low, lane.high) if product is None else (product.low, product.high)

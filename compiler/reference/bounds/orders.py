"""Sums and products whose terms and factors a compiler may take in another order.

GLSL and HLSL let a compiler reassociate operations that are not ``precise``, and WGSL does so as
well ("Reassociation and Fusion"). ``bounded.py`` keeps one of these records with each sum and
product, and widens the next one by the error that any order may have.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....stdlib.builtins.facts import SMALLEST_NORMAL
from .rounding import Array, relative_error

_FINEST = 2.0**-12
_LARGEST = 2.0**6
"""The largest term up to which sums of multiples of ``_FINEST`` are exact in any order.

They stay so for very many terms.
"""
_COUNTED = 2.0**24
"""Float32 has all whole numbers up to this one."""


@dataclass(slots=True, eq=False)
class Sum:
    """The terms of a lane that is a sum of several ones."""

    roundings: int
    """The number of operations that may round a partial sum, in any order."""
    operands: tuple[Term, ...]
    """Both terms, until the sum is settled."""
    is_exact: bool
    """True if every partial sum of its terms is a float32."""
    error: Array = 0.0
    """The width that the order of its terms adds to its bounds."""
    _magnitude: Array | None = None
    _whole: Array | None = None

    @property
    def magnitude(self) -> Array:
        """The sum of the magnitudes of all terms, which limits every partial sum."""
        if self._magnitude is None:
            left, right = self.operands
            self._magnitude = left.magnitude + right.magnitude
        return self._magnitude

    @property
    def whole(self) -> Array:
        """True where every device has exactly each of the terms, and they are whole numbers."""
        if self._whole is None:
            left, right = self.operands
            self._whole = left.whole
            if np.count_nonzero(self._whole):
                self._whole = self._whole & right.whole
        return self._whole

    def settle(self) -> None:
        """Computes the properties of the sum, and forgets its terms.

        A loop that adds to it in every iteration would otherwise keep those of all iterations.
        """
        self._magnitude, self._whole = self.magnitude, self.whole
        self.operands = ()


@dataclass(slots=True, eq=False)
class Single:
    """A lane that is no sum, as a term."""

    low: Array
    high: Array
    magnitude: Array
    """The largest one that it may have."""

    @property
    def whole(self) -> Array:
        """True where every device has exactly this number, and it is whole."""
        same = np.equal(self.low, self.high)
        return same & (np.rint(self.low) == self.low) if np.count_nonzero(same) else same


Term = Sum | Single


def in_any_order(sum_: Sum) -> Array:
    """The additional width of the bounds of a sum for any order of its terms.

    Each of n operations rounds a partial sum, which no order makes larger than the sum of all
    magnitudes (Higham, "Accuracy and Stability", section 4.2), and may flush it to zero. Whole
    numbers that float32 counts one by one are not rounded in any order.
    """
    times = sum_.roundings
    flushed = times * np.minimum(sum_.magnitude, SMALLEST_NORMAL)
    error = relative_error(times) * sum_.magnitude + flushed
    if np.count_nonzero(whole := sum_.whole):
        error = np.where(whole & (sum_.magnitude <= _COUNTED), 0.0, error)
    sum_.error = error
    before = [term.error for term in sum_.operands if isinstance(term, Sum)]
    return sum_.error - sum(before)


def of_either(x: Sum, y: Sum) -> Sum:
    """The terms of a lane that a device computes by one of two sums, whichever is worse."""
    return Sum(
        max(x.roundings, y.roundings), (), x.is_exact and y.is_exact, np.minimum(x.error, y.error),
        np.maximum(x.magnitude, y.magnitude), x.whole & y.whole,
    )  # fmt: skip


def is_coarse(value: Array) -> bool:
    """True if sums of such numbers are exact in any order: small multiples of a fraction."""
    scaled = value / _FINEST
    return bool((np.abs(value) < _LARGEST).all() and (np.rint(scaled) == scaled).all())

"""``Fact``: the result of range analysis for a value, an interval and the length of a vector.

The range rules of builtins compute the fact of a result from the facts of the operands. Other
compilers call facts value ranges.
"""

from __future__ import annotations

import math
from typing import Literal

from ...support.frozen import frozen

LARGEST_FLOAT = 2.0**128 - 2.0**104
"""The largest number that a float32 holds."""
SMALLEST_NORMAL = 2.0**-126
"""A device may flush smaller magnitudes to zero, so Burnish defines them to count as zero."""
ULP = 2.0**-23
"""The largest unit in the last place of a float32, relative to the number.

A rounded number may be as far as this from the exact one, if it may be either neighbour.
"""

UNIT_SLACK = 1e-5
"""The length that float32 rounding may add to a vector of length one.

It is a few ulp for each operation, and enough for several of them. Because of it, ``acos(dot(n,
l))`` keeps the clamp that it needs.
"""

Kind = Literal["float", "int", "uint", "bool", "matrix"]

_LIMITS: dict[Kind, tuple[float, float]] = {
    "float": (-math.inf, math.inf),
    "int": (-(2.0**31), 2.0**31 - 1),
    "uint": (0.0, 2.0**32 - 1),
    "bool": (0.0, 1.0),
    "matrix": (-math.inf, math.inf),
}


@frozen(key=True)
class Fact:
    """Bounds of every lane of a value. ``lo`` is never above ``hi``; unknown is (-inf, inf)."""

    lo: float = -math.inf
    hi: float = math.inf
    nonzero: bool = False
    """True if every lane's magnitude is at least ``SMALLEST_NORMAL``."""
    unit: bool = False
    """True if the value is a vector of length one, up to rounding.

    It is so by declaration or by construction. It is shorter only if ``normalize`` got a vector
    that is too short to have a direction.
    """
    length: float = 0.0
    """The value is a vector of at least this length, before rounding."""
    kind: Kind = "float"
    """The type of the lanes.

    The analysis sets it from the value's type (``as_kind``). Rules need it, because integers wrap,
    and a product of matrices is not a product lane by lane.
    """

    @property
    def excludes_zero(self) -> bool:
        """True if no lane can be zero, nor so small that a device may flush it to zero."""
        return self.nonzero or self.lo >= SMALLEST_NORMAL or self.hi <= -SMALLEST_NORMAL

    @property
    def positive(self) -> bool:
        """True if every lane is above zero, and not so small that a device may flush it."""
        return self.lo >= SMALLEST_NORMAL or (self.nonzero and self.lo >= 0)

    @property
    def least(self) -> float:
        """A lower bound of every lane's magnitude."""
        bound = max(self.lo, -self.hi, 0.0)
        return max(bound, SMALLEST_NORMAL) if self.nonzero else bound

    @property
    def most(self) -> float:
        """An upper bound of every lane's magnitude."""
        return max(abs(self.lo), abs(self.hi))

    def in_words(self) -> str:
        """The bounds as messages say them: a number, or between which ones."""
        form = "g" if self.kind == "float" else ".0f"
        lo, hi = (f"{end + 0.0:{form}}" for end in (self.lo, self.hi))  # no zero has a sign
        return lo if lo == hi else f"between {lo} and {hi}"

    def within(self, lo: float, hi: float) -> bool:
        """True if every lane lies in [lo, hi]."""
        return lo <= self.lo and self.hi <= hi

    def as_kind(self, kind: Kind) -> Fact:
        """Converts the fact to lanes of type ``kind``; if an integer may wrap, all is unknown.

        An integer may wrap if it cannot hold the bounds.
        """
        if self.kind == kind == "float":
            return self
        lo, hi = _LIMITS[kind]
        if self.within(lo, hi):
            return Fact(self.lo, self.hi, self.nonzero, self.unit, self.length, kind)
        if (self.lo, self.hi) == (-math.inf, math.inf):
            return Fact(lo, hi, self.nonzero, self.unit, self.length, kind)
        return Fact(lo, hi, kind=kind)

    def union(self, other: Fact) -> Fact:
        """The fact of a value that is one of two values with these facts."""
        return Fact(
            min(self.lo, other.lo),
            max(self.hi, other.hi),
            self.excludes_zero and other.excludes_zero,
            self.unit and other.unit,
            min(self.length, other.length),
            self.kind,
        )

    def meet(self, other: Fact) -> Fact:
        """The fact of a value for which both facts hold; if they contradict, this fact."""
        lo, hi = max(self.lo, other.lo), min(self.hi, other.hi)
        if lo > hi:
            return self
        nonzero = self.excludes_zero or other.excludes_zero
        length = max(self.length, other.length)
        return Fact(lo, hi, nonzero, self.unit or other.unit, length, self.kind)


UNKNOWN = Fact()
UNIT = Fact(-1.0 - UNIT_SLACK, 1.0 + UNIT_SLACK, unit=True)

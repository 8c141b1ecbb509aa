"""Compares the picture of a route with the reference's bounds; ``conform`` calls it for each draw.

A pixel agrees if every lane of it lies between the bounds that the reference gives it. The meaning
of the material has to lie there, too: otherwise the compiler has changed the meaning.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from ...compiler.reference.picture import Expected

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Number = TypeVar("Number", np.float64, np.bool_)

LARGEST = float(np.finfo(np.float32).max)

SAYS_NOTHING = 1 / 8
"""The part of a picture's range above which the bounds of a value say nothing about it."""
USUAL = (0.02, 0.98)
"""The quantiles between which the picture's range is measured, so that a few pixels, such as a
highlight, cannot make it larger."""
CONSTANT = 0.25
"""The least range, relative to the largest value: that of a picture of one colour is 0. Of a black
picture it is 1."""

PROVEN_SHARE = 0.9
"""The part of the object's pixels, of all cases together, that has to be proven."""
FEW = 40
"""The number of pixels that may be unproven in any case: the outline of a small object has as
many."""
SEEN_SHARE = 0.01
"""The part of its picture that must be proven pixels of the object, in at least one case."""

IN_DOUBLE = 2.0**-40
"""The amount by which rounding to float64 may change a value, relative to the larger ones of a
lane."""
CANCELLED = 2.0**-8
"""The size below which a value may be the rest of numbers of about 1 that cancel, so that their
rounding counts instead of its own."""

Level = Literal["measured", "guaranteed"]
"""The bounds that are used: those that were measured of the driver, or those that specifications
guarantee."""


@dataclass(frozen=True, slots=True)
class Sample:
    """The values of one pixel."""

    x: int
    y: int
    target: int
    got: tuple[float, ...]
    expected: tuple[float, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]
    """The largest number that a conforming device's value may be; ``low`` is the smallest."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """The result of comparing two pictures; the counts are numbers of pixels."""

    level: Level
    """The bounds with which this was found."""
    pixels: int
    """All pixels of the picture."""
    covered: int
    """Pixels that the reference covers."""
    proven: int
    """Covered pixels whose bounds say something, and that do not overflow."""
    undecided: int
    """Pixels that are not compared: rounding decides what is drawn there."""
    wide: int
    """Other covered pixels, whose bounds say nothing: they are wider than ``SAYS_NOTHING``."""
    overflowing: int
    """Other pixels whose value is too large for float32, so that no value is correct."""
    wrong: int
    """Pixels that are out of bounds, or that only one of the pictures covers."""
    changed: int
    """Pixels where the meaning of the material is out of bounds: the compiler is to blame."""
    max_difference: float
    """The largest difference of any lane of a decided pixel; that of NaN is infinite."""
    excess: float
    """The largest difference of a decided lane, divided by that of its bound; up to 1 is
    agreement."""
    bite: float
    """The median of half the distance between the bounds, over all lanes that are not exact, in
    steps of the target's format; 0 if all are exact."""
    worst: Sample | None
    """The decided pixel that comes closest to its bounds, or leaves them by most."""
    overflow: Sample | None
    """The first pixel that overflows."""
    change: Sample | None
    """The pixel whose meaning was changed most; ``got`` is the material's meaning."""
    beyond: Sample | None = None
    """A pixel that is within the guaranteed bounds, but not within those measured of the driver."""

    @property
    def blames_compiler(self) -> bool:
        """True if the program that was emitted means something else than the material."""
        return self.changed > 0

    @property
    def agrees(self) -> bool:
        """True if the pictures agree, as far as this comparison can tell."""
        return not (self.wrong or self.changed or self.overflowing)


def compare(
    got: Sequence[Floats],
    expected: Expected,
    meant: Sequence[Floats],
    steps: Sequence[Floats],
    level: Level,
    possible: Expected | None = None,
) -> Comparison:
    """Compare the targets of pictures, each of shape (height, width, 4).

    ``expected`` has the bounds of the emitted program, and ``meant`` the meaning of the material.
    ``possible`` has the bounds of the material itself, if these are known: a value that a device
    may compute without any compiler is no change of the meaning. Uncovered pixels have the clear
    colour, and ``got`` must have exactly the same there. ``steps`` are the distances between
    neighbouring numbers of each target's format.
    """
    values, low, high = ends_of(expected)
    drawn, source = np.stack(got), np.stack(meant)
    overflows = ~((np.abs(values) <= LARGEST) & (np.abs(source) <= LARGEST))
    overflowing = largest_of_lanes(overflows) & ~expected.undecided
    decided = ~(expected.undecided | overflowing)
    wide = decided & expected.covered & says_nothing(values, low, high, decided & expected.covered)
    excess = shares(drawn, values, low, high)
    per_pixel = largest_of_lanes(excess)
    rounding = IN_DOUBLE * np.maximum(_larger_of(values, decided & expected.covered), CANCELLED)
    with np.errstate(invalid="ignore"):
        change = shares(source, values, low - rounding, high + rounding)
    changed = decided & (largest_of_lanes(change) > 1)
    if possible is not None:
        changed &= largest_of_lanes(shares(values, *ends_of(possible))) > 1
    distance = np.where(decided[None, :, :, None], _distance(drawn, values), 0)
    pictures = (values, low, high)
    return Comparison(
        level=level,
        pixels=decided.size,
        covered=int(expected.covered.sum()),
        proven=int((expected.covered & decided & ~wide).sum()),
        undecided=int(expected.undecided.sum()),
        wide=int(wide.sum()),
        overflowing=int(overflowing.sum()),
        wrong=int((decided & (per_pixel > 1)).sum()),
        changed=int(changed.sum()),
        max_difference=float(distance.max(initial=0)),
        excess=float(np.where(decided, per_pixel, 0).max(initial=0)),
        bite=_bite(low, high, np.stack(steps), decided & expected.covered),
        worst=_sample(decided, excess, drawn, pictures),
        overflow=_sample(overflowing, overflows.astype(np.float64), drawn, pictures),
        change=_sample(changed, change, source, pictures),
    )


def largest_of_lanes(pictures: NDArray[Number]) -> NDArray[Number]:
    """For each pixel the largest of all lanes of all targets, from (targets, height, width, 4).

    NumPy takes thirty times as long to reduce a last axis that is as short as this one.
    """
    red, green, blue, alpha = np.moveaxis(pictures, -1, 0)
    lanes = np.maximum(np.maximum(red, green), np.maximum(blue, alpha))
    largest: NDArray[Number] = lanes.max(axis=0)
    return largest


def ends_of(expected: Expected) -> tuple[Floats, Floats, Floats]:
    """The values and both bounds of all targets, (targets, height, width, 4) each."""
    return np.stack(expected.targets), np.stack(expected.low), np.stack(expected.high)


def proves_little(comparisons: Sequence[Comparison]) -> bool:
    """True if agreement of a material's pictures proves little: too few pixels can be compared."""
    seen = any(one.proven > SEEN_SHARE * one.pixels for one in comparisons)
    covered = sum(one.covered for one in comparisons)
    unproven = sum(max(one.covered - one.proven, one.undecided) for one in comparisons)
    return not seen or unproven > max(FEW, covered - PROVEN_SHARE * covered)


def _distance(got: Floats, values: Floats) -> Floats:
    """The difference of each lane; a value that is not finite is infinitely far from all others."""
    with np.errstate(invalid="ignore"):
        distance = np.abs(got - values)
    return np.where(np.isfinite(distance), distance, np.inf)


def shares(got: Floats, values: Floats, low: Floats, high: Floats) -> Floats:
    """The position of each lane on the way from its value (0) to the bound on that side (1).

    Where the bounds are infinite, nothing is known, and everything agrees, NaN included.
    """
    found = np.zeros(got.shape)
    apart = (got != values) & ~(np.isneginf(low) & np.isposinf(high))
    got, values, low, high = got[apart], values[apart], low[apart], high[apart]
    with np.errstate(all="ignore"):
        room = np.where(got > values, high - values, values - low)
        share = np.abs(got - values) / room
    share = np.where(np.isnan(share), np.inf, share)
    inside = (got >= low) & (got <= high)
    # Rounding of the quotient must not decide.
    found[apart] = np.where(inside, np.minimum(share, 1.0), np.maximum(share, 1.0 + 2.0**-20))
    return found


def _larger_of(values: Floats, seen: Bools) -> Floats:
    """The magnitude of each number, or the usual one of its lane, if that is larger."""
    if not seen.any():
        return np.abs(values)
    usual = [np.quantile(np.abs(value[seen]), USUAL[1], axis=0) for value in values]
    larger: Floats = np.maximum(np.abs(values), np.stack(usual)[:, None, None])
    return larger


def says_nothing(values: Floats, low: Floats, high: Floats, seen: Bools) -> Bools:
    """The pixels in which some lane's bounds are wider than a part of its target's range."""
    found = np.zeros(seen.shape, dtype=np.bool_)
    for value, least, most in zip(values, low, high, strict=True):
        if seen.any():
            ends = np.quantile(value[seen], USUAL, axis=0)
            span = np.maximum(ends[1] - ends[0], CONSTANT * np.abs(ends).max(axis=0))
            with np.errstate(invalid="ignore"):
                width = most - least
            found |= largest_of_lanes(~(width <= SAYS_NOTHING * (span.max() or 1.0))[None])
    return found


def _bite(low: Floats, high: Floats, steps: Floats, seen: Bools) -> float:
    """The median of the bounds in steps, over the lanes that are seen and not exact."""
    usual = [np.median(step[seen]) if seen.any() else 0.0 for step in steps]
    steps = np.maximum(steps, np.reshape(usual, (-1, 1, 1, 1)))
    with np.errstate(invalid="ignore"):
        bounds = ((high - low) / 2 / steps)[:, seen]
    bounds = bounds[bounds > 0]
    return float(np.median(bounds)) if bounds.size else 0.0


def _sample(
    where: Bools, amount: Floats, got: Floats, pictures: tuple[Floats, Floats, Floats]
) -> Sample | None:
    """The pixel with the largest amount among ``where``, in the target that has it."""
    if not where.any():
        return None
    per_pixel = np.where(where, largest_of_lanes(amount), -1.0)
    y, x = np.unravel_index(int(per_pixel.argmax()), per_pixel.shape)
    target = int(amount[:, y, x].max(axis=1).argmax())
    drawn, *ends = (tuple(picture[target, y, x].tolist()) for picture in (got, *pictures))
    return Sample(int(x), int(y), target, drawn, *ends)

"""Compares the picture of a route with the reference's; ``conform`` calls it for each draw."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...compiler.reference.picture import Expected
from .tolerances import TOGETHER, UNDECIDED_FEW, UNDECIDED_SHARE, Tolerance

Floats = NDArray[np.float64]


LARGEST = float(np.finfo(np.float32).max)


@dataclass(frozen=True, slots=True)
class Sample:
    """The values of one pixel in both pictures."""

    x: int
    y: int
    target: int
    got: tuple[float, ...]
    expected: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Comparison:
    """The result of comparing two pictures; the counts are numbers of pixels."""

    pixels: int
    """All pixels of the picture."""
    covered: int
    """Pixels that the reference covers."""
    proven: int
    """Covered pixels that are decided and do not overflow."""
    undecided: int
    """Pixels whose value depends on rounding; they are not compared."""
    overflowing: int
    """Other pixels whose reference value is too large for float32, so that no value is correct."""
    wrong: int
    """Decided pixels that are outside of the tolerance, or that only one of the pictures covers."""
    max_difference: float
    """The largest difference of any lane of a decided pixel; that of NaN is infinite."""
    excess: float
    """The largest difference of a decided lane, divided by its tolerance; up to 1 is agreement."""
    worst: Sample | None
    """The decided pixel with the largest difference, measured in tolerances."""
    overflow: Sample | None
    """The first pixel that overflows."""

    @property
    def too_undecided(self) -> bool:
        """Whether so many pixels are undecided that agreement of the others proves nothing."""
        many = self.undecided > UNDECIDED_SHARE * self.pixels
        return many or self.undecided > max(self.proven, UNDECIDED_FEW)

    @property
    def agrees(self) -> bool:
        """Whether the pictures agree, as far as this comparison can tell."""
        return not (self.wrong or self.overflowing or self.too_undecided)


def compare(
    got: tuple[Floats, ...],
    expected: Expected,
    tolerance: Tolerance,
    steps: Sequence[Floats | float],
) -> Comparison:
    """Compare the targets of two pictures, each of shape (height, width, 4).

    Uncovered pixels of ``expected`` have the clear colour, and ``got`` must have exactly the same
    there. ``steps`` are the errors that rounding to each target's format may add.
    """
    beyond = np.stack([~(np.abs(e) <= LARGEST) for e in expected.targets])
    overflows = beyond.any(axis=(0, 3)) & ~expected.undecided
    decided = ~expected.undecided & ~overflows
    allowed = np.stack(
        [
            tolerance.absolute + tolerance.relative * np.abs(e) + TOGETHER * r + step
            for e, r, step in zip(expected.targets, expected.radius, steps, strict=True)
        ]
    )
    distance = np.stack([_distance(g, e) for g, e in zip(got, expected.targets, strict=True)])
    excess = _in_tolerances(distance, allowed)
    per_pixel = excess.max(axis=(0, 3))
    wrong = decided & (per_pixel > 1)
    measured = np.where(decided[None, :, :, None], distance, 0)
    return Comparison(
        pixels=decided.size,
        covered=int(expected.covered.sum()),
        proven=int((expected.covered & decided).sum()),
        undecided=int(expected.undecided.sum()),
        overflowing=int(overflows.sum()),
        wrong=int(wrong.sum()),
        max_difference=float(measured.max(initial=0)),
        excess=float(np.where(decided, per_pixel, 0).max(initial=0)),
        worst=_sample(np.where(decided, per_pixel, -1), excess, got, expected.targets),
        overflow=_sample(np.where(overflows, 0.0, -1.0), beyond, got, expected.targets),
    )


def _distance(got: Floats, expected: Floats) -> Floats:
    """The difference of each lane; a value that is not finite is infinitely far from all others."""
    with np.errstate(invalid="ignore"):
        distance = np.abs(got - expected)
    return np.where(np.isfinite(distance), distance, np.inf)


def _in_tolerances(distance: Floats, allowed: Floats) -> Floats:
    """Differences divided by tolerances; where the reference's radius is not finite, infinite."""
    with np.errstate(invalid="ignore"):
        return np.where(np.isfinite(allowed), distance / allowed, np.inf)


def _sample(
    per_pixel: Floats,
    per_lane: Floats | NDArray[np.bool_],
    got: tuple[Floats, ...],
    expected: tuple[Floats, ...],
) -> Sample | None:
    """The pixel with the largest value, and in it the target; ``None`` if all are below zero."""
    if not per_pixel.size or per_pixel.max() < 0:
        return None
    y, x = np.unravel_index(int(per_pixel.argmax()), per_pixel.shape)
    target = int(per_lane[:, y, x].max(axis=1).argmax())
    return Sample(
        int(x), int(y), target, tuple(got[target][y, x].tolist()),
        tuple(expected[target][y, x].tolist()),
    )  # fmt: skip

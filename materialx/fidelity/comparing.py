"""Compares a picture of Burnish with that of MaterialX's own text, and says how alike they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from .settings import ALPHA_THRESHOLD, BACKGROUND

Floats = NDArray[np.float64]

BEYOND = 1e-3
"""The difference of a lane from which a pixel counts as different. Where MaterialX draws a number
above one, such as a highlight's, the difference is relative to it."""
ALIKE_SHARE = 1e-3
"""The largest share of the drawn pixels that may be different in pictures that are alike."""
_PERCENTILES = (50, 90, 99)

Verdict = Literal["alike", "different", "not run"]


@dataclass(frozen=True, slots=True)
class WorstPixel:
    """The pixel with the largest difference."""

    x: int
    y: int
    """The row, from the top."""
    ours: tuple[float, ...]
    theirs: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Likeness:
    """How much two pictures differ, over the pixels that either of them covers."""

    drawn: int
    """The pixels that either picture covers."""
    beyond: int
    """Pixels with a lane that differs by more than ``BEYOND``, or that is finite on one side
    only."""
    largest: float
    """The largest difference of a lane, as ``BEYOND`` counts it; infinite if one is finite on one
    side only."""
    percentiles: tuple[float, ...]
    """The differences of pixels below which 50, 90 and 99 percent of them lie."""
    not_finite: tuple[int, int]
    """The pixels of ours and of theirs that have a NaN or an infinity."""
    worst: WorstPixel | None
    """``None`` if the pictures are the same."""

    @property
    def share(self) -> float:
        """The share of the drawn pixels that are different."""
        return self.beyond / self.drawn if self.drawn else 0.0

    @property
    def verdict(self) -> Verdict:
        """The verdict. Pictures in which nothing is drawn prove nothing."""
        if not self.drawn:
            return "not run"
        return "alike" if self.share <= ALIKE_SHARE else "different"

    def sentence(self) -> str:
        """The record for people."""
        if not self.drawn:
            return "nothing is drawn on either side, so nothing is compared"
        parts = [f"{self.verdict}: {self.beyond} of {self.drawn} pixels differ by more than "
                 f"{BEYOND:g}, the largest difference is {self.largest:.3g}"]  # fmt: skip
        if any(self.not_finite):
            ours, theirs = self.not_finite
            parts.append(f"not finite: {ours} pixels of Burnish, {theirs} of MaterialX")
        if self.beyond and self.worst is not None:
            worst = self.worst
            parts.append(
                f"the worst is at x {worst.x}, y {worst.y}: {_shown(worst.ours)} by Burnish, "
                f"{_shown(worst.theirs)} by MaterialX"
            )
        return "; ".join(parts)


def compare(ours: Floats, theirs: Floats) -> Likeness:
    """Compare two pictures of shape (height, width, 4). Numbers that are not finite agree only with
    the same ones. MaterialX's text draws no pixel of which hardly anything is covered."""
    if ours.shape != theirs.shape:
        raise ValueError(f"pictures have different sizes: {ours.shape} and {theirs.shape}")
    hidden = ~drawn(theirs) & (ours[:, :, 3] < ALPHA_THRESHOLD)
    ours = np.where(hidden[:, :, None], BACKGROUND, ours)
    covered = drawn(ours) | drawn(theirs)
    differences = _differences(ours, theirs)
    of_drawn = differences[covered]
    row, column = np.unravel_index(int(differences.argmax()), differences.shape)
    worst = WorstPixel(
        int(column),
        int(row),
        tuple(ours[row, column].tolist()),
        tuple(theirs[row, column].tolist()),
    )
    return Likeness(
        drawn=int(covered.sum()),
        beyond=int((of_drawn > BEYOND).sum()),
        largest=float(of_drawn.max(initial=0.0)),
        percentiles=tuple(
            float(np.percentile(of_drawn, each, method="lower")) if of_drawn.size else 0.0
            for each in _PERCENTILES
        ),
        not_finite=(_not_finite(ours), _not_finite(theirs)),
        worst=worst if differences.any() else None,
    )


def drawn(picture: Floats) -> NDArray[np.bool_]:
    """The pixels in which something is drawn."""
    covered: NDArray[np.bool_] = (picture != BACKGROUND).any(axis=2)
    return covered


def _differences(ours: Floats, theirs: Floats) -> Floats:
    """The largest difference of the lanes of each pixel, as ``BEYOND`` counts it."""
    with np.errstate(invalid="ignore"):
        apart = np.abs(ours - theirs) / np.maximum(np.abs(theirs), 1.0)
    same = (ours == theirs) | (np.isnan(ours) & np.isnan(theirs))
    apart = np.where(same, 0.0, np.where(np.isfinite(apart), apart, np.inf))
    largest: Floats = apart.max(axis=2)
    return largest


def _not_finite(picture: Floats) -> int:
    return int((~np.isfinite(picture)).any(axis=2).sum())


def _shown(lanes: tuple[float, ...]) -> str:
    return "(" + ", ".join(f"{lane:.6g}" for lane in lanes) + ")"

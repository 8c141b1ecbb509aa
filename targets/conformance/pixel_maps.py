"""Turns the verdict on each pixel into the report's pictures: bounds, differences, decisions."""

from __future__ import annotations

import base64
import io
import math

import numpy as np
from numpy.typing import NDArray

from ..runner.pictures import to_image
from .compare import ends_of, largest_of_lanes, says_nothing, shares
from .rows import CaseResult

Floats = NDArray[np.float64]

DARKEST = 1e-8
"""The bound that is shown in black; 1 is white."""
_UNDECIDED, _WIDE, _WRONG = (0.02, 0.13, 0.6), (0.75, 0.3, 0.0), (0.8, 0.0, 0.02)
_DECIDED, _OUTSIDE = (0.05, 0.3, 0.1), (0.02, 0.02, 0.02)
"""Colours of pixels in linear light."""

EDGES = (0.0, 1e-4, 1e-3, 1e-2, 0.1, 0.25, 0.5, 1.0)
"""The limits of the histogram's bins, in bounds. Before the first stand differences of zero, and
behind the last those that are out of bounds."""


def picture(pixels: Floats) -> str:
    """A picture in linear light, (height, width, 4), as a ``data:`` URL."""
    file = io.BytesIO()
    to_image(pixels).save(file, "PNG")
    return f"data:image/png;base64,{base64.b64encode(file.getvalue()).decode('ascii')}"


def bound_map(result: CaseResult, target: int) -> Floats:
    """The widest bound of each pixel in grey, on a logarithmic scale."""
    expected = result.expected
    with np.errstate(all="ignore"):
        half = ((expected.high[target] - expected.low[target]) / 2).max(axis=2)
        grey = 1.0 - np.log10(np.where(np.isfinite(half), half, 1.0)) / math.log10(DARKEST)
    return _opaque(np.clip(grey, 0.0, 1.0)[:, :, None] ** 2.2)


def difference_map(result: CaseResult, target: int) -> tuple[Floats, float]:
    """The largest difference of any lane in grey, and the power of ten by which it is
    brightened."""
    with np.errstate(invalid="ignore"):
        distance = np.abs(result.got[target] - result.expected.targets[target]).max(axis=2)
    distance = np.where(np.isfinite(distance), distance, np.inf)
    undecided = result.expected.undecided
    largest = distance[np.isfinite(distance) & ~undecided].max(initial=0.0)
    times = 10.0 ** math.floor(-math.log10(largest)) if largest > 0 else 1.0
    shown = _opaque(np.minimum(distance * times, 1.0)[:, :, None])
    shown[undecided, :3] = _UNDECIDED
    return shown, times


def decision_map(result: CaseResult) -> Floats:
    """A picture of the verdict on each pixel: one colour for each answer."""
    expected = result.expected
    values, low, high = ends_of(expected)
    decided = expected.covered & ~expected.undecided
    excess = largest_of_lanes(shares(np.stack(result.got), values, low, high))
    shown = np.zeros((*decided.shape, 3))
    shown[:] = _OUTSIDE
    shown[decided] = _DECIDED
    shown[decided & says_nothing(values, low, high, decided)] = _WIDE
    shown[~expected.undecided & (excess > 1)] = _WRONG
    shown[expected.undecided] = _UNDECIDED
    return _opaque(shown)


def histogram(results: tuple[CaseResult, ...]) -> list[int]:
    """The number of lanes of covered pixels, by their distance from their value in bounds."""
    counts = np.zeros(len(EDGES) + 1, dtype=np.int64)
    for result in results:
        expected = result.expected
        seen = expected.covered & ~expected.undecided
        found = shares(np.stack(result.got), *ends_of(expected))[:, seen].ravel()
        counts += np.bincount(np.searchsorted(EDGES, found, side="left"), minlength=len(counts))
    return counts.tolist()


def _opaque(colours: Floats) -> Floats:
    """Grey or colours, (height, width, 1 or 3), with an alpha of 1."""
    shape = (*colours.shape[:2], 3)
    ones = np.ones((*colours.shape[:2], 1))
    return np.concatenate([np.broadcast_to(colours, shape), ones], axis=2)

"""What an undecided pixel may be: whatever some fragment there has drawn, or nothing has.

Where rounding tips which fragments are drawn, a picture alone is not compared. But a later step of
a frame may read the pixel, and then it matters that it is one of few colours: between the least and
the largest of them.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .coverage import Fragments
from .resolve import Canvas, Shades
from .scene import Bools, Floats, Ints


class Hulls:
    """For each pixel of a canvas the least and the largest of what it may be."""

    def __init__(self, canvas: Canvas) -> None:
        self._canvas = canvas
        self.targets = [target[1:].copy() for target in canvas.targets]
        """For each target (2, pixels, 4)."""
        self.depth = np.stack([canvas.depth - canvas.depth_off, canvas.depth + canvas.depth_off])
        """(2, pixels)."""

    def extend(
        self,
        fragments: Fragments,
        depths: Callable[[Fragments], tuple[Floats, Floats]],
        shaded: Callable[[Fragments], Shades],
    ) -> None:
        """Behind a draw: decided pixels are what they are; others may be what they were before, or
        any of these fragments."""
        canvas = self._canvas
        undecided = canvas.undecided | canvas.shaky
        here = undecided[fragments.pixel]
        several = Fragments(fragments.face[here], fragments.pixel[here])
        depth, off = depths(several)
        now = np.stack([canvas.depth - canvas.depth_off, canvas.depth + canvas.depth_off])
        self.depth = _joined(self.depth, now, undecided)
        _include(self.depth, several.pixel, np.stack([depth - off, depth + off]))
        shades = shaded(several)
        for number, target in enumerate(canvas.targets):
            self.targets[number] = _joined(self.targets[number], target[1:], undecided)
            if canvas.is_opaque:
                colours = canvas.stored(number, shades.colours[number])[1:]
                _include(self.targets[number], several.pixel, _known(colours))
            else:
                for lane in canvas.written_lanes(number):
                    self.targets[number][0, undecided, lane] = -np.inf
                    self.targets[number][1, undecided, lane] = np.inf


def _joined(before: Floats, now: Floats, undecided: Bools) -> Floats:
    """Of undecided pixels both, of all others what they are now."""
    low = np.where(_like(undecided, now[0]), np.minimum(before[0], now[0]), now[0])
    high = np.where(_like(undecided, now[1]), np.maximum(before[1], now[1]), now[1])
    return np.stack([low, high])


def _like(mask: Bools, values: Floats) -> Bools:
    return mask if values.ndim == 1 else mask[:, None]


def _include(hull: Floats, pixel: Ints, ends: Floats) -> None:
    np.minimum.at(hull[0], pixel, ends[0])
    np.maximum.at(hull[1], pixel, ends[1])


def _known(ends: Floats) -> Floats:
    """Ends without NaN, which says that nothing is known."""
    low = np.where(np.isnan(ends[0]), -np.inf, ends[0])
    return np.stack([low, np.where(np.isnan(ends[1]), np.inf, ends[1])])

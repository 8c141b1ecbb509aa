"""Defines the meaning of derivatives: differences between neighbouring pixels.

``functions.py`` has them in its table. Arrays hold quads of 2 × 2 pixels in their last two axes:
first the row, counted downwards, then the column. A plain number, or an axis of length 1, has the
same value in all pixels. The difference is taken within the pixel's own row or column.
"""

from __future__ import annotations

from .namespace import Lane, Lanes, Namespace


def ddx(_xp: Namespace, v: Lanes) -> Lanes:
    return tuple(_difference(lane, -1) for lane in v)


def ddy(_xp: Namespace, v: Lanes) -> Lanes:
    return tuple(_difference(lane, -2) for lane in v)


def _difference(lane: Lane, axis: int) -> Lane:
    shape = getattr(lane, "shape", ())
    if len(shape) < -axis or shape[axis] == 1:
        return 0.0
    return (lane.take([1], axis) - lane.take([0], axis)).repeat(2, axis)

"""Differences between neighbouring pixels.

Arrays hold quads of 2 × 2 pixels in their last two axes, rows downwards and then columns; a plain
number, and what is along an axis of length 1, is the same in all of them. The difference is that of
the pixel's own row or column.
"""

from __future__ import annotations

from .namespace import Lane, Lanes, Namespace


def ddx(_xp: Namespace, v: Lanes) -> Lanes:
    return tuple(_difference(lane, -1) for lane in v)


def ddy(_xp: Namespace, v: Lanes) -> Lanes:
    return tuple(_difference(lane, -2) for lane in v)


def _difference(lane: Lane, axis: int) -> Lane:
    if not hasattr(lane, "take") or lane.shape[axis] == 1:
        return 0.0
    return (lane.take([1], axis) - lane.take([0], axis)).repeat(2, axis)

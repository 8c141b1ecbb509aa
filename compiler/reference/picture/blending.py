"""Blends neighbouring texels, and levels, as a linear filter does, over an interval of places.

A linear filter's result is linear along each axis between two texels' centres. So its bounds within
a box between them are known from the box's corners alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from itertools import combinations

import numpy as np

from ..bounds import Bounded, exact
from .scene import Floats

BLENDING = 5 * 2.0**-24
"""The error of one blend of two numbers, relative to the larger one.

A difference, a product and a sum are rounded to float32, and their terms may be twice as large.
"""


def blended(
    corners: Sequence[Bounded], shares: Sequence[Bounded], error: float | None, product: float = 0.0
) -> Bounded:
    """The blend of the texels around a place, by its distances from the first of them.

    ``corners`` is in the order of ``Image.cell``. ``error`` is that of a blend of two, relative to
    the larger one; ``None`` says that the device does not round. ``product`` is the error of the
    weight of a corner, which is a product of those along the axes.
    """
    value = _mean([corner.value for corner in corners], [share.value for share in shares])
    if error is None and all(lane.is_exact for lane in (*corners, *shares)):
        return exact(value)
    ends = [(share.low, share.high) for share in shares]
    if all(corner.is_exact for corner in corners):
        found = _at_ends([corner.value for corner in corners], ends)
        low, high = reduce(np.minimum, found), reduce(np.maximum, found)
    else:
        low = reduce(np.minimum, _at_ends([corner.low for corner in corners], ends))
        high = reduce(np.maximum, _at_ends([corner.high for corner in corners], ends))
    off = 0.0 if error is None else len(shares) * error * _magnitude(corners)
    if product:
        off = off + product * _bend(corners, len(shares))
    return Bounded(value, low - off, high + off)


def _mean(corners: Sequence[Floats], shares: Sequence[Floats]) -> Floats:
    """The blend at one place."""
    for share in reversed(shares):
        pairs = zip(corners[::2], corners[1::2], strict=True)
        corners = [_between(a, b, share) for a, b in pairs]
    return corners[0]


def _at_ends(corners: Sequence[Floats], ends: Sequence[tuple[Floats, Floats]]) -> list[Floats]:
    """The blends at all corners of a box."""
    found = [list(corners)]
    for pair in reversed(ends):
        found = [
            [_between(a, b, end) for a, b in zip(values[::2], values[1::2], strict=True)]
            for values in found
            for end in pair
        ]
    return [values[0] for values in found]


def _between(a: Floats, b: Floats, share: Floats) -> Floats:
    """A blend of two that is exact at both ends."""
    return (1.0 - share) * a + share * b


def _bend(corners: Sequence[Bounded], axes: int) -> Floats:
    """By how much a blend changes with the product of two weights, at most, over all pairs.

    The weights along the axes add up to 1, however those of corners are rounded. So only what is
    left of the corners' differences along one axis, when one goes along another one, counts.
    """
    values = np.stack([np.broadcast_arrays(corner.value)[0] for corner in corners])
    cube = values.reshape(*(2,) * axes, *values.shape[1:])
    slack = reduce(np.maximum, [corner.high - corner.low for corner in corners])
    everywhere = tuple(range(axes))
    bend: Floats = sum(
        (
            np.abs(np.diff(np.diff(cube, axis=one), axis=other)).max(axis=everywhere) + 4 * slack
            for one, other in combinations(everywhere, 2)
        ),
        np.zeros_like(slack),
    )
    return bend


def _magnitude(lanes: Sequence[Bounded]) -> Floats:
    return reduce(np.maximum, [lane.magnitude for lane in lanes])

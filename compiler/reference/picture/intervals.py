"""Interval arithmetic without rounding, for the work of a sampler before it reads texels.

A sampler is fixed hardware, and no specification says how it rounds. So these functions of
``Bounded`` lanes do not round, unlike the operators of ``Bounded``; the sampler widens the results
by the possible error of a device. Lanes that are exact stay so, and then only their values are
computed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ..bounds import Bounded, as_bounded, between, exact
from ..bounds.products import products
from ..namespace import Lane
from .scene import Floats

FARTHEST = 1e9
"""Coordinates with larger magnitudes have no meaning."""


def finite(lane: Lane) -> Bounded:
    """A coordinate of a program, which may be anything where it may be NaN, infinite or very large.

    The helper lanes outside of a triangle may have such coordinates.
    """
    given = as_bounded(lane)
    value = np.asarray(given.value, dtype=np.float64)
    known = (np.abs(value) <= FARTHEST) & (given.low >= -FARTHEST) & (given.high <= FARTHEST)
    if np.all(known):
        return exact(value) if given.is_exact else between(value, given.low, given.high)
    value = np.clip(np.where(np.isfinite(value), value, 0.0), -FARTHEST, FARTHEST)
    low = np.where(known, np.minimum(given.low, value), -FARTHEST)
    return Bounded(value, low, np.where(known, np.maximum(given.high, value), FARTHEST))


def increasing(function: Callable[..., Floats], *lanes: Bounded) -> Bounded:
    """A function of lanes that never decreases when one of them increases."""
    value = function(*(lane.value for lane in lanes))
    if all(lane.is_exact for lane in lanes):
        return exact(value)
    low, high = (function(*ends) for ends in zip(*((x.low, x.high) for x in lanes), strict=True))
    return Bounded(value, low, high)


def difference(x: Bounded, y: Bounded) -> Bounded:
    """``x - y``."""
    if x.is_exact and y.is_exact:
        return exact(x.value - y.value)
    return Bounded(x.value - y.value, x.low - y.high, x.high - y.low)


def product(x: Bounded, y: Bounded) -> Bounded:
    """``x * y``."""
    if x.is_exact and y.is_exact:
        return exact(x.value * y.value)
    return Bounded(x.value * y.value, *products(x, y))


def quotient(x: Bounded, y: Bounded) -> Bounded:
    """``x / y`` for a positive ``y``."""
    if x.is_exact and y.is_exact:
        return exact(x.value / y.value)
    low = np.minimum(x.low / y.low, x.low / y.high)
    return Bounded(x.value / y.value, low, np.maximum(x.high / y.low, x.high / y.high))


def largest(lanes: Sequence[Bounded]) -> Bounded:
    """The largest of several lanes."""
    return increasing(lambda *arrays: np.max(np.broadcast_arrays(*arrays), axis=0), *lanes)


def widened(x: Bounded, by: float | Floats) -> Bounded:
    """A number that may be off by so much."""
    return Bounded(x.value, x.low - by, x.high + by)

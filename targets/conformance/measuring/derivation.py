"""Derives how precisely a device filters from what it drew for the probes.

Each property is the largest error that was found, with a margin: the pictures of a material may
have larger ones. Whatever is no better than what is guaranteed stays as that is, and levels that
are far from all that specifications allow are an error of the device, not its precision.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..drivers import Hardware
from . import cubes, footprints
from .probes import FIXED, FLOATS, THIRD, Floats, Pair

Pictures = Sequence[Floats]
"""The targets of a probe in one state, (height, width, 4)."""
Drawn = Mapping[str, Sequence[Pictures]]
"""The pictures in each state, by the name of the probe's material."""

MARGIN = 2.0
"""The factor of measured errors that is allowed. The errors of fixed hardware are those of
rounding, and thousands of samples come close to the largest one."""
MOST_BITS = 16
"""More binary places of weights and levels are not told apart from those of a float32."""
FLOAT_BITS = 20
"""A result with as many places is taken for that of a float32."""
FIRST, NEXT = FIXED[2]
ROUGHEST = 2.0**-6
"""The largest relative error of what is read of a texture of one colour."""
FARTHEST = 0.25
"""The largest error of levels of detail: specifications allow less, and a wrong level is off by
1."""
_ON_STEP = 0.05
"""The part of a binary place by which an error may be larger than the step that it stands for:
that of a weight contains some of the result's."""
_ON_GRID = 2.0**-6
"""The part of a step of weights that is rounding of the place."""


class MeasuringError(Exception):
    """A device could not be measured; the text tells people why."""


def derived(drawn: Drawn, assumed: Hardware, *, bottom_up: bool) -> Hardware:
    """The precision of a device that has drawn this; what is not measured is as assumed.

    Raises ``MeasuringError`` if it does not filter, or reads something else.
    """
    (weights,), (levels,), (slopes,) = (drawn[name] for name in ("Weights", "Levels", "Slopes"))
    shares, of_constant = _shares(weights[3]), _float_error(weights[1])
    if of_constant > ROUGHEST:
        raise MeasuringError("it reads something else than the texels of a texture of one colour")
    subtexel = _weight_bits(weights[1], shares, of_constant)
    of_floats = max(of_constant, _at_steps(weights[1], shares, subtexel, FLOATS))
    mip = _level_bits(levels[2][..., 0], levels[3][..., 0], of_floats)
    for bits, what in ((subtexel, "texels"), (mip, "levels")):
        if not bits:
            raise MeasuringError(f"it blends {what} by weights of 0 bits, so it does not filter")
    of_fixed = max(
        _fixed_error(weights[0]),
        _at_steps(weights[0], shares, subtexel, FIXED),
        _fixed_level_error(levels[0], levels[3][..., 0], mip),
    )
    of_single = _fixed_level_error(levels[1], levels[3][..., 0], mip)
    footprint, lod_error = footprints.found(drawn, bottom_up=bottom_up)
    if lod_error > FARTHEST:
        raise MeasuringError(f"it reads levels of detail that are wrong, by up to {lod_error:.2g}")
    return replace(
        assumed,
        subtexel_bits=max(subtexel, assumed.subtexel_bits),
        mip_bits=max(mip, assumed.mip_bits),
        lod_error=lod_error,
        footprint=footprint,
        product_bits=_better(
            places(_product_error(weights[2], shares, subtexel), FLOAT_BITS), assumed.product_bits
        ),
        fixed_bits=_better(places(of_fixed, FLOAT_BITS), assumed.fixed_bits),
        float_bits=_better(places(of_floats / 2, FLOAT_BITS), assumed.float_bits),
        mixing_bits=_better(places(of_single, FLOAT_BITS), assumed.mixing_bits),
        derivatives=footprints.derivatives(slopes[0], bottom_up=bottom_up),
        corner_bits=cubes.corner_bits(drawn["Corners"][0]),
    )


def _better(found: int | None, assumed: int | None) -> int | None:
    """The larger number of binary places; ``None`` stands for those of a float32."""
    if found is None or assumed is None:
        return found
    return max(found, assumed)


def places(error: float, most: int) -> int | None:
    """The binary places of a number with an error of so much; ``None`` from ``most`` on."""
    bits = _places(error, most)
    return None if bits == most else bits


def _places(error: float, most: int) -> int:
    if error <= 0.0:
        return most
    return max(0, min(most, int(np.floor(-np.log2(MARGIN * error) + _ON_STEP))))


def beyond(read: Floats, low: Floats | float, high: Floats | float) -> float:
    """By how much numbers are outside of what is allowed, at most."""
    return float(np.maximum(np.maximum(low - read, read - high), 0.0).max())


def _shares(places: Floats) -> Floats:
    """The weights of the second of two texels along both axes, (height, width, 2)."""
    shares: Floats = places[..., :2] * 2 - 0.5
    return shares


def _float_error(read: Floats) -> float:
    """The error of blends of floats that are the same, relative to them."""
    return float(np.abs(read[..., 3] - THIRD).max() / THIRD)


def _weight_bits(read: Floats, shares: Floats, error: float) -> int:
    """The places of weights, from texels that are 0 and 1 apart."""
    off = np.abs(read[..., :2] - shares).max() - error
    return _places(float(off), MOST_BITS)


def _product_error(read: Floats, shares: Floats, bits: int) -> float:
    """The error of weights that are products, where those along the axes are certain within a step.

    The texels change twice as much with the product as they are apart.
    """
    across, down = (
        np.stack(_neighbours(shares[..., axis], bits))
        if bits < MOST_BITS
        else shares[None, ..., axis]
        for axis in (0, 1)
    )
    tried = [x * y + (1 - x) * (1 - y) for x in across for y in down]
    off = np.min(np.abs(read[..., 0] - np.array(tried)), axis=0)
    return float(off.max() / 2)


def _at_steps(read: Floats, shares: Floats, bits: int, pairs: Sequence[Pair]) -> float:
    """The error of blends where the weights are certain, as they are steps of the device's.

    It is that of the first and the third lane, which change to the right; of floats, relative to
    the larger texel.
    """
    share = shares[..., 0]
    certain = np.abs(np.ldexp(share, bits) - np.rint(np.ldexp(share, bits))) < _ON_GRID
    off = [
        np.abs(read[..., lane] - first - share * (last - first))[certain].max(initial=0.0)
        / (last if pairs is FLOATS else 1.0)
        for lane, (first, last) in ((0, pairs[0]), (2, pairs[2]))
    ]
    return float(max(off))


def _fixed_error(read: Floats) -> float:
    """The error of blends of texels in fixed point that are the same, or nearly so."""
    constant = beyond(read[..., 3], FIRST, FIRST)
    return max(constant, beyond(read[..., 2], FIRST, NEXT))


def _level_bits(read: Floats, wanted: Floats, error: float) -> int:
    """The most places with which a level is one of the two neighbours of the wanted one."""
    last = read.max()
    wanted, slack = np.clip(wanted, 0.0, last), error * np.maximum(last, 1.0)
    for bits in range(MOST_BITS, 0, -1):
        low, high = _neighbours(wanted, bits)
        if beyond(read, low - slack, high + slack) == 0.0:
            return bits
    return 0


def _neighbours(level: Floats, bits: int) -> tuple[Floats, Floats]:
    """The numbers with so many places beside a level."""
    scaled = np.ldexp(level, bits)
    return np.ldexp(np.floor(scaled), -bits), np.ldexp(np.ceil(scaled), -bits)


def _fixed_level_error(read: Floats, wanted: Floats, bits: int) -> float:
    """The error of blends of levels in fixed point, beside that of the level."""
    constant = beyond(read[..., 3], FIRST, FIRST)
    near = beyond(read[..., 2], FIRST, NEXT)
    low, high = _neighbours(np.clip(wanted, 0.0, 8.0), bits)
    ends = np.sort([_parity(low), _parity(high)], axis=0)
    apart = np.floor(low) == np.floor(np.maximum(high - 2.0**-MOST_BITS, low))
    far = beyond(read[..., 0][apart], ends[0][apart], ends[1][apart])
    return max(constant, near, far)


def _parity(level: Floats) -> Floats:
    """The blend of levels that are black and white by turns."""
    return 1.0 - np.abs(level % 2.0 - 1.0)

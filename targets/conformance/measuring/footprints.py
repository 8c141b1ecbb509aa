"""Finds which length in texels a device's levels follow from, and how far off they are.

The kinds of footprints are tried from the narrowest one on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ....compiler.reference.picture.scene import Derivatives, Footprint
from .probes import CUBE, LADDER, Floats

MARGIN = 1.25
"""The factor of a level's error: it is smooth, so many samples come close to the largest one."""
ACCEPTED: Mapping[Footprint, float] = {"euclidean": 2.0**-4, "ellipse": 2.0**-2}
"""The largest error, in levels, with which a kind of footprint is taken for a device's own."""
_TINY = 2.0**-60
_SLOPE = 2.0**-20
"""The error of a difference between values of pixels, which are below 1."""


@dataclass(frozen=True, slots=True)
class _Seen:
    """Levels that were read, and the steps from which they follow."""

    level: Floats
    """(samples,)."""
    steps: Floats
    """(choices, samples, 2, axes): both steps in texels, for each choice of a row and a column; the
    first choice is that of the quad's first pixel."""
    last: int
    """The number of the last level."""


def found(
    drawn: Mapping[str, Sequence[Sequence[Floats]]], *, bottom_up: bool
) -> tuple[Footprint, float]:
    """The narrowest footprint that explains all levels, and the error that is allowed for."""
    flat = [*_given(drawn["Steps"]), *_moved(drawn["Changes"], bottom_up)]
    cubes = list(_turned(drawn["Directions"], bottom_up))
    euclidean = max(_euclidean_error(seen) for seen in flat)
    # On cubes a device's steps are not known, whichever they are on others.
    if euclidean <= ACCEPTED["euclidean"]:
        return "euclidean", MARGIN * max(euclidean, *(_step_error(seen) for seen in cubes))
    ellipse = max(_ellipse_error(seen) for seen in (*flat, *cubes))
    if ellipse <= ACCEPTED["ellipse"]:
        return "ellipse", MARGIN * ellipse
    return "any", MARGIN * max(_any_error(seen) for seen in (*flat, *cubes))


def derivatives(slopes: Floats, *, bottom_up: bool) -> Derivatives:
    """The pixels between which a device takes differences."""
    height, *drawn = (slopes[..., lane] for lane in range(3))
    own = _differences(height)
    # Pictures are upright, whichever way the device counts rows.
    row = 1 if bottom_up else 0
    first = np.repeat(own[0][row::2], 2, axis=0), np.repeat(own[1][:, ::2], 2, axis=1)
    kinds: dict[Derivatives, tuple[Floats, Floats]] = {"own": own, "first": first}
    for kind, meant in kinds.items():
        if all(np.abs(x - y).max() <= _SLOPE for x, y in zip(drawn, meant, strict=True)):
            return kind
    return "any"


def _differences(values: Floats) -> tuple[Floats, Floats]:
    """The differences to the right and downwards in each pixel's own row and column of its quad."""
    across = np.repeat(values[:, 1::2] - values[:, ::2], 2, axis=1)
    return across, np.repeat(values[1::2] - values[::2], 2, axis=0)


# --- what was read --------------------------------------------------------------------------------


def _given(pictures: Sequence[Sequence[Floats]]) -> Iterator[_Seen]:
    """Levels for steps that the shader gives."""
    for level, where in pictures:
        steps = where.reshape(1, -1, 2, 2) * LADDER
        yield _Seen(level[..., 0].ravel(), steps, LADDER.bit_length() - 1)


def _moved(pictures: Sequence[Sequence[Floats]], bottom_up: bool) -> Iterator[_Seen]:
    """Levels for steps between the pixels of quads."""
    for level, where in pictures:
        steps = _choices(where[..., :2], bottom_up) * LADDER
        yield _Seen(_quads(level[..., 0]), steps, LADDER.bit_length() - 1)


def _turned(pictures: Sequence[Sequence[Floats]], bottom_up: bool) -> Iterator[_Seen]:
    """Levels of a cube, where all of a quad's directions meet one face, +x."""
    for level, where in pictures:
        x, y, z = (where[..., lane] for lane in range(3))
        face = np.stack([-z / x, -y / x], axis=-1) / 2
        inside = np.abs(_corners(face)).max(axis=(0, 1, -1)) < 0.5
        steps = _choices(face, bottom_up)[:, np.tile(inside, 4)] * CUBE
        yield _Seen(_quads(level[..., 0])[np.tile(inside, 4)], steps, CUBE.bit_length() - 1)


def _corners(values: Floats) -> Floats:
    """The pixels of quads: (2, 2, quads, …)."""
    quads = np.array([[values[i::2, j::2] for j in (0, 1)] for i in (0, 1)])
    return quads.reshape(2, 2, -1, *values.shape[2:])


def _quads(values: Floats) -> Floats:
    """The values of all pixels, one pixel of all quads after the other."""
    return _corners(values).reshape(-1)


def _choices(places: Floats, bottom_up: bool) -> Floats:
    """The steps of each quad by each choice of a row and a column, for each of its pixels."""
    corners = _corners(places)
    across, down = corners[:, 1] - corners[:, 0], corners[1] - corners[0]
    rows = (1, 0) if bottom_up else (0, 1)
    pairs = [np.stack([across[row], down[column]], axis=1) for row in rows for column in (0, 1)]
    return np.tile(np.array(pairs), (1, 4, 1, 1))


# --- what explains it -----------------------------------------------------------------------------


def _euclidean_error(seen: _Seen) -> float:
    level = _level(np.linalg.norm(seen.steps[0], axis=-1).max(axis=-1), seen.last)
    return float(np.abs(seen.level - level).max())


def _ellipse_error(seen: _Seen) -> float:
    longer = np.linalg.norm(seen.steps, axis=-1).max(axis=-1).min(axis=0)
    axis = np.linalg.norm(seen.steps, ord=2, axis=(-2, -1)).max(axis=0)
    return _outside(seen, longer, axis)


def _step_error(seen: _Seen) -> float:
    """The error of levels that follow from one of both steps, however its length is taken."""
    lanes = np.abs(seen.steps)
    least, most = lanes.max(axis=(-2, -1)), lanes.sum(axis=-1).max(axis=-1)
    return _outside(seen, least.min(axis=0), most.max(axis=0))


def _any_error(seen: _Seen) -> float:
    """The error of levels beyond all that APIs allow (``levels.py``)."""
    lanes = np.abs(seen.steps)
    sums, of_lanes = lanes.sum(axis=-1).max(axis=-1), lanes.max(axis=-2).sum(axis=-1)
    most = np.maximum(np.sqrt(2.0) * sums, of_lanes)
    return _outside(seen, lanes.max(axis=(-2, -1)).min(axis=0), most.max(axis=0))


def _outside(seen: _Seen, low: Floats, high: Floats) -> float:
    """How many levels the farthest one is outside of those of two lengths."""
    least, most = _level(low, seen.last), _level(high, seen.last)
    return float(np.maximum(np.maximum(least - seen.level, seen.level - most), 0.0).max())


def _level(footprint: Floats, last: int) -> Floats:
    level: Floats = np.clip(np.log2(np.maximum(footprint, _TINY)), 0.0, last)
    return level

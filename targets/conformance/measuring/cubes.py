"""Finds what a device reads beyond the corners of a cube, where three faces meet."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .probes import Floats, cube_texels

MOST_BITS = 20
LEAST_BITS = 4
"""With fewer places the texel beyond a corner is not taken for the mean of the three around it."""
MARGIN = 2.0

_AXES = ((2, 1), (2, 1), (0, 2), (0, 2), (0, 1), (0, 1))
"""For each face the axes along its columns and its rows."""
_SIGNS = ((-1, -1), (1, -1), (1, 1), (1, -1), (1, -1), (-1, -1))
"""The directions of the columns and the rows along these axes, as Vulkan's table of faces says."""


def corner_bits(pictures: Sequence[Floats]) -> int | None:
    """The places of the mean of three texels that is read; ``None`` if something else is."""
    colour, where = pictures
    texels = cube_texels() / 255
    off = 0.0
    for corner in np.unique(where[..., :3].reshape(-1, 3), axis=0):
        there = (where[..., :3] == corner).all(axis=-1)
        mean = np.mean([_texel(texels, face, corner) for face in _faces(corner)], axis=0)
        # The texel beyond the corner has a quarter of the weight there.
        off = max(off, 4 * float(np.abs(colour[there] - mean).max()))
    bits = MOST_BITS if off == 0 else int(np.floor(-np.log2(MARGIN * off)))
    return min(bits, MOST_BITS) if bits >= LEAST_BITS else None


def _faces(corner: Floats) -> list[int]:
    """The three faces that meet at a corner."""
    return [2 * axis + int(corner[axis] < 0) for axis in range(3)]


def _texel(texels: Floats, face: int, corner: Floats) -> Floats:
    """The texel of a face at a corner."""
    last = texels.shape[1] - 1
    x, y = (
        last if corner[axis] * sign > 0 else 0
        for axis, sign in zip(_AXES[face], _SIGNS[face], strict=True)
    )
    found: Floats = texels[face, y, x]
    return found

"""Cube maps: which face a direction meets, where it meets it, and what is beyond a face's edges.

The sampler and its texels ask for it. The rules are those of Vulkan, "Cube Map Face Selection and
Transformations" and "Cube Map Edge Handling". Direct3D, OpenGL and WebGPU have the same faces, +x,
-x, +y, -y, +z, -z, with the same orientation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .scene import Bools, Floats, Ints

_ACROSS = np.array([[0, 0, -1], [0, 0, 1], [1, 0, 0], [1, 0, 0], [1, 0, 0], [-1, 0, 0]])
_DOWN = np.array([[0, -1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1], [0, -1, 0], [0, -1, 0]])
_OUT = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
"""For each face, the directions of its columns and of its rows, and the one in which it lies."""

_AXES = [(np.abs(axes).argmax(axis=1), axes.sum(axis=1)) for axes in (_ACROSS, _DOWN, _OUT)]
"""The same directions as numbers of lanes, with signs."""


@dataclass(frozen=True, slots=True)
class Met:
    """The places at which directions meet the cube."""

    face: Ints
    across: Floats
    down: Floats
    """Within the face, from 0 to 1."""
    out: Floats
    """The lane of the direction with the largest magnitude, without its sign."""

    def change(self, lanes: Sequence[Floats]) -> list[Floats]:
        """The rate of change of both coordinates, from that of the direction."""
        along = _turned(self.face, lanes)
        places = 2 * self.across - 1, 2 * self.down - 1
        return [
            0.5 * (step - place * along[2]) / self.out
            for step, place in zip(along[:2], places, strict=True)
        ]


def met(direction: Sequence[Floats]) -> Met:
    """Where directions (three lanes) meet the cube; on an edge, z is preferred to y, and y to x.

    A direction of length zero meets the centre of a face.
    """
    x, y, z = direction
    ax, ay, az = abs(x), abs(y), abs(z)
    face = np.where(
        (az >= ax) & (az >= ay), np.where(z < 0, 5, 4),
        np.where(ay >= ax, np.where(y < 0, 3, 2), np.where(x < 0, 1, 0)),
    )  # fmt: skip
    across, down, out = _turned(face, direction)
    out = np.maximum(out, np.finfo(np.float64).tiny)
    return Met(face, (across / out + 1) / 2, (down / out + 1) / 2, out)


def between_faces(direction: Sequence[Floats], off: float) -> Bools:
    """Whether a direction's largest lane is larger than another by less than ``off``."""
    _, second, largest = np.sort(np.abs(np.stack(np.broadcast_arrays(*direction))), axis=0)
    return np.asarray(largest - second <= off * largest)


def across_edges(place: Sequence[Ints], face: Ints, size: Ints) -> tuple[list[Ints], Ints]:
    """The texel and the face of a texel that is at most one beyond an edge of a face.

    Beyond a corner there is none; the coordinate stays unchanged, and is clamped to the face later.
    Few texels are beyond an edge, and only those are turned.
    """
    column, row, face, size = np.broadcast_arrays(*place, face, size)
    over = ((column < 0) | (column >= size)) ^ ((row < 0) | (row >= size))
    if not over.any():
        return [column, row], face
    sizes, faces = size[over], face[over]
    across, down = ((2 * i[over] + 1 - sizes) / sizes for i in (column, row))
    weights = (across[..., None] * _ACROSS[faces], down[..., None] * _DOWN[faces], _OUT[faces])
    new = met(np.moveaxis(sum(weights[1:], weights[0]), -1, 0))
    column, row, face = column.copy(), row.copy(), face.copy()
    column[over] = np.floor(new.across * sizes)
    row[over] = np.floor(new.down * sizes)
    face[over] = new.face
    return [column, row], face


def beyond_corner(place: Sequence[Ints], size: Ints) -> Bools:
    """Whether a texel is beyond two edges."""
    column, row = place
    return np.asarray(((column < 0) | (column >= size)) & ((row < 0) | (row >= size)))


def _turned(face: Ints, lanes: Sequence[Floats]) -> tuple[Floats, Floats, Floats]:
    """The lanes of a direction in a face's own axes: to its right, downwards, and out of it."""
    across, down, out = (np.choose(lane[face], lanes) * sign[face] for lane, sign in _AXES)
    return across, down, out

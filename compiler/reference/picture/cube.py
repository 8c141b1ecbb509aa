"""Cube maps: the face and the place that a direction meets, and the texels beyond its edges.

The sampler and its texels ask for it. The rules are those of Vulkan, "Cube Map Face Selection and
Transformations" and "Cube Map Edge Handling". Direct3D, OpenGL and WebGPU have the same faces, +x,
-x, +y, -y, +z, -z, with the same orientation.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ....stdlib.builtins.facts import SMALLEST_NORMAL
from ..bounds import Bounded, exact
from .choices import ALL, Part, lane_at
from .intervals import difference, increasing, largest, product, quotient, widened
from .scene import Bools, Floats, Ints

_ACROSS = np.array([[0, 0, -1], [0, 0, 1], [1, 0, 0], [1, 0, 0], [1, 0, 0], [-1, 0, 0]])
_DOWN = np.array([[0, -1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1], [0, -1, 0], [0, -1, 0]])
_OUT = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
"""The directions of the columns and the rows of each face, and the one in which it lies."""

FACES = len(_OUT)

_AXES = [(np.abs(axes).argmax(axis=1), axes.sum(axis=1)) for axes in (_ACROSS, _DOWN, _OUT)]
"""The directions as numbers of lanes, with signs."""
_SIDES = [(int(axis), int(sign)) for axis, sign in zip(*_AXES[2], strict=True)]
"""The lane that is the largest on each face, and its sign."""

_ASSUMED = 2.0**-18
"""The possible error of a device that compares and divides a direction's lanes.

It divides by the largest one, and the error is relative to that one. No API promises anything;
measured.
"""


@dataclass(frozen=True, slots=True)
class Met:
    """The places at which directions meet the cube; arrays are (pixels,)."""

    face: Ints
    across: Bounded
    down: Bounded
    """The places within the face, from 0 to 1."""
    out: Bounded
    """The lane of the direction with the largest magnitude, without its sign."""

    def change(self, lanes: Sequence[Bounded]) -> list[Bounded]:
        """The rate of change of both coordinates, from that of the direction."""
        *along, outwards = _turned_lanes(self.face, lanes)
        centred = (increasing(lambda x: 2 * x - 1, lane) for lane in (self.across, self.down))
        changes = [
            quotient(difference(step, product(place, outwards)), self.out)
            for step, place in zip(along, centred, strict=True)
        ]
        return [increasing(lambda x: 0.5 * x, change) for change in changes]


def met(direction: Sequence[Bounded], exactly: bool = False) -> Iterator[tuple[Part, Met]]:
    """The faces that directions (three lanes, (pixels,)) meet, and which of the pixels may do so.

    The first one is the face of the exact direction, for all pixels. On an edge, z is preferred to
    y, and y to x; a direction of length zero meets the centre of a face. ``exactly`` says that the
    device does not round.
    """
    face = face_of([lane.value for lane in direction])
    out = largest([abs(lane) for lane in direction])
    off = 0.0 if exactly else _ASSUMED
    yield ALL, _met(face, direction, out, off)
    if exactly and all(lane.is_exact for lane in direction):
        return
    for number, (axis, sign) in enumerate(_SIDES):
        lane = direction[axis]
        farthest = lane.high if sign > 0 else -lane.low
        possible = (farthest > 0) & (farthest * (1 + off) >= out.low) & (face != number)
        pixels = np.flatnonzero(possible)
        if len(pixels):
            chosen = [lane_at(pixels, each) for each in direction]
            yield pixels, _met(np.full(len(pixels), number), chosen, lane_at(pixels, out), off)


def may_be_nowhere(direction: Sequence[Bounded]) -> Bools:
    """True for directions that may be zero, so that no API says where they meet the cube."""
    return np.asarray(largest([abs(lane) for lane in direction]).low < SMALLEST_NORMAL)


def face_of(direction: Sequence[Floats]) -> Ints:
    """The face that directions meet."""
    x, y, z = direction
    ax, ay, az = abs(x), abs(y), abs(z)
    return np.where(
        (az >= ax) & (az >= ay), np.where(z < 0, 5, 4),
        np.where(ay >= ax, np.where(y < 0, 3, 2), np.where(x < 0, 1, 0)),
    )  # fmt: skip


def _met(face: Ints, direction: Sequence[Bounded], out: Bounded, off: float) -> Met:
    """The places where directions meet these faces.

    Only where the face's own lane is the largest, a device chooses the face. So that lane is not
    smaller than ``out``, and the places are within the face. A direction that may be zero may meet
    it anywhere.
    """
    out = increasing(lambda lane: np.maximum(lane, SMALLEST_NORMAL), out)

    def place(lane: Bounded) -> Bounded:
        share = increasing(lambda x: np.clip((x + 1) / 2, 0.0, 1.0), quotient(lane, out))
        if not off:
            return share
        return increasing(lambda x: np.clip(x, 0.0, 1.0), widened(share, off))

    across, down, _ = _turned_lanes(face, direction)
    return Met(face, place(across), place(down), out)


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
    direction = np.moveaxis(sum(weights[1:], weights[0]), -1, 0)
    new = face_of(list(direction))
    *along, out = _turned(new, list(direction))
    column, row, face = column.copy(), row.copy(), face.copy()
    for found, lane in zip((column, row), along, strict=True):
        found[over] = np.floor((lane / out + 1) / 2 * sizes)
    face[over] = new
    return [column, row], face


def beyond_corner(place: Sequence[Ints], size: Ints) -> Bools:
    """True if a texel is beyond two edges."""
    column, row = place
    return np.asarray(((column < 0) | (column >= size)) & ((row < 0) | (row >= size)))


def _turned(face: Ints, lanes: Sequence[Floats]) -> tuple[Floats, Floats, Floats]:
    """The lanes of a direction in a face's own axes: to its right, downwards, and out of it."""
    across, down, out = (np.choose(lane[face], lanes) * sign[face] for lane, sign in _AXES)
    return across, down, out


def _turned_lanes(face: Ints, lanes: Sequence[Bounded]) -> list[Bounded]:
    """The lanes of a direction with bounds in a face's own axes."""
    turned = _turned(face, [lane.value for lane in lanes])
    if all(lane.is_exact for lane in lanes):
        return [exact(value) for value in turned]
    lows, highs = (
        _turned(face, ends) for ends in zip(*((x.low, x.high) for x in lanes), strict=True)
    )
    return [
        Bounded(value, np.minimum(low, high), np.maximum(low, high))
        for value, low, high in zip(turned, lows, highs, strict=True)
    ]

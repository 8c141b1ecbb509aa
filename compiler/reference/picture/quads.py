"""Groups fragments into quads, and interpolates the vertices' values for them.

``drawing.py`` calls it between coverage and the fragment stage.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..namespace import Lane, Lanes
from .coverage import Fragments
from .faces import Faces
from .scene import Floats, Ints
from .variants import Variants


@dataclass(frozen=True, slots=True)
class Quads:
    """Squares of ``side`` × ``side`` pixels of a face: 2 if there are derivatives, otherwise 1."""

    face: Ints
    x: Ints
    y: Ints
    """(quads,): the pixel at the top left."""
    side: int

    def __len__(self) -> int:
        return len(self.face)

    def part(self, begin: int, end: int) -> Quads:
        """The quads from ``begin`` to ``end``."""
        return Quads(self.face[begin:end], self.x[begin:end], self.y[begin:end], self.side)


def quads_of(fragments: Fragments, width: int, side: int) -> tuple[Quads, Ints]:
    """The quads that contain the fragments, and for each fragment the number of its lane in
    them."""
    x, y = fragments.pixel % width, fragments.pixel // width
    across = -(-width // side)
    column, row = x // side, y // side
    span = (int(row.max(initial=0)) + 1) * across
    keys, quad = np.unique(fragments.face * span + row * across + column, return_inverse=True)
    place = keys % span
    quads = Quads(keys // span, place % across * side, place // across * side, side)
    return quads, (quad * side + y % side) * side + x % side


class Barycentric:
    """The positions of quads' lanes in their faces; arrays are (quads, side, side)."""

    def __init__(self, faces: Faces, quads: Quads) -> None:
        self._faces = faces
        self._face = quads.face
        steps = np.arange(quads.side) + 0.5
        self.x = (quads.x[:, None] + steps)[:, None, :]
        self.y = (quads.y[:, None] + steps)[:, :, None]
        self._linear = _linear(faces, quads.face, self.x, self.y)
        self.depth = np.clip(self._mixed(faces.z[quads.face].T, self._linear), 0.0, 1.0)
        self.per_w = self._mixed(faces.per_w[quads.face].T, self._linear)
        near = faces.per_w[quads.face][:, :, None, None]
        self._perspective = tuple(
            share * near[:, i + 1] / self.per_w for i, share in enumerate(self._linear)
        )
        self._whole = bool(faces.whole[quads.face].all())
        self._weights = faces.weights[quads.face]

    def perspective(self, values: Lanes, off: Lanes | None, ways: Variants, number: int) -> Lanes:
        """Interpolate values at the vertices (lanes; arrays or single numbers) with perspective.

        The result has a leading axis of variants if these change interpolated values, or, by
        ``off``, the vertices' values. ``number`` may be any number that is different for each
        crossing.
        """
        return tuple(
            self._crossed(lane, off[i] if off else 0.0, ways, number + i) if np.ndim(lane) else lane
            for i, lane in enumerate(values)
        )

    def flat(self, values: Lanes) -> Lanes:
        """The values of each triangle's first vertex."""
        first = self._faces.corners[self._face, 0]
        return tuple(lane[first][:, None, None] if np.ndim(lane) else lane for lane in values)

    def _crossed(self, lane: Lane, off: Lane, ways: Variants, number: int) -> Floats:
        corners = lane[self._faces.corners[self._face]].astype(np.float64)
        # Those of the whole triangle, because the clipped part decides how its planes are rounded.
        largest = np.abs(corners).max(axis=1)[:, None, None]
        mixed = self._interpolated(corners)
        if len(ways) > 1 and np.ndim(off):
            moved = self._interpolated(off[self._faces.corners[self._face]])
            mixed = mixed + moved * (ways.rounding > 0)[:, None, None, None]
        if ways.nudge.any():
            mixed = mixed + self._nudges(ways, number) * largest
        return mixed

    def _interpolated(self, corners: Floats) -> Floats:
        """The values at each lane, from those at the corners of whole triangles (quads, 3)."""
        if not self._whole:
            corners = (self._weights @ corners[:, :, None])[:, :, 0]
        return self._mixed(corners.T, self._perspective)

    def _nudges(self, ways: Variants, number: int) -> Floats:
        """The error of each variant, (variants, 1, side, side)."""
        side = len(self.x[0, 0]) if len(self.x) else 1
        checker = (-1.0) ** (np.add.outer(np.arange(side), np.arange(side)) + number)
        signs = np.where(ways.checkered[:, None, None, None] == 1, checker, 1.0)
        nudges: Floats = ways.nudge[:, None, None, None] * signs
        return nudges

    @staticmethod
    def _mixed(corners: Floats, shares: tuple[Floats, ...]) -> Floats:
        a, b, c = corners[:, :, None, None]
        mixed: Floats = a + shares[0] * (b - a) + shares[1] * (c - a)
        return mixed


def depth_of(faces: Faces, fragments: Fragments, width: int) -> Floats:
    """The depths of fragments."""
    x = (fragments.pixel % width + np.float64(0.5))[:, None, None]
    y = (fragments.pixel // width + np.float64(0.5))[:, None, None]
    second, third = _linear(faces, fragments.face, x, y)
    a, b, c = faces.z[fragments.face].T
    depth: Floats = a + second[:, 0, 0] * (b - a) + third[:, 0, 0] * (c - a)
    return np.clip(depth, 0.0, 1.0)


def _linear(faces: Faces, face: Ints, x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """The weights of the second and third corner, linear on the screen."""
    ax, bx, cx = faces.plane_x[face].T
    ay, by, cy = faces.plane_y[face].T
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    dx, dy = x - ax[:, None, None], y - ay[:, None, None]
    second = ((cy - ay) / area)[:, None, None] * dx - ((cx - ax) / area)[:, None, None] * dy
    third = ((bx - ax) / area)[:, None, None] * dy - ((by - ay) / area)[:, None, None] * dx
    return second, third

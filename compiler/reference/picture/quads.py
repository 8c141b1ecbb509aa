"""Groups fragments into quads, and interpolates the vertices' values for them.

``drawing.py`` calls it between coverage and the fragment stage.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..bounds import Bounded
from ..namespace import Lanes
from .coverage import Fragments
from .faces import Faces
from .scene import Floats, Ints, RasterRules


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

    def __init__(self, faces: Faces, quads: Quads, rules: RasterRules) -> None:
        self._faces = faces
        self._face = quads.face
        self._nudge = 0.0 if rules.varying_bits is None else 2.0**-rules.varying_bits
        steps = np.arange(quads.side) + 0.5
        self.x = (quads.x[:, None] + steps)[:, None, :]
        self.y = (quads.y[:, None] + steps)[:, :, None]
        self._linear = _linear(faces, quads.face, self.x, self.y)
        depth = self._clamped(self._mixed(faces.z[quads.face].T, self._linear))
        off = self._nudge * np.abs(faces.z[quads.face]).max(axis=1)[:, None, None]
        self.depth = Bounded(depth, self._clamped(depth - off), self._clamped(depth + off))
        near = faces.per_w[quads.face][:, :, None, None]
        per_w = self._mixed(faces.per_w[quads.face].T, self._linear)
        far = self._nudge * np.abs(near).max(axis=1)
        self.per_w = Bounded(per_w, per_w - far, per_w + far)
        self._perspective = tuple(
            share * near[:, i + 1] / per_w for i, share in enumerate(self._linear)
        )
        self._slopes = self._slopes_of(near, per_w)
        """By how much these two weights change if the triangle is a pixel elsewhere."""
        self._moved = faces.moved[quads.face][:, None, None]
        self._whole = bool(faces.whole[quads.face].all())
        self._weights = faces.weights[quads.face]

    def perspective(self, values: Lanes) -> Lanes:
        """Interpolate values at the vertices (lanes; arrays or single numbers) with perspective.

        Lanes of arrays become ``Bounded``, whether those at the vertices are or not.
        """
        return tuple(self._crossed(lane) if np.ndim(lane) else lane for lane in values)

    def flat(self, values: Lanes) -> Lanes:
        """The values of each triangle's first vertex."""
        first = self._faces.corners[self._face, 0]

        def at_first(array: Any) -> Any:
            return array[first][:, None, None]

        return tuple(
            lane
            if not np.ndim(lane)
            else lane.mapped(at_first)
            if isinstance(lane, Bounded)
            else at_first(lane)
            for lane in values
        )

    def _crossed(self, lane: Any) -> Bounded:
        """One lane, with the errors of a device.

        It has those of the three corners, each in proportion to its weight; that of the mean, in
        proportion to the largest corner; and that of the triangle's place, which a device knows
        only as precisely as its vertices' positions.
        """
        vertices = self._faces.corners[self._face]
        exact = lane.value if isinstance(lane, Bounded) else lane
        corners = exact[vertices].astype(np.float64)
        value = self._interpolated(corners)
        # Those of the whole triangle, because the clipped part decides how its planes are rounded.
        off = self._nudge * np.abs(corners).max(axis=1)[:, None, None]
        a, b, c = self._cut(corners).T[:, :, None, None]
        off = off + self._moved * (
            self._slopes[0] * np.abs(b - a) + self._slopes[1] * np.abs(c - a)
        )
        if isinstance(lane, Bounded) and not lane.is_exact:
            radius = np.maximum(lane.high - lane.value, lane.value - lane.low)
            a, b, c = self._cut(radius[vertices]).T[:, :, None, None]
            second, third = self._perspective
            off = off + np.abs(1.0 - second - third) * a + np.abs(second) * b + np.abs(third) * c
        return Bounded(value, value - off, value + off)

    def _interpolated(self, corners: Floats) -> Floats:
        """The values at each lane, from those at the corners of whole triangles (quads, 3)."""
        return self._mixed(self._cut(corners).T, self._perspective)

    def _cut(self, corners: Floats) -> Floats:
        """The values at the corners of the clipped parts, from those of whole triangles."""
        return corners if self._whole else (self._weights @ corners[:, :, None])[:, :, 0]

    def _slopes_of(self, near: Floats, per_w: Floats) -> tuple[Floats, Floats]:
        """The sum of the magnitudes of each weight's changes to the right and downwards."""
        ones = np.zeros((1, 1, 1))
        origin = _linear(self._faces, self._face, ones, ones)
        slopes: list[Floats] = []
        steps = [
            [at - start for at, start in zip(_linear(self._faces, self._face, x, y), origin,
                                             strict=True)]
            for x, y in ((ones + 1, ones), (ones, ones + 1))
        ]  # fmt: skip
        for i, share in enumerate(self._perspective):
            change = np.zeros_like(share)
            for step in steps:
                slope = step[0] * (near[:, 1] - near[:, 0]) + step[1] * (near[:, 2] - near[:, 0])
                change = change + np.abs((step[i] * near[:, i + 1] - share * slope) / per_w)
            slopes.append(change)
        return slopes[0], slopes[1]

    @staticmethod
    def _mixed(corners: Floats, shares: tuple[Floats, ...]) -> Floats:
        a, b, c = corners[:, :, None, None]
        mixed: Floats = a + shares[0] * (b - a) + shares[1] * (c - a)
        return mixed

    @staticmethod
    def _clamped(depth: Floats) -> Floats:
        return np.clip(depth, 0.0, 1.0)


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

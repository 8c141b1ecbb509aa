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

_FLUSHED = 2.0**-120
"""The error of a mean where a device may take small numbers of the computation for zero. Means of
nothing but zeros are exact."""
_OVERFLOWS = 2.0**124
"""A plane through larger numbers may become infinite on its way."""


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


def rows_above(rules: RasterRules, side: int) -> int:
    """How many rows of the first quads are above the picture, as OpenGL pairs rows from below."""
    return rules.height % side if rules.bottom_up else 0


def quads_of(fragments: Fragments, rules: RasterRules, side: int) -> tuple[Quads, Ints]:
    """The quads that contain the fragments, and for each fragment the number of its lane in
    them."""
    width, above = rules.width, rows_above(rules, side)
    x, y = fragments.pixel % width, fragments.pixel // width + above
    across = -(-width // side)
    column, row = x // side, y // side
    span = (int(row.max(initial=0)) + 1) * across
    keys, quad = np.unique(fragments.face * span + row * across + column, return_inverse=True)
    place = keys % span
    quads = Quads(keys // span, place % across * side, place // across * side - above, side)
    return quads, (quad * side + y % side) * side + x % side


class Barycentric:
    """The positions of quads' lanes in their faces; arrays are (quads, side, side)."""

    def __init__(self, faces: Faces, quads: Quads, rules: RasterRules) -> None:
        self._faces = faces
        self._face = quads.face
        self._nudge = _error(rules.varying_bits)
        self._flushed = 0.0 if rules.varying_bits is None else _FLUSHED
        steps = np.arange(quads.side) + 0.5
        self.x = (quads.x[:, None] + steps)[:, None, :]
        self.y = (quads.y[:, None] + steps)[:, :, None]
        self._extent = faces.extent[quads.face][:, None, None]
        self._linear = _linear(faces, quads.face, self.x, self.y)
        self._steps = self._steps_of_weights()
        depth = self._mixed(faces.z[quads.face].T, self._linear)
        self._moved = self._moved_by()
        off = self._off_plane(faces.z[quads.face], rules)
        off = off + faces.z_off[quads.face][:, None, None]
        self.depth = _depth(depth, off)
        near = faces.per_w[quads.face][:, :, None, None]
        per_w = self._mixed(faces.per_w[quads.face].T, self._linear)
        off = self._off_plane(faces.per_w[quads.face], rules)
        of_corners = faces.per_w_off[quads.face][:, None, None]
        self.per_w = Bounded(per_w, per_w - off - of_corners, per_w + off + of_corners)
        self._weights_off = of_corners / np.abs(per_w)
        """The relative errors of the weights, which the corners' w are a part of."""
        self._far = self._nudge * self._largest(faces.per_w[quads.face]) / np.abs(per_w)
        """The error of the divisor, relative to itself."""
        self._perspective = tuple(
            share * near[:, i + 1] / per_w for i, share in enumerate(self._linear)
        )
        self._slopes = self._slopes_of(near, per_w)
        """By how much these two weights change if the triangle is a pixel elsewhere."""
        self._whole = bool(faces.whole[quads.face].all())
        self._weights = faces.weights[quads.face]

    def perspective(self, values: Lanes) -> Lanes:
        """Interpolate values at the vertices with perspective.

        Lanes become ``Bounded``, whether those at the vertices are or not. A device rounds here
        even what is the same at all vertices.
        """
        return tuple(map(self._crossed, values))

    def flat(self, values: Lanes) -> Lanes:
        """The values of each triangle's first vertex."""
        first = self._faces.corners[self._face, 0]

        def at_first(array: Any) -> Any:
            return array[first][:, None, None]

        return tuple(
            lane.mapped(at_first) if isinstance(lane, Bounded) else at_first(lane)
            for lane in values
        )

    def _crossed(self, lane: Any) -> Bounded:
        """One lane, with the errors of a device.

        It has those of the three corners, each in proportion to its weight; that of the triangle's
        place, which a device knows only as precisely as its vertices' positions; and those of two
        planes. A device divides a plane through the values over w by a plane through 1 / w, which
        are rounded each on its own.
        """
        vertices = self._faces.corners[self._face]
        exact = lane.value if isinstance(lane, Bounded) else lane
        corners = exact[vertices].astype(np.float64)
        value = self._interpolated(corners)
        parts = self._cut(corners)
        # Those of the whole triangle, because the clipped part decides how its planes are rounded.
        near = self._faces.per_w[self._face]
        largest = np.abs(corners).max(axis=1) * np.abs(near).max(axis=1)
        flushed = self._flushed * (largest > 0)[:, None, None]
        largest = self._largest(parts * near, largest)
        planes = self._nudge * largest / np.abs(self.per_w.value)
        # A device multiplies by distances in the picture before it divides by the face's area.
        planes = np.where(largest * self._extent**2 > _OVERFLOWS, np.inf, planes)
        off = planes + self._far * np.abs(value) + flushed
        a, b, c = parts.T[:, :, None, None]
        second, third = np.abs(b - a), np.abs(c - a)
        off = off + self._moved * (self._slopes[0] * second + self._slopes[1] * third)
        off = off + self._weights_off * (second + third)
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

    def _largest(self, corners: Floats, largest: Floats | None = None) -> Floats:
        """The largest number with which a device computes a plane through some values (quads, 3).

        It is the largest value at the corners of faces, and how much is added to it or taken away
        on the way from the origin of the device's coordinates.
        """
        most = np.abs(corners).max(axis=1) if largest is None else largest
        found: Floats = most[:, None, None] + self._extent * self._steepness(corners)
        return found

    def _off_plane(self, corners: Floats, rules: RasterRules) -> Floats:
        """The error of a plane that is not divided by another one: of depth, and of 1 / w."""
        rounding = _error(rules.frag_coord_bits) * self._largest(corners)
        return rounding + self._moved * self._steepness(corners)

    def _steepness(self, corners: Floats) -> Floats:
        """The sum of the magnitudes of a plane's slopes to the right and downwards."""
        a, b, c = corners.T[:, :, None, None]
        right, down = (np.abs(x * (b - a) + y * (c - a)) for x, y in self._steps)
        steepness: Floats = right + down
        return steepness

    def _moved_by(self) -> Floats:
        """By how many pixels the triangle may be elsewhere at each place of a quad.

        A place is a weighted mean of the corners, and moves with each of them by its weight. Where
        a corner is behind the eye, a clipped part lies outside of the triangle between them, and
        some weights are negative.
        """
        second, third = self._linear
        shares = self._faces.shares[self._face]
        parts = np.stack([1.0 - second - third, second, third], axis=1)
        weights = np.abs(np.einsum("qijk,qic->qcjk", parts, shares))
        # A corner without weight is of no account, even if nothing is known of it.
        by_corner = self._faces.moved[self._face][:, :, None, None]
        moved: Floats = np.where(weights > 0, weights * by_corner, 0.0).sum(axis=1)
        return moved

    def _steps_of_weights(self) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]]:
        """The changes of the weights of the second and third corner to the right, and downwards."""
        ones = np.zeros((1, 1, 1))
        start = _linear(self._faces, self._face, ones, ones)
        right = _linear(self._faces, self._face, ones + 1, ones)
        down = _linear(self._faces, self._face, ones, ones + 1)
        return (
            (right[0] - start[0], right[1] - start[1]),
            (down[0] - start[0], down[1] - start[1]),
        )

    def _slopes_of(self, near: Floats, per_w: Floats) -> tuple[Floats, Floats]:
        """The sum of the magnitudes of each weight's changes to the right and downwards."""
        slopes: list[Floats] = []
        for i, share in enumerate(self._perspective):
            change = np.zeros_like(share)
            for step in self._steps:
                slope = step[0] * (near[:, 1] - near[:, 0]) + step[1] * (near[:, 2] - near[:, 0])
                change = change + np.abs((step[i] * near[:, i + 1] - share * slope) / per_w)
            slopes.append(change)
        return slopes[0], slopes[1]

    @staticmethod
    def _mixed(corners: Floats, shares: tuple[Floats, ...]) -> Floats:
        a, b, c = corners[:, :, None, None]
        mixed: Floats = a + shares[0] * (b - a) + shares[1] * (c - a)
        return mixed


def _depth(depth: Floats, off: Floats) -> Bounded:
    """A depth between the planes of clipping, and its bounds.

    Snapping may put the middle of a pixel into a triangle that is cut a little before it. A device
    may clamp the depth there, or not: no API says so of what shaders read.
    """
    return Bounded(
        np.clip(depth, 0.0, 1.0), np.minimum(depth - off, 1.0), np.maximum(depth + off, 0.0)
    )


def _error(bits: int | None) -> float:
    return 0.0 if bits is None else 2.0**-bits


def depths_of(faces: Faces, fragments: Fragments, rules: RasterRules) -> tuple[Floats, Floats]:
    """The depths of fragments as they are compared, and by how much those of a device may differ.

    Whatever a shader reads, the test clamps them to 0 and 1.
    """
    x, y = fragments.pixel % rules.width, fragments.pixel // rules.width
    read = Barycentric(faces, Quads(fragments.face, x, y, 1), rules).depth
    low, depth, high = (
        np.clip(end[:, 0, 0], 0.0, 1.0) for end in (read.low, read.value, read.high)
    )
    return depth, np.maximum(high - depth, depth - low)


def _linear(faces: Faces, face: Ints, x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """The weights of the second and third corner, linear on the screen."""
    ax, bx, cx = faces.plane_x[face].T
    ay, by, cy = faces.plane_y[face].T
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    dx, dy = x - ax[:, None, None], y - ay[:, None, None]
    second = ((cy - ay) / area)[:, None, None] * dx - ((cx - ax) / area)[:, None, None] * dy
    third = ((bx - ax) / area)[:, None, None] * dy - ((by - ay) / area)[:, None, None] * dx
    return second, third

"""Groups fragments into quads, and interpolates the vertices' values for them.

``drawing.py`` calls it between coverage and the fragment stage. Whatever samples of a pixel a face
covers, its values are those at the centre; only the depths that are compared are of each sample.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ....support.frozen import cached_property
from ..bounds import Bounded
from ..namespace import Lanes
from .coverage import Fragments
from .faces import Faces
from .samples import CENTRE, Location, location_of_depth, pixels_of
from .scene import Bools, Floats, Ints, RasterRules

_FLUSHED = 2.0**-120
"""The error of a mean where a device may take small numbers of the computation for zero.

Means of nothing but zeros are exact.
"""
_AT_ONCE = 1 << 16
"""The number of depths computed at once, so that a large picture needs no more memory."""
_HALF = 0.5
"""The largest distance of a pixel's samples from its centre, to the side and downwards."""
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
    at: Location = CENTRE
    """The place of the values in each pixel; of quads of one pixel, each may have its own."""

    def __len__(self) -> int:
        return len(self.face)

    def part(self, begin: int, end: int) -> Quads:
        """The quads from ``begin`` to ``end``, whose values are at the centres of pixels."""
        return Quads(self.face[begin:end], self.x[begin:end], self.y[begin:end], self.side)

    def only(self, some: Ints) -> Quads:
        """Quads of these numbers, whose values are at the centres of pixels."""
        return Quads(self.face[some], self.x[some], self.y[some], self.side)

    def places(self) -> tuple[Floats, Floats]:
        """The places of the values, in pixels: (quads, 1, side) and (quads, side, 1)."""
        across = self._each(self.x, self.at.x)
        down = self._each(self.y, self.at.y)
        return across[:, None, :], down[:, :, None]

    def _each(self, first: Ints, inside: Any) -> Floats:
        """(quads, side): the places along one side."""
        steps = np.arange(self.side) + np.reshape(inside, (-1, 1))
        return np.asarray(first[:, None] + steps, np.float64)


def rows_above(rules: RasterRules, side: int) -> int:
    """The number of rows of the first quads above the picture: OpenGL pairs rows from below."""
    return rules.height % side if rules.bottom_up else 0


def quads_of(fragments: Fragments, rules: RasterRules, side: int) -> tuple[Quads, Ints]:
    """The quads that contain the fragments, and for each fragment the number of its lane in them.

    All samples of a pixel share a lane.
    """
    width, above = rules.width, rows_above(rules, side)
    pixel = pixels_of(fragments.sample, rules)
    x, y = pixel % width, pixel // width + above
    across = -(-width // side)
    column, row = x // side, y // side
    # One number for each pair of a face and a quad's place, so that equal pairs are found at once.
    span = (int(row.max(initial=0)) + 1) * across
    keys, quad = np.unique(fragments.face * span + row * across + column, return_inverse=True)
    place = keys % span
    quads = Quads(keys // span, place % across * side, place // across * side - above, side)
    return quads, (quad * side + y % side) * side + x % side


class Barycentric:
    """The positions of quads' lanes in their faces; arrays are (quads, side, side).

    What only interpolation needs is computed when it is first asked for: the depth test of all
    fragments needs nothing but ``depth``.
    """

    def __init__(self, faces: Faces, quads: Quads, rules: RasterRules) -> None:
        self._faces = faces
        self._face = quads.face
        self._rules = rules
        self._nudge = _error(rules.varying_bits)
        self._flushed = 0.0 if rules.varying_bits is None else _FLUSHED
        self.x, self.y = quads.places()
        self._extent = faces.extent[quads.face][:, None, None]
        self._linear, self._steps = _linear(faces, quads.face, self.x, self.y)
        self._whole = bool(faces.whole[quads.face].all())
        self._weights = faces.weights[quads.face]
        self._moved = self._moved_by()

    @cached_property
    def depth(self) -> Bounded:
        """The depth at these places."""
        return self._depth_around(0.0)

    @cached_property
    def depth_read(self) -> Bounded:
        """The depth, as shaders read it.

        Where pixels have several samples, a device may give it that of any of them.
        """
        return self.depth if self._rules.samples == 1 else self._depth_around(_HALF)

    def _depth_around(self, reach: float) -> Bounded:
        """The depth within so many pixels of the places."""
        corners = self._faces.z[self._face]
        off = self._off_plane(corners) + self._faces.z_off[self._face][:, None, None]
        if reach:
            off = off + reach * self._steepness(corners)
        return _depth(self._mixed(corners.T, self._linear), off)

    @cached_property
    def per_w(self) -> Bounded:
        """1 / w, with which a device divides."""
        value = self._mixed(self._near.T, self._linear)
        off, of_corners = self._off_plane(self._near), self._per_w_off
        return Bounded(value, value - off - of_corners, value + off + of_corners)

    @cached_property
    def _near(self) -> Floats:
        """(quads, 3): 1 / w at the corners."""
        near: Floats = self._faces.per_w[self._face]
        return near

    @cached_property
    def _per_w_off(self) -> Floats:
        """The error of the corners' 1 / w."""
        off: Floats = self._faces.per_w_off[self._face][:, None, None]
        return off

    @cached_property
    def _weights_off(self) -> Floats:
        """The relative errors of the weights, which the corners' w are a part of."""
        relative: Floats = self._per_w_off / np.abs(self.per_w.value)
        return relative

    @cached_property
    def _far(self) -> Floats:
        """The error of the divisor, relative to itself."""
        relative: Floats = self._nudge * self._largest(self._near) / np.abs(self.per_w.value)
        return relative

    @cached_property
    def _may_divide_by_zero(self) -> Bools:
        """True where the divisor may have either sign: near the horizon of a plane.

        The centre of a pixel may lie beyond it if only some of its samples are covered.
        """
        lost: Bools = self._far + self._weights_off >= 1.0
        return lost

    @cached_property
    def _perspective(self) -> tuple[Floats, Floats]:
        """The weights of the second and third corner, with perspective."""
        second, third = self._linear
        _, near_b, near_c = self._near.T[:, :, None, None]
        return second * near_b / self.per_w.value, third * near_c / self.per_w.value

    def perspective(self, values: Lanes) -> Lanes:
        """Interpolates values at the vertices with perspective.

        Lanes become ``Bounded``, whether those at the vertices are or not. A device rounds here
        even values that are the same at all vertices.
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
        # The exact value, from those at the corners.
        vertices = self._faces.corners[self._face]
        exact = lane.value if isinstance(lane, Bounded) else lane
        corners = exact[vertices].astype(np.float64)
        value = self._interpolated(corners)
        parts = self._cut(corners)
        # The error of both planes, relative to the largest numbers that they are computed with:
        # those of the whole triangle, because the clipped part decides how its planes are rounded.
        near = self._near
        largest = _most(corners) * _most(near)
        flushed = self._flushed * (largest > 0)[:, None, None]
        largest = self._largest(parts * near, largest)
        planes = self._nudge * largest / np.abs(self.per_w.value)
        # A device multiplies by distances in the picture before it divides by the face's area.
        planes = np.where(largest * self._extent**2 > _OVERFLOWS, np.inf, planes)
        off = planes + self._far * np.abs(value) + flushed
        # The error of the triangle's place, and that of the weights by the corners' own w.
        a, b, c = parts.T[:, :, None, None]
        second, third = np.abs(b - a), np.abs(c - a)
        off = off + self._moved * (self._slopes[0] * second + self._slopes[1] * third)
        off = off + self._weights_off * (second + third)
        # The errors of the values at the corners, each by the magnitude of its weight.
        if isinstance(lane, Bounded) and not lane.is_exact:
            radius = np.maximum(lane.high - lane.value, lane.value - lane.low)
            a, b, c = self._cut(radius[vertices]).T[:, :, None, None]
            second, third = self._perspective
            off = off + np.abs(1.0 - second - third) * a + np.abs(second) * b + np.abs(third) * c
        # Near the horizon of the plane nothing is known.
        if self._may_divide_by_zero.any():
            off = np.where(self._may_divide_by_zero, np.inf, off)
        return Bounded(value, value - off, value + off)

    def _interpolated(self, corners: Floats) -> Floats:
        """The values at each lane, from those at the corners of whole triangles (quads, 3)."""
        return self._mixed(self._cut(corners).T, self._perspective)

    def _cut(self, corners: Floats) -> Floats:
        """The values at the corners of the clipped parts, from those of whole triangles."""
        return corners if self._whole else np.einsum("qij,qj->qi", self._weights, corners)

    def _largest(self, corners: Floats, largest: Floats | None = None) -> Floats:
        """The largest number with which a device computes a plane through some values (quads, 3).

        It is the largest value at the corners of faces, and how much is added to it or taken away
        on the way from the origin of the device's coordinates.
        """
        most = _most(corners) if largest is None else largest
        found: Floats = most[:, None, None] + self._extent * self._steepness(corners)
        return found

    def _off_plane(self, corners: Floats) -> Floats:
        """The error of a plane that is not divided by another one: of depth, and of 1 / w."""
        rounding = _error(self._rules.frag_coord_bits) * self._largest(corners)
        return rounding + self._moved * self._steepness(corners)

    def _steepness(self, corners: Floats) -> Floats:
        """The sum of the magnitudes of a plane's slopes to the right and downwards."""
        a, b, c = corners.T[:, :, None, None]
        right, down = (np.abs(x * (b - a) + y * (c - a)) for x, y in self._steps)
        steepness: Floats = right + down
        return steepness

    def _moved_by(self) -> Floats:
        """The pixels by which the triangle may be elsewhere at each place of a quad.

        A place is a weighted mean of the corners, and moves with each of them by its weight. Where
        a corner is behind the eye, a clipped part lies outside of the triangle between them, and
        some weights are negative.
        """
        second, third = self._linear
        weights = np.stack([1.0 - second - third, second, third], axis=1)
        # Otherwise these corners are the face's own, and their shares are the identity.
        if self._rules.interpolates_snapped and not self._whole:
            weights = np.einsum("qijk,qic->qcjk", weights, self._faces.shares[self._face])
        weights = np.abs(weights)
        # A corner without weight is of no account, even if nothing is known of it.
        by_corner = self._faces.moved[self._face][:, :, None, None]
        moved: Floats = np.where(weights > 0, weights * by_corner, 0.0).sum(axis=1)
        return moved

    @cached_property
    def _slopes(self) -> tuple[Floats, Floats]:
        """The changes of the weights if the triangle is a pixel elsewhere.

        They are the sums of the magnitudes of each weight's changes to the right and downwards.
        """
        near = self._near[:, :, None, None]
        slopes: list[Floats] = []
        for i, share in enumerate(self._perspective):
            change = np.zeros_like(share)
            # By the quotient rule, as a share is a linear weight times its corner's 1 / w, divided
            # by the mean 1 / w.
            for step in self._steps:
                slope = step[0] * (near[:, 1] - near[:, 0]) + step[1] * (near[:, 2] - near[:, 0])
                moved = step[i] * near[:, i + 1] - share * slope
                change = change + np.abs(moved / self.per_w.value)
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
    """The relative error of numbers with so many bits; 0 if the rules ask for exact numbers."""
    return 0.0 if bits is None else 2.0**-bits


def depths_of(faces: Faces, fragments: Fragments, rules: RasterRules) -> tuple[Floats, Floats]:
    """The depths of fragments as they are compared, and by how much those of a device may differ.

    Whatever a shader reads, the test clamps them to 0 and 1.
    """
    read = _single(faces, fragments, rules)
    low, depth, high = (np.clip(end, 0.0, 1.0) for end in (read.low, read.value, read.high))
    return depth, np.maximum(high - depth, depth - low)


def out_of_range(faces: Faces, fragments: Fragments, rules: RasterRules) -> Bools:
    """The fragments whose depth may be below 0 or above 1 on a device."""
    read = _single(faces, fragments, rules)
    beyond: Bools = (read.low < 0.0) | (read.high > 1.0)
    return beyond


def _single(faces: Faces, fragments: Fragments, rules: RasterRules) -> Bounded:
    """The depths of single samples, (fragments,)."""
    found = []
    for begin in range(0, max(len(fragments.sample), 1), _AT_ONCE):
        part = fragments.only(slice(begin, begin + _AT_ONCE))
        pixel, at = pixels_of(part.sample, rules), location_of_depth(part.sample, rules)
        quads = Quads(part.face, pixel % rules.width, pixel // rules.width, 1, at)
        depth = Barycentric(faces, quads, rules).depth
        found.append((depth.value, depth.low, depth.high))
    value, low, high = (np.concatenate(ends)[:, 0, 0] for ends in zip(*found, strict=True))
    return Bounded(value, low, high)


def _most(corners: Floats) -> Floats:
    """The largest magnitude at the three corners (quads, 3) of each quad's face."""
    a, b, c = np.abs(corners.T)
    most: Floats = np.maximum(np.maximum(a, b), c)
    return most


_Weights = tuple[Floats, Floats]
"""The weights of the second and third corner; the first one has the rest."""


def _linear(
    faces: Faces, face: Ints, x: Floats, y: Floats
) -> tuple[_Weights, tuple[_Weights, _Weights]]:
    """The weights at some places, linear on the screen; and their changes right and downwards."""
    ax, bx, cx = faces.plane_x[face].T
    ay, by, cy = faces.plane_y[face].T
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    right, down = (
        (second[:, None, None], third[:, None, None])
        for second, third in (
            ((cy - ay) / area, -(by - ay) / area),
            (-(cx - ax) / area, (bx - ax) / area),
        )
    )
    dx, dy = x - ax[:, None, None], y - ay[:, None, None]
    return (right[0] * dx + down[0] * dy, right[1] * dx + down[1] * dy), (right, down)

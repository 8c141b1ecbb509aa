"""Turns clip positions into lines of the width 1 in the window.

``assembly.py`` calls ``lines_of`` after the vertex stage. APIs do not agree on which pixels a line
covers, and drivers do as they like: ``RasterRules.lines`` says by which rule a picture is drawn.
Sources: Vulkan, "Line Segments" and "Bresenham Line Segment Rasterization"; Direct3D 11.3
functional specification, 3.4.4; OpenGL 4.5, 14.5.1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from .clip import clip_lines
from .faces import (
    FLOAT32_STEPS,
    Faces,
    depths_off,
    extent_of,
    moved_by,
    snapped,
    unsure_corners,
    window,
)
from .scene import Bools, Floats, Ints, RasterRules

_HALF = 0.5
"""Half the width of a line, and how far a diamond reaches from the middle of its pixel."""
_ANY_END = 1.0
"""The pixels by which the ends of a line differ between all rules."""
_EITHER_SNAPPED = 1.0
"""The steps, along each axis, by which corners differ that are snapped in one way or the other.

Three roundings make up to 1.5 steps, and places on the grid differ by whole ones.
"""
_BORDER = 1.0
"""The distance from the picture's border, in pixels, at which the border matters.

Within it, an end has corners beyond the border, or a line ends somewhere if a device cuts it there.
"""
_CORNERS = [0, 1, 0]
"""The ends whose values the corners of a plane have."""
_NEARLY_DIAGONAL = 2.0**-12
"""The relative difference of a line's two directions below which either may be the longer one."""


@dataclass(frozen=True, slots=True)
class LineFaces(Faces):
    """Lines in the window: the outline has four corners, and the plane goes through the line."""

    begin: Floats
    end: Floats
    """(faces, 2): the ends."""
    slack: Floats
    """(faces,): the distance at which rounding tips a decision about an end."""
    step: Floats
    """(faces,): the distance between the places to which ends are snapped."""
    leaves: Bools
    """(faces,): whether the line goes beyond the viewport, so that a device may cut it there."""
    first: Floats
    last: Floats
    """(faces, 2): the upper left and the lower right corner of the viewport."""
    by_diamonds: Bools
    """(faces,): whether the ends are those of diamonds."""

    def settled(
        self, face: Ints, place: tuple[Floats, Floats], covered: Bools, close: Bools
    ) -> tuple[Bools, Bools]:
        """Beside the outline, diamonds count at the ends; and the border where a line is cut."""
        if self.by_diamonds.any():
            covered, close = self._by_diamonds(face, place, covered, close)
        middle = np.stack(place, axis=1)
        beside = np.minimum(middle - self.first[face], self.last[face] - middle).min(axis=1)
        return covered, close | (self.leaves[face] & (beside < _BORDER))

    def _by_diamonds(
        self, face: Ints, place: tuple[Floats, Floats], covered: Bools, close: Bools
    ) -> tuple[Bools, Bools]:
        """Decides the pixels that lines cover by the diamond rule.

        A pixel is covered if the line leaves its diamond. Where it goes past the middle of the
        pixel, it does; elsewhere it has to begin inside, and it must not end there.
        """
        middle = np.stack(place, axis=1)
        from_begin, from_end = middle - self.begin[face], middle - self.end[face]
        along = self.end[face] - self.begin[face]
        longer = np.abs(along).argmax(axis=1)[:, None]
        forth = np.sign(along)
        after, before = (
            np.take_along_axis(distance, longer, 1)[:, 0]
            for distance in (forth * from_begin, -forth * from_end)
        )
        in_first, in_last = (_HALF - np.abs(d).sum(axis=1) for d in (from_begin, from_end))
        leaves = ((after > 0) & (before > 0) | (in_first > 0)) & (in_last <= 0)
        slack = self.slack[face]
        nearly = np.minimum(np.abs(in_first), np.abs(in_last)) <= slack
        # The places where lines pass by are snapped, and their ends in diamonds are not.
        nearly |= np.minimum(np.abs(after), np.abs(before)) <= slack + self.step[face]
        return covered & leaves, close | (covered & nearly)


@dataclass(frozen=True, slots=True)
class _Outline:
    """The corners of the area that a line covers, before they are snapped; arrays (faces, 4, 2).

    They are in such an order that the front is seen: a line has no back.
    """

    middle: Floats
    """The end of the line to which each corner belongs."""
    beside: Floats
    """The offset of the corner from there."""
    length: Floats
    """(faces,): that of the line."""
    narrowing: Floats
    """(faces,): by how many pixels the sides along the line differ between all rules."""
    diagonal: Bools
    """(faces,): true if rounding decides which direction is the longer one."""


def lines_of(positions: Floats, lines: Ints, rules: RasterRules, of_vertices: Floats) -> Faces:
    """The faces of lines whose ends have these clip positions, (vertices, 4).

    ``of_vertices`` says by how much a device's positions may differ.
    """
    clipped = clip_lines(positions[lines])
    whole, whole_off = positions[lines[clipped.primitive]], of_vertices[lines[clipped.primitive]]
    places, off = clipped.weights @ whole, np.abs(clipped.weights) @ whole_off
    ends = np.stack(window(places, rules), axis=-1)
    first, last = _border(rules)
    outline = _outline(ends, rules)
    x, y = _corners(outline, rules)
    moved = moved_by(places, off, rules).max(axis=1)
    slack = _slack(moved, outline, rules)
    shares = _shares(whole, clipped.weights)
    plane = _plane(ends, whole, shares, rules)
    z_off, per_w_off = depths_off(places, off)
    faces = LineFaces(
        primitive=clipped.primitive,
        corners=lines[clipped.primitive][:, _CORNERS],
        weights=_with_third(clipped.weights, clipped.weights[:, 0]),
        whole=np.asarray(~clipped.made.any(axis=1)),
        x=x,
        y=y,
        area=np.full(len(x), -1.0),
        front=np.ones(len(x), np.bool_),
        unsure=_unsure(outline, slack, _leaves(ends, rules, _BORDER), rules),
        moved=_moved_plane(whole, whole_off, moved, outline, rules),
        extent=extent_of(plane, rules),
        plane_x=plane[0],
        plane_y=plane[1],
        shares=_with_third(shares, np.zeros_like(ends[:, 0]), own=1.0),
        z=(places[..., 2] / places[..., 3])[:, _CORNERS],
        per_w=(1.0 / places[..., 3])[:, _CORNERS],
        z_off=z_off,
        per_w_off=per_w_off,
        begin=ends[:, 0],
        end=ends[:, 1],
        slack=slack + rules.edge_slack,
        step=np.full(len(x), _step(rules)),
        leaves=_leaves(ends, rules),
        first=np.broadcast_to(first, ends[:, 0].shape),
        last=np.broadcast_to(last, ends[:, 0].shape),
        by_diamonds=np.full(len(x), rules.lines == "diamonds"),
    )
    kept: Bools = np.isfinite(x + y).all(axis=1) & (outline.length > 0)
    return faces.only(kept)


def _border(rules: RasterRules) -> tuple[Floats, Floats]:
    """The upper left and the lower right corner of the viewport."""
    left, top, width, height = rules.port
    return np.array([left, top], np.float64), np.array([left + width, top + height], np.float64)


def _leaves(ends: Floats, rules: RasterRules, margin: float = 0.0) -> Bools:
    """True for lines with an end beyond the viewport, or so close to its border."""
    first, last = _border(rules)
    inside = (ends >= first + margin) & (ends <= last - margin)
    beyond: Bools = np.asarray(~inside.all(axis=(1, 2)))
    return beyond


def _outline(ends: Floats, rules: RasterRules) -> _Outline:
    """The area that lines (faces, 2, 2) cover by the rule of the device."""
    begin, end = ends[:, 0], ends[:, 1]
    along = end - begin
    length = np.hypot(*along.T)
    straight = along / np.where(length > 0, length, 1.0)[:, None]
    dx, dy = straight.T
    across = _HALF * np.stack([-dy, dx], axis=1)
    steep = np.abs(dy) > np.abs(dx)
    longer = np.maximum(np.abs(dx), np.abs(dy))
    if rules.lines in ("parallelogram", "diamonds"):
        flat = np.stack([np.zeros_like(dx), np.sign(dx)], axis=1)
        upright = np.stack([-np.sign(dy), np.zeros_like(dy)], axis=1)
        across = _HALF * np.where(steep[:, None], upright, flat)
    if rules.lines == "diamonds":
        # The diamond of a pixel may begin before the line, or end behind it.
        beyond = _HALF * straight / np.where(longer > 0, longer, 1.0)[:, None]
        begin, end = begin - beyond, end + beyond
    return _Outline(
        middle=np.stack([begin, end, end, begin], axis=1),
        beside=np.stack([across, across, -across, -across], axis=1),
        length=length,
        narrowing=_HALF * (1.0 - longer),
        diagonal=np.asarray(np.abs(np.abs(dx) - np.abs(dy)) < _NEARLY_DIAGONAL),
    )


def _corners(outline: _Outline, rules: RasterRules) -> Floats:
    """The corners on the device's grid, (2, faces, 4).

    Where diamonds count, nothing is known of the places along the line whose corners a device
    snaps.
    """
    if rules.lines == "diamonds":
        found = outline.middle + outline.beside
    elif rules.snaps_line_ends:
        found = snapped(outline.middle, rules) + snapped(outline.beside, rules)
    else:
        found = snapped(outline.middle + outline.beside, rules)
    corners: Floats = np.moveaxis(found, 2, 0)
    return corners


def _step(rules: RasterRules) -> float:
    """The distance between the places to which vertices are snapped."""
    return 0.0 if rules.subpixel_bits is None else 2.0**-rules.subpixel_bits


def _slack(moved: Floats, outline: _Outline, rules: RasterRules) -> Floats:
    """The pixels by which lines may be elsewhere before they are snapped.

    Where both ends may move, a line may turn.
    """
    ends = moved + (_step(rules) if rules.lines == "any" else 0.0)
    turned = ends / np.maximum(outline.length, ends)
    slack: Floats = moved + turned
    return slack


def _unsure(outline: _Outline, slack: Floats, is_cut: Bools, rules: RasterRules) -> Floats:
    """The pixels by which each side of the outlines may be elsewhere.

    The sides are one along the line, its end, the other one, and where it begins.
    """
    corners = _unsure_corners(outline, slack, rules)
    # A line that a device cuts at the picture's border gets new corners there, which are snapped.
    cut = np.where(is_cut, _step(rules), 0.0)[:, None]
    sides = np.maximum(corners, np.roll(corners, -1, axis=1)) + cut
    along, ends = sides[:, ::2], sides[:, 1::2]
    if rules.lines == "any":
        along = along + (outline.narrowing + _step(rules))[:, None]
        ends = ends + _ANY_END
    elif rules.lines == "parallelogram":
        ends = ends + np.where(outline.diagonal, _ANY_END, 0.0)[:, None]
    unsure: Floats = np.stack([along, ends], axis=2).reshape(sides.shape)
    return unsure


def _unsure_corners(outline: _Outline, slack: Floats, rules: RasterRules) -> Floats:
    """The pixels by which each corner of the outlines may be elsewhere after snapping."""
    if rules.lines == "diamonds":
        farthest = slack + np.sqrt(0.5) * _step(rules) + rules.edge_slack
        return np.repeat(farthest[:, None], 4, axis=1)
    unsure = partial(unsure_corners, moved=slack[:, None], rules=rules)
    middle, beside = (np.moveaxis(part, 2, 0) for part in (outline.middle, outline.beside))
    if rules.snaps_line_ends:
        return unsure(*middle) + unsure(*beside)
    either = 0.0
    if rules.snaps_line_ends is None and rules.lines != "any":
        either = np.sqrt(2.0) * _EITHER_SNAPPED * _step(rules)
    return unsure(*(middle + beside)) + either


def _shares(whole: Floats, weights: Floats) -> Floats:
    """Parts' ends in the window as weighted sums of those of whole lines, (faces, 2, 2)."""
    shares = weights * whole[:, None, :, 3]
    shares /= shares.sum(axis=2, keepdims=True)
    return shares


def _plane(
    ends: Floats, whole: Floats, shares: Floats, rules: RasterRules
) -> tuple[Floats, Floats]:
    """Three places over which values are interpolated.

    They are the ends of each line, and one beside its beginning with the same values. So these
    change along the line only; where diamonds count, along its longer direction.
    """
    if rules.interpolates_snapped:
        ends = shares @ snapped(np.stack(window(whole, rules), axis=-1), rules)
    begin, end = ends[:, 0], ends[:, 1]
    dx, dy = (end - begin).T
    beside = np.stack([-dy, dx], axis=1)
    if rules.lines == "diamonds":
        beside[np.abs(dy) > np.abs(dx), 1] = 0.0
        beside[np.abs(dy) <= np.abs(dx), 0] = 0.0
    (ax, ay), (bx, by), (cx, cy) = (place.T for place in (begin, end, begin + beside))
    return np.stack([ax, bx, cx], axis=1), np.stack([ay, by, cy], axis=1)


def _moved_plane(
    whole: Floats, off: Floats, moved: Floats, outline: _Outline, rules: RasterRules
) -> Floats:
    """The pixels by which each of these may be elsewhere; the third one turns with the line."""
    moved = moved[:, None]
    if rules.interpolates_snapped:
        places = window(whole, rules)
        far = FLOAT32_STEPS * np.maximum(*np.abs(places))
        own = unsure_corners(*places, moved_by(whole, off, rules) + far, rules)
        moved = moved + own.max(axis=1, keepdims=True)
    if rules.lines == "any":
        # Not all take the place on the line that is nearest to the middle of the pixel.
        moved = moved + _HALF
    elif rules.lines == "diamonds":
        moved = moved + np.where(outline.diagonal, _HALF, 0.0)[:, None]
    of_corners: Floats = moved * np.array([1.0, 1.0, 3.0])
    return of_corners


def _with_third(of_ends: Floats, third: Floats, own: float = 0.0) -> Floats:
    """Weights (faces, 3, 3) of the corners of planes, from those of ends (faces, 2, 2)."""
    found = np.zeros((len(of_ends), 3, 3))
    found[:, :2, :2] = of_ends
    found[:, 2, :2] = third
    found[:, 2, 2] = own
    return found

"""Turns clip positions into triangles in the window: viewport, snapping, facing and culling.

``assembly.py`` calls ``triangles_of`` after the vertex stage, and ``culled`` then. ``lines.py``
does the same of lines.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from ...ir.render_state import Cull, Winding
from .clip import clip
from .scene import Bools, Floats, Ints, RasterRules

FLOAT32_STEPS = 5e-7
"""The error of several roundings to float32, relative to the size of the picture."""


@dataclass(frozen=True, slots=True)
class Faces:
    """Triangles in the window, x to the right, y downwards, in pixels; none has the area zero.

    Pixels are covered by an outline, which is the triangle itself for a triangle. Values are
    interpolated over a plane through three corners.
    """

    primitive: Ints
    """(faces,): the number of the triangle or line that each is a part of."""
    corners: Ints
    """The vertices of the triangle that each face is a part of, (faces, 3).

    For a line, they are its first end, the other one, and the first one again.
    """
    weights: Floats
    """(faces, 3, 3): each corner as a weighted sum of the triangle's corners."""
    whole: Bools
    """(faces,): whether nothing was clipped, so that ``weights`` is the identity."""
    x: Floats
    y: Floats
    """(faces, sides): the corners of the outline, which decide on coverage."""
    area: Floats
    """(faces,): twice its signed area, positive if the corners are clockwise on the screen."""
    front: Bools
    """(faces,): whether the front is seen."""
    unsure: Floats
    """The pixels by which a device may have each side elsewhere, (faces, sides).

    A side goes from a corner of the outline to the next one.
    """
    moved: Floats
    """The pixels by which each corner of the plane may be elsewhere, (faces, 3).

    A device interpolates between these corners; ``shares`` says which they are.
    """
    extent: Floats
    """(faces,): the largest coordinate of a place in the picture, or of a corner, in pixels."""
    plane_x: Floats
    plane_y: Floats
    """(faces, 3): the positions between which values are interpolated."""
    shares: Floats
    """(faces, 3, 3): each of these as a weighted sum of the positions that a device has computed:
    those of the whole triangle's corners, or of the clipped part's own. Some weights are negative
    where a corner is behind the eye."""
    z: Floats
    """(faces, 3): depth."""
    per_w: Floats
    """(faces, 3): 1 / clip w."""
    z_off: Floats
    per_w_off: Floats
    """(faces,): by how much these two may differ on a device."""

    def only(self, kept: Bools | Ints) -> Faces:
        """The faces for which ``kept`` is true, or those with these numbers."""
        return replace(self, **{row.name: getattr(self, row.name)[kept] for row in fields(self)})

    def settled(
        self, face: Ints, place: tuple[Floats, Floats], covered: Bools, close: Bools
    ) -> tuple[Bools, Bools]:
        """The candidates that are covered, and those for which rounding decides.

        For each candidate it gets the face, the place of the sample, and the verdict of the outline
        on both. Where other rules count as well, a subclass has them.
        """
        del face, place
        return covered, close


@dataclass(frozen=True, slots=True)
class CulledFaces(Faces):
    """Triangles of which only one side is drawn.

    Among them are those that are so thin that rounding may turn them over: a device may draw them
    where the reference does not, or the other way round.
    """

    hidden: Bools
    """(faces,): whether the reference does not draw it."""

    def settled(
        self, face: Ints, place: tuple[Floats, Floats], covered: Bools, close: Bools
    ) -> tuple[Bools, Bools]:
        del place
        drawn: Bools = covered & ~self.hidden[face]
        return drawn, close | (covered & self.may_turn[face])

    @property
    def may_turn(self) -> Bools:
        """(faces,): those that are so thin."""
        return _may_turn(self)


def culled(faces: Faces, cull: Cull) -> Faces:
    """The triangles without those of which the side is seen that ``cull`` names."""
    if cull == "none":
        return faces
    hidden = faces.front == (cull == "front")
    rows = {row.name: getattr(faces, row.name) for row in fields(faces)}
    return CulledFaces(**rows, hidden=hidden).only(~hidden | _may_turn(faces))


def _may_turn(faces: Faces) -> Bools:
    """True for triangles that may show their other side if their corners move a little.

    A corner that moves changes the area by no more than the way times the opposite side; the moves
    of several corners together add no more than six times the square of the way.
    """
    way = faces.unsure.max(axis=1, initial=0.0)
    across, down = (np.roll(at, -1, axis=1) - at for at in (faces.x, faces.y))
    around = np.hypot(across, down).sum(axis=1)
    may_turn: Bools = np.abs(faces.area) < way * (around + 6.0 * way)
    return may_turn


def triangles_of(
    positions: Floats,
    triangles: Ints,
    rules: RasterRules,
    of_vertices: Floats,
    front: Winding = "counter_clockwise",
) -> Faces:
    """The faces of triangles whose vertices have these clip positions, (vertices, 4).

    ``of_vertices`` says by how much a device's positions may differ, and ``front`` how the corners
    go around if the front is seen.
    """
    clipped = clip(positions[triangles], sides=rules.clips_sides)
    corners = triangles[clipped.primitive]
    places = clipped.weights @ positions[corners]
    across, down = window(places, rules)
    snapped_x, snapped_y = snapped(across, rules), snapped(down, rules)
    area = _twice_area(snapped_x, snapped_y)
    planes, shares = (across, down), np.broadcast_to(np.eye(3), clipped.weights.shape)
    if rules.interpolates_snapped:
        shares = _shares(positions[corners], clipped.weights)
        planes = _on_snapped(positions[corners], shares, rules, planes)
    # Snapping may reverse a sliver; then only the snapped positions are consistent.
    turned = (_twice_area(*planes) * area <= 0)[:, None]
    of_places = np.abs(clipped.weights) @ of_vertices[corners]
    moved = moved_by(places, of_places, rules).max(axis=1, keepdims=True)
    z_off, per_w_off = depths_off(places, of_places)
    unsure = unsure_corners(across, down, moved, rules)
    unsure = np.maximum(unsure, np.roll(unsure, -1, axis=1))
    # Parts of one triangle show the same plane, and a pixel between them is drawn once: by which
    # of them makes no difference.
    unsure = np.where(clipped.inner, 0.0, unsure)
    moved = np.broadcast_to(moved, across.shape)
    if rules.interpolates_snapped:
        whole = window(positions[corners], rules)
        # Corners that were clipped may be far outside of the picture, where steps are larger.
        far = FLOAT32_STEPS * np.maximum(*np.abs(whole))
        own = moved_by(positions[corners], of_vertices[corners], rules)
        moved = moved + unsure_corners(*whole, own + far, rules)
    faces = Faces(
        primitive=clipped.primitive,
        corners=corners,
        weights=clipped.weights,
        whole=np.asarray(~clipped.made.any(axis=1)),
        x=snapped_x,
        y=snapped_y,
        area=area,
        front=(area < 0) == (front == "counter_clockwise"),
        unsure=unsure,
        moved=moved,
        extent=extent_of(planes, rules),
        plane_x=np.where(turned, snapped_x, planes[0]),
        plane_y=np.where(turned, snapped_y, planes[1]),
        shares=shares,
        z=places[..., 2] / places[..., 3],
        per_w=1.0 / places[..., 3],
        z_off=z_off,
        per_w_off=per_w_off,
    )
    return faces.only(_kept(faces))


def window(positions: Floats, rules: RasterRules) -> tuple[Floats, Floats]:
    """The x and y of clip positions (…, 4) in pixels, from the left and from the top."""
    x, y, _, w = np.moveaxis(positions, -1, 0)
    left, top, width, height = rules.port
    return left + (x / w * 0.5 + 0.5) * width, top + (0.5 - y / w * 0.5) * height


def _shares(corners: Floats, weights: Floats) -> Floats:
    """Parts' corners in the window as weighted sums of those of whole triangles, (faces, 3, 3)."""
    shares = weights * corners[:, None, :, 3]
    shares /= shares.sum(axis=2, keepdims=True)
    return shares


def _on_snapped(
    corners: Floats, shares: Floats, rules: RasterRules, parts: tuple[Floats, Floats]
) -> tuple[Floats, Floats]:
    """The positions of parts' corners after the corners of whole triangles have been snapped.

    A part has no planes of its own: values are interpolated over the triangle that it was cut from.
    But a corner of that may be just as far ahead as the eye, and so be nowhere in the window. Then
    the positions are those of the ``parts``.
    """
    x, y = (snapped(places, rules) for places in window(corners, rules))
    whole = [(shares @ at[..., None])[..., 0] for at in (x, y)]
    somewhere = np.isfinite(np.concatenate(whole, axis=1)).all(axis=1, keepdims=True)
    across, down = (np.where(somewhere, *each) for each in zip(whole, parts, strict=True))
    return across, down


def _kept(faces: Faces) -> Bools:
    kept: Bools = np.isfinite(faces.area) & np.isfinite(faces.x + faces.y).all(axis=1)
    kept &= faces.area != 0
    return kept


def _twice_area(x: Floats, y: Floats) -> Floats:
    ux, uy = x[:, 1] - x[:, 0], y[:, 1] - y[:, 0]
    vx, vy = x[:, 2] - x[:, 0], y[:, 2] - y[:, 0]
    return ux * vy - uy * vx


def snapped(places: Floats, rules: RasterRules) -> Floats:
    """Positions rounded to the nearest binary fraction of a pixel."""
    if rules.subpixel_bits is None:
        return places
    return np.ldexp(np.rint(np.ldexp(places, rules.subpixel_bits)), -rules.subpixel_bits)


def moved_by(places: Floats, off: Floats, rules: RasterRules) -> Floats:
    """The pixels by which the corners (faces, 3, 4) of faces may be elsewhere, (faces, 3).

    The viewport's transform and the planes through the corners are computed with float32, in
    numbers as large as the picture.
    """
    w = np.abs(places[..., 3])
    least = np.maximum(w - off[..., 3], 0.0)
    pixels = [
        (off[..., axis] + np.abs(places[..., axis]) / w * off[..., 3]) / least * size / 2
        for axis, size in enumerate(rules.port[2:])
    ]
    largest = np.nan_to_num(np.maximum(*pixels), nan=np.inf, posinf=np.inf)
    moved: Floats = largest + FLOAT32_STEPS * max(rules.width, rules.height)
    return moved


def depths_off(places: Floats, off: Floats) -> tuple[Floats, Floats]:
    """The possible errors of the depths of corners (faces, 3, 4), and of their 1 / w."""
    w = np.abs(places[..., 3])
    least = np.maximum(w - off[..., 3], 0.0)
    z = (off[..., 2] + np.abs(places[..., 2]) / w * off[..., 3]) / least
    per_w = off[..., 3] / (w * least)
    z_off, per_w_off = (
        np.nan_to_num(each.max(axis=1), nan=np.inf, posinf=np.inf) for each in (z, per_w)
    )
    return z_off, per_w_off


def extent_of(planes: tuple[Floats, Floats], rules: RasterRules) -> Floats:
    """The largest coordinate with which the plane through a face's corners is computed."""
    corners = np.abs(np.stack(planes)).max(axis=(0, 2))
    extent: Floats = np.maximum(corners, max(rules.width, rules.height))
    return extent


def unsure_corners(x: Floats, y: Floats, moved: Floats, rules: RasterRules) -> Floats:
    """The pixels by which a vertex at (x, y) may be elsewhere on a device after snapping."""
    if rules.subpixel_bits is None:
        return np.broadcast_to(moved, x.shape)
    margin = moved * 2.0**rules.subpixel_bits
    ambiguous = np.zeros(x.shape, dtype=np.bool_)
    for places in (x, y):
        units = np.ldexp(places, rules.subpixel_bits)
        ambiguous |= np.abs(units - np.floor(units) - 0.5) < margin
    elsewhere = np.sqrt(2.0) * (2.0**-rules.subpixel_bits + moved)
    return np.where(ambiguous, elsewhere, rules.edge_slack)

"""Clips triangles and lines in clip space: at near (0 <= z), at far (z <= w), at the eye (0 < w).

``faces.py`` and ``lines.py`` call it before they divide by w. Double precision needs no clipping at
the sides of the picture, but some devices do it, and snap the new corners to their grid. The
algorithm for triangles is from Sutherland and Hodgman, "Reentrant polygon clipping", 1974.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .scene import Bools, Floats, Ints

_SMALLEST_W = 1e-6
"""The least w, relative to a triangle's largest; for smaller ones, quotients would be imprecise."""


@dataclass(frozen=True, slots=True)
class Clipped:
    """The parts of triangles or lines that are inside of the planes; each is a face."""

    primitive: Ints
    """(faces,): the triangle or line that each is a part of, in ascending order."""
    weights: Floats
    """Each corner as a weighted sum of those of the whole:

    (faces, 3, 3), for lines (faces, 2, 2).
    """
    made: Bools
    """(faces, 3 or 2): whether clipping has made the corner."""
    inner: Bools
    """True for sides within the triangle, where another part begins.

    A side goes from this corner to the next one: (faces, 3), for lines (faces, 2).
    """


def clip(corners: Floats, *, sides: bool = False) -> Clipped:
    """Clip triangles whose corners have these clip positions, (triangles, 3, 4).

    ``sides`` also clips at the sides of the picture, |x| <= w and |y| <= w. Triangles with numbers
    that are not finite are removed.
    """
    distances = _distances(corners, sides)
    kept, whole = _kept(corners, distances)
    crossing = np.flatnonzero(kept & ~whole)
    parts = [_parts(distances[i]) for i in crossing]
    pieces = [piece for part in parts for piece in part]
    cut = np.array(pieces, dtype=np.float64).reshape(-1, 3, 3)
    triangle = np.concatenate(
        [np.flatnonzero(whole), np.repeat(crossing, [len(part) for part in parts])]
    ).astype(np.int64)
    weights = np.concatenate([np.broadcast_to(np.eye(3), (int(whole.sum()), 3, 3)), cut])
    inner = np.concatenate([np.zeros((int(whole.sum()), 3), np.bool_), *map(_inner_sides, parts)])
    order = np.argsort(triangle, kind="stable")
    made: Bools = np.asarray((weights < 1).all(axis=2))
    return Clipped(triangle[order], weights[order], made[order], inner[order])


def clip_lines(ends: Floats) -> Clipped:
    """Clip lines whose ends have these clip positions, (lines, 2, 4); not at the picture's sides.

    Lines with numbers that are not finite are removed.
    """
    distances = _distances(ends, sides=False)
    kept, whole = _kept(ends, distances)
    begin, end = distances[:, 0], distances[:, 1]
    share = begin / np.where(begin == end, 1.0, begin - end)
    first = np.where(begin < 0, share, 0.0).max(axis=1)
    last = np.where(end < 0, share, 1.0).min(axis=1)
    kept &= whole | (first < last)
    shares = np.stack([first, last], axis=1)[kept]
    weights = np.stack([1.0 - shares, shares], axis=2)
    made: Bools = np.asarray((weights < 1).all(axis=2))
    return Clipped(np.flatnonzero(kept), weights, made, np.zeros_like(made))


def _kept(corners: Floats, distances: Floats) -> tuple[Bools, Bools]:
    """The triangles or lines that may have a part inside, and those that are inside as a whole."""
    inside = distances >= 0
    finite = np.isfinite(corners).all(axis=(1, 2))
    kept: Bools = np.asarray(finite & inside.any(axis=1).all(axis=-1))
    whole: Bools = kept & inside.all(axis=(1, 2))
    return kept, whole


def _distances(corners: Floats, sides: bool) -> Floats:
    """(…, corners, planes): the distances from the planes, which are not negative inside."""
    x, y, z, w = np.moveaxis(corners, -1, 0)
    nearest = _SMALLEST_W * np.abs(w).max(axis=-1, keepdims=True)
    nearest = np.maximum(nearest, np.finfo(np.float64).tiny)
    planes = [z, w - z, w - nearest]
    if sides:
        planes += [w + x, w - x, w + y, w - y]
    return np.stack(planes, axis=-1)


def _parts(distances: Floats) -> list[Floats]:
    """A fan of triangles, each as its corners' weights (3, 3); empty if nothing is inside.

    ``distances`` are those of a triangle's corners from the planes, (3, planes).
    """
    polygon = list(np.eye(3))
    for plane in np.flatnonzero((distances < 0).any(axis=0)):
        polygon = _inside(polygon, distances[:, plane])
    return [np.stack([polygon[0], *polygon[i : i + 2]]) for i in range(1, len(polygon) - 1)]


def _inner_sides(fan: Sequence[Floats]) -> Bools:
    """True for the sides of a fan's triangles between two of them, (triangles, 3)."""
    inner = np.zeros((len(fan), 3), np.bool_)
    inner[1:, 0] = True
    inner[:-1, 2] = True
    return inner


def _inside(polygon: list[Floats], distances: Floats) -> list[Floats]:
    """The part of a polygon in front of a plane that has these distances from the three corners."""
    found = []
    for corner, following in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        here, there = float(corner @ distances), float(following @ distances)
        if here >= 0:
            found.append(corner)
        if (here >= 0) != (there >= 0):
            share = here / (here - there)
            found.append(corner + share * (following - corner))
    return found

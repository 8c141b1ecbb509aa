"""Which pixels a face covers: edge functions at pixel centres, with the top-left rule.

On vertices that are snapped to a grid the edge functions are exact. Even where they are not, an
edge that two faces share is evaluated in one direction only, so that no pixel on it is drawn twice
or left out. Pineda, "A parallel algorithm for polygon rasterization", 1988.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .faces import Faces
from .scene import Bools, Floats, Ints, RasterRules

_CANDIDATES = 1 << 18
"""Pixels that are tried at once."""


@dataclass(frozen=True, slots=True)
class Fragments:
    """Pairs of face and pixel."""

    face: Ints
    """Ascending, in the order of drawing."""
    pixel: Ints
    """Number of the pixel, row by row from the top."""


@dataclass(frozen=True, slots=True)
class _Edges:
    """The sides of faces, each from its upper (then left) end; arrays are (faces, 3)."""

    x: Floats
    y: Floats
    dx: Floats
    dy: Floats
    """Turned so that the edge function is positive inside."""
    owns: Bools
    """Whether pixels on the edge are the face's own: a top or left one."""
    reach: Floats
    """Where rounding may move the edge: up to this value of the edge function."""


@dataclass(frozen=True, slots=True)
class _Spans:
    """Stretches of pixels in a row, to be tried for a face."""

    face: Ints
    y: Ints
    start: Ints
    length: Ints

    def part(self, begin: int, end: int) -> _Spans:
        return _Spans(*(getattr(self, name)[begin:end] for name in self.__slots__))


def fragments_of(faces: Faces, rules: RasterRules) -> tuple[Fragments, Bools]:
    """What the faces cover; and for each pixel whether that hangs on rounding."""
    edges = _edges(faces)
    unsure = np.zeros(rules.width * rules.height, dtype=np.bool_)
    found: list[Fragments] = []
    spans = _spans(faces, edges, rules)
    for part in _portions(spans):
        face = np.repeat(part.face, part.length)
        before = np.cumsum(part.length) - part.length
        x = np.arange(len(face)) + np.repeat(part.start - before, part.length)
        pixel = np.repeat(part.y * rules.width, part.length) + x
        covered, close = _tried(edges, part, face, x + 0.5)
        unsure[pixel[close]] = True
        found.append(Fragments(face[covered], pixel[covered]))
    if not found:
        none = np.zeros(0, dtype=np.int64)
        return Fragments(none, none), unsure
    joined = Fragments(
        np.concatenate([part.face for part in found]),
        np.concatenate([part.pixel for part in found]),
    )
    return joined, unsure


def _edges(faces: Faces) -> _Edges:
    x, y = faces.x, faces.y
    to_x, to_y = np.roll(x, -1, axis=1), np.roll(y, -1, axis=1)
    swapped = (to_y < y) | ((to_y == y) & (to_x < x))
    from_x, from_y = np.where(swapped, to_x, x), np.where(swapped, to_y, y)
    # Clockwise on the screen (y down), the edge function of the way round is positive inside.
    turn = np.where(swapped != (faces.area < 0)[:, None], -1.0, 1.0)
    dx = turn * np.where(swapped, x - to_x, to_x - x)
    dy = turn * np.abs(to_y - y)
    unsure = np.maximum(faces.unsure, np.roll(faces.unsure, -1, axis=1))
    owns = (dy < 0) | ((dy == 0) & (dx > 0))
    return _Edges(from_x, from_y, dx, dy, owns, unsure * np.hypot(dx, dy))


def _spans(faces: Faces, edges: _Edges, rules: RasterRules) -> _Spans:
    """For every face the rows it may touch, and in each the pixels between its edges."""
    slack = faces.unsure.max(axis=1, initial=0.0)
    left = _clamped(np.ceil(faces.x.min(axis=1) - slack - 0.5), 0, rules.width)
    right = _clamped(np.floor(faces.x.max(axis=1) + slack + 0.5), 0, rules.width)
    top = _clamped(np.ceil(faces.y.min(axis=1) - slack - 0.5), 0, rules.height)
    bottom = _clamped(np.floor(faces.y.max(axis=1) + slack + 0.5), 0, rules.height)
    rows = np.where(right > left, np.maximum(bottom - top, 0), 0)
    face = np.repeat(np.arange(len(rows)), rows)
    y = np.arange(len(face)) + np.repeat(top - np.cumsum(rows) + rows, rows)
    begin, end = _between(edges, face, y + 0.5)
    start = np.maximum(left[face], _clamped(np.floor(begin) - 1, 0, rules.width))
    stop = np.minimum(right[face], _clamped(np.ceil(end) + 1, 0, rules.width))
    some = stop > start
    return _Spans(face[some], y[some], start[some], (stop - start)[some])


def _clamped(places: Floats, low: int, high: int) -> Ints:
    return np.clip(places, low, high).astype(np.int64)


def _between(edges: _Edges, face: Ints, y: Floats) -> tuple[Floats, Floats]:
    """Where the row through ``y`` enters and leaves each face, give or take rounding."""
    begin, end = np.full(len(face), -np.inf), np.full(len(face), np.inf)
    for side in range(3):
        dx, dy = edges.dx[face, side], edges.dy[face, side]
        reach = np.abs(edges.reach[face, side] / dy)
        crossing = edges.x[face, side] + dx * (y - edges.y[face, side]) / dy
        begin = np.where(dy < 0, np.maximum(begin, crossing - reach), begin)
        end = np.where(dy > 0, np.minimum(end, crossing + reach), end)
    return begin, end


def _portions(spans: _Spans) -> Iterator[_Spans]:
    """The spans, some at a time."""
    total = np.cumsum(spans.length)
    begin = 0
    while begin < len(total):
        done = total[begin - 1] if begin else 0
        end = max(int(np.searchsorted(total, done + _CANDIDATES, "right")), begin + 1)
        yield spans.part(begin, end)
        begin = end


def _tried(edges: _Edges, spans: _Spans, face: Ints, x: Floats) -> tuple[Bools, Bools]:
    """For each candidate, whether it is covered, and whether rounding may change that."""
    covered = np.ones(len(x), dtype=np.bool_)
    beside = np.ones(len(x), dtype=np.bool_)
    close = np.zeros(len(x), dtype=np.bool_)
    for side in range(3):
        along = edges.dx[spans.face, side] * (spans.y + 0.5 - edges.y[spans.face, side])
        value = np.repeat(along, spans.length)
        value -= edges.dy[face, side] * (x - edges.x[face, side])
        covered &= (value > 0) | ((value == 0) & edges.owns[face, side])
        reach = edges.reach[face, side]
        beside &= value >= -reach
        close |= (np.abs(value) <= reach) & (reach > 0)
    return covered, close & beside

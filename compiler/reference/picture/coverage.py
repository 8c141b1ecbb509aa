"""Finds the samples that a face covers, with edge functions and the top-left rule.

``drawing.py`` calls ``coverage_of``. If vertices are snapped to a grid, the edge functions are
exact. Otherwise an edge that two faces share is still evaluated in the same direction for both, so
that no sample on it is drawn twice or never. Source: Pineda, "A parallel algorithm for polygon
rasterization", 1988.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...budget import holding
from .faces import Faces
from .samples import Location, locations
from .scene import Bools, Floats, Ints, RasterRules

_OF_A_ROW = 150
"""Bytes for each row of pixels of a face, while those are found that it covers."""
_OF_A_FRAGMENT = 120
"""Bytes for each pixel that a face may cover: its place, its depths, and its colours."""
_OF_A_SHADE = 110
"""Bytes for each target that such a pixel is drawn to: four lanes with their ends."""
_CANDIDATES = 1 << 18
"""The number of pixels tested at once."""


@dataclass(frozen=True, slots=True)
class Fragments:
    """Pairs of a face and a sample that it covers.

    In a picture with one sample for each pixel, a pair is a fragment; where there are several
    samples, the pairs of one face and pixel together are a fragment.
    """

    face: Ints
    """The faces in ascending order, which is the order of drawing."""
    sample: Ints
    """The numbers of the samples."""

    def only(self, which: Bools | Ints | slice) -> Fragments:
        """The fragments that ``which`` selects."""
        return Fragments(self.face[which], self.sample[which])

    def of(self, faces: Ints) -> Fragments:
        """The fragments of some faces as those of all faces.

        ``faces`` are the numbers of these faces among all.
        """
        return Fragments(faces[self.face], self.sample)


@dataclass(frozen=True, slots=True)
class Coverage:
    """The samples that faces cover, and where rounding may change that."""

    fragments: Fragments
    certain: Bools
    """(fragments,): which of them every device has."""
    doubtful: Fragments
    """The fragments that a device may have or not, whether they are among ``fragments`` or not."""

    def in_order(self) -> tuple[Fragments, Bools]:
        """All fragments that any device has, each once, in drawing order; and which are certain."""
        sure = self.certain
        every = joined([self.fragments.only(sure), self.doubtful])
        order = np.argsort(every.face, kind="stable")
        certain: Bools = order < int(sure.sum())
        return every.only(order), certain


@dataclass(frozen=True, slots=True)
class _Edges:
    """The edges of faces, each from its upper (or else left) end; arrays are (faces, sides)."""

    x: Floats
    y: Floats
    dx: Floats
    dy: Floats
    """The height, with the sign that makes the edge function positive inside."""
    owns: Bools
    """True if the face owns pixels that are exactly on the edge.

    These are top or left edges, or on some devices bottom or left edges.
    """
    reach: Floats
    """The value of the edge function up to which rounding may move the edge."""


@dataclass(frozen=True, slots=True)
class _Spans:
    """Ranges of pixels in a row that have to be tested for a face."""

    face: Ints
    y: Ints
    start: Ints
    length: Ints

    def part(self, begin: int, end: int) -> _Spans:
        return _Spans(*(getattr(self, name)[begin:end] for name in self.__slots__))


def coverage_within(faces: Faces, some: Ints, rules: RasterRules, targets: int) -> Coverage:
    """The coverage of some faces only, with these numbers in ascending order."""
    if len(some) == len(faces.area):
        return coverage_of(faces, rules, targets)
    found = coverage_of(faces.only(some), rules, targets)
    return Coverage(found.fragments.of(some), found.certain, found.doubtful.of(some))


def coverage_of(faces: Faces, rules: RasterRules, targets: int = 1) -> Coverage:
    """The samples that faces cover, of which each is shaded for so many targets.

    Raises ``BudgetError`` where they are too many.
    """
    edges = _edges(faces, rules)
    found, candidates = [], 0
    for number, at in enumerate(locations(rules)):
        spans = _spans(faces, edges, rules, at)
        candidates += int(spans.length.sum())
        _check_memory(len(spans.face), candidates, targets)
        for part in _portions(spans):
            found.append(_covered(faces, edges, part, rules, number, at))
    fragments = joined([part.fragments for part in found])
    certain = np.concatenate([np.zeros(0, np.bool_), *(part.certain for part in found)])
    doubtful = joined([part.doubtful for part in found])
    if rules.samples > 1:
        order = np.argsort(fragments.face, kind="stable")
        fragments, certain = fragments.only(order), certain[order]
    return Coverage(fragments, certain, doubtful)


def _check_memory(rows: int, candidates: int, targets: int) -> None:
    """Raise ``BudgetError`` for more pixels than memory has room for, drawn over each other."""
    size = rows * _OF_A_ROW + candidates * (_OF_A_FRAGMENT + targets * _OF_A_SHADE)
    with holding(size, "what is drawn over each other needs"):
        return


def has_level_edges(faces: Faces, rules: RasterRules) -> bool:
    """True if a sample may lie exactly on a level edge.

    Then it matters which of two faces owns it.
    """
    x, y = faces.x, faces.y
    to_x, to_y = np.roll(x, -1, axis=1), np.roll(y, -1, axis=1)
    is_level = (y == to_y) & (x != to_x)
    begin, end, row = np.minimum(x, to_x)[is_level], np.maximum(x, to_x)[is_level], y[is_level]
    return any(
        bool(((row % 1.0 == at.y) & (np.ceil(begin - at.x) <= np.floor(end - at.x))).any())
        for at in locations(rules)
    )


def _covered(
    faces: Faces, edges: _Edges, spans: _Spans, rules: RasterRules, number: int, at: Location
) -> Coverage:
    """The pixels of some spans at which the sample with this number is covered."""
    face = np.repeat(spans.face, spans.length)
    before = np.cumsum(spans.length) - spans.length
    column = np.arange(len(face)) + np.repeat(spans.start - before, spans.length)
    row = np.repeat(spans.y, spans.length)
    x, y = np.asarray(column + at.x, np.float64), np.asarray(row + at.y, np.float64)
    covered, close = faces.settled(face, (x, y), *_tried(edges, spans, face, x, at))
    every = Fragments(face, (row * rules.width + column) * rules.samples + number)
    return Coverage(every.only(covered), np.asarray(~close[covered]), every.only(close))


def joined(parts: Sequence[Fragments]) -> Fragments:
    """Several fragments in their order."""
    none = np.zeros(0, np.int64)
    return Fragments(
        np.concatenate([none, *(part.face for part in parts)]),
        np.concatenate([none, *(part.sample for part in parts)]),
    )


def _edges(faces: Faces, rules: RasterRules) -> _Edges:
    x, y = faces.x, faces.y
    to_x, to_y = np.roll(x, -1, axis=1), np.roll(y, -1, axis=1)
    swapped = (to_y < y) | ((to_y == y) & (to_x < x))
    from_x, from_y = np.where(swapped, to_x, x), np.where(swapped, to_y, y)
    # If the corners are clockwise on the screen (y downwards), the edge function is positive
    # inside.
    turn = np.where(swapped != (faces.area < 0)[:, None], -1.0, 1.0)
    dx = turn * np.where(swapped, x - to_x, to_x - x)
    dy = turn * np.abs(to_y - y)
    level_owns = dx < 0 if rules.owns_bottom else dx > 0
    owns = (dy < 0) | ((dy == 0) & level_owns)
    return _Edges(from_x, from_y, dx, dy, owns, faces.unsure * np.hypot(dx, dy))


def _spans(faces: Faces, edges: _Edges, rules: RasterRules, at: Location) -> _Spans:
    """The rows of samples that each face may touch, and the pixels between its edges."""
    slack = faces.unsure.max(axis=1, initial=0.0)
    first, upper, last, lower = rules.drawn
    left = _clamped(np.ceil(faces.x.min(axis=1) - slack - at.x), first, last)
    right = _clamped(np.floor(faces.x.max(axis=1) + slack + (1.0 - at.x)), first, last)
    top = _clamped(np.ceil(faces.y.min(axis=1) - slack - at.y), upper, lower)
    bottom = _clamped(np.floor(faces.y.max(axis=1) + slack + (1.0 - at.y)), upper, lower)
    rows = np.where(right > left, np.maximum(bottom - top, 0), 0)
    _check_memory(int(rows.sum()), 0, 0)
    face = np.repeat(np.arange(len(rows)), rows)
    y = np.arange(len(face)) + np.repeat(top - np.cumsum(rows) + rows, rows)
    begin, end = _between(edges, face, y + at.y)
    start = np.maximum(left[face], _clamped(np.floor(begin) - 1, first, last))
    stop = np.minimum(right[face], _clamped(np.ceil(end) + 1, first, last))
    some = stop > start
    return _Spans(face[some], y[some], start[some], (stop - start)[some])


def _clamped(places: Floats, low: int, high: int) -> Ints:
    return np.clip(places, low, high).astype(np.int64)


def _between(edges: _Edges, face: Ints, y: Floats) -> tuple[Floats, Floats]:
    """The ends of the row through ``y`` within each face, with room for rounding."""
    begin, end = np.full(len(face), -np.inf), np.full(len(face), np.inf)
    for side in range(edges.x.shape[1]):
        dx, dy = edges.dx[face, side], edges.dy[face, side]
        reach = np.abs(edges.reach[face, side] / dy)
        crossing = edges.x[face, side] + dx * (y - edges.y[face, side]) / dy
        begin = np.where(dy < 0, np.maximum(begin, crossing - reach), begin)
        end = np.where(dy > 0, np.minimum(end, crossing + reach), end)
    return begin, end


def _portions(spans: _Spans) -> Iterator[_Spans]:
    """The spans in portions of limited size."""
    total = np.cumsum(spans.length)
    begin = 0
    while begin < len(total):
        done = total[begin - 1] if begin else 0
        end = max(int(np.searchsorted(total, done + _CANDIDATES, "right")), begin + 1)
        yield spans.part(begin, end)
        begin = end


def _tried(
    edges: _Edges, spans: _Spans, face: Ints, x: Floats, at: Location
) -> tuple[Bools, Bools]:
    """Tells of each candidate whether it is covered, and whether rounding may change this."""
    covered = np.ones(len(x), dtype=np.bool_)
    beside = np.ones(len(x), dtype=np.bool_)
    close = np.zeros(len(x), dtype=np.bool_)
    for side in range(edges.x.shape[1]):
        along = edges.dx[spans.face, side] * (spans.y + at.y - edges.y[spans.face, side])
        value = np.repeat(along, spans.length)
        value -= edges.dy[face, side] * (x - edges.x[face, side])
        covered &= (value > 0) | ((value == 0) & edges.owns[face, side])
        reach = edges.reach[face, side]
        beside &= value >= -reach
        close |= (np.abs(value) <= reach) & (reach > 0)
    return covered, close & beside

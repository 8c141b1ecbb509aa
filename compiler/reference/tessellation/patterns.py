"""The points of a patch and the triangles or lines between them, for each kind of patch."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate

from ...ir.tessellation import MOST_LEVEL, Patch, Spacing
from .levels import ONE, EdgeSteps, steps_of
from .stitching import Row, Triangle, between_levels, between_rings

Place = tuple[int, int, int]

_THIRD = ONE // 3
_CENTRE = (_THIRD, _THIRD, ONE - 2 * _THIRD)


@dataclass(frozen=True, slots=True)
class Pattern:
    """A patch divided."""

    places: Sequence[Place]
    """The place of each point, in units of 2^-16.

    They are the weights of a triangle's corners, which add up to ``ONE``; or u and v of a square,
    and 0.
    """
    cells: Sequence[tuple[int, ...]]
    """The triangles or lines, as numbers of points.

    Triangles turn counter-clockwise where u points to the right and v upwards, or where a
    triangle's corners do so.
    """


_NOTHING = Pattern((), ())


def divided(
    patch: Patch, edges: Sequence[float], inside: Sequence[float], spacing: Spacing
) -> Pattern:
    """The pattern of a patch of some kind.

    The levels are those of its edges and of its inside, in the order of the control stage's
    results.
    """
    match patch:
        case "triangle":
            return triangle(edges, inside[0], spacing)
        case "quad":
            return quad(edges, inside, spacing)
        case "isoline":
            lines, segments = edges
            return isolines(lines, segments, spacing)


def triangle(edges: Sequence[float], inside: float, spacing: Spacing) -> Pattern:
    """A triangle; the levels are those of the edges across from its corners, and of the inside."""
    found = steps_of(spacing, edges, (inside,))
    if found is None:
        return _NOTHING
    outer, (inner,) = found
    if _is_undivided(outer, inner):
        return Pattern(((0, ONE, 0), (0, 0, ONE), (ONE, 0, 0)), ((0, 1, 2),))
    patch = _Patch([_edge_of_triangle(e, steps, 0, 0) for e, steps in enumerate(outer)])
    for ring in range(1, (inner.count + 1) // 2):
        if 2 * ring == inner.count - 1:
            rows = [[_CENTRE]] * 3
        else:
            off = (inner.place(ring) * 2 * _THIRD + ONE // 2) // ONE
            rows = [_edge_of_triangle(e, inner, ring, off) for e in range(3)]
        patch.add_ring(rows, outer, [inner] * 3)
    if inner.is_odd:
        patch.cells.append(tuple(row[0] for row in patch.rows))
    return patch.pattern


def quad(edges: Sequence[float], inside: Sequence[float], spacing: Spacing) -> Pattern:
    """The pattern of a square.

    The levels are those of the edges u = 0, v = 0, u = 1 and v = 1, and of the inside along u and
    along v.
    """
    found = steps_of(spacing, edges, inside)
    if found is None:
        return _NOTHING
    outer, (along_u, along_v) = found
    if _is_undivided(outer, along_u, along_v):
        corners = ((0, 0, 0), (ONE, 0, 0), (ONE, ONE, 0), (0, ONE, 0))
        return Pattern(corners, ((0, 1, 3), (1, 2, 3)))
    left, below, right, above = (_places(s, 0, falls=e in (0, 3)) for e, s in enumerate(outer))
    patch = _Patch([
        [(0, v, 0) for v in left], [(u, 0, 0) for u in below],
        [(ONE, v, 0) for v in right], [(u, ONE, 0) for u in above],
    ])  # fmt: skip
    rings = (min(along_u.count, along_v.count) + 1) // 2
    for ring in range(1, rings):
        us, vs = (_places(steps, ring) for steps in (along_u, along_v))
        patch.add_ring(
            [[(us[0], v, 0) for v in reversed(vs)], [(u, vs[0], 0) for u in us],
             [(us[-1], v, 0) for v in vs], [(u, vs[-1], 0) for u in reversed(us)]],
            outer, [along_v, along_u] * 2,
        )  # fmt: skip
    if min(along_u.count, along_v.count) % 2 == 0:
        patch.cells += _row_of_squares(*patch.rows)
    return patch.pattern


def isolines(lines: float, segments: float, spacing: Spacing) -> Pattern:
    """Lines along u, the first one at v = 0, each of so many segments."""
    found = steps_of(spacing, (segments,), ())
    if found is None or not lines > 0:
        return _NOTHING
    ((along,), _), count = found, math.ceil(min(max(lines, 1), MOST_LEVEL))
    rows = EdgeSteps(count, "equal")
    places = [
        (along.place(i), rows.place(row), 0) for row in range(count) for i in range(along.count)
    ]
    starts = (row * along.count + i for row in range(count) for i in range(along.count - 1))
    return Pattern(places, [(start, start + 1) for start in starts])


def _is_undivided(outer: Sequence[EdgeSteps], *inner: EdgeSteps) -> bool:
    return all(steps.count == 2 for steps in (*outer, *inner))


def _places(steps: EdgeSteps, ring: int, *, falls: bool = False) -> list[int]:
    """The places of a row that begins and ends so many steps away from the edges."""
    places = [steps.place(number) for number in range(ring, steps.count - ring)]
    return places[::-1] if falls else places


def _edge_of_triangle(edge: int, steps: EdgeSteps, ring: int, off: int) -> list[Place]:
    """A row of points that are ``off`` from an edge of a triangle.

    Moving away from an edge, a point comes closer to both others by half as much.
    """
    found: list[Place] = []
    for place in _places(steps, ring, falls=edge != 1):
        along = place - (off + 1) // 2
        rest = ONE - along - off
        found.append([(off, along, rest), (along, off, rest), (along, rest, off)][edge])
    return found


def _row_of_squares(left: Row, below: Row, right: Row, above: Row) -> list[Triangle]:
    """The middle of a square, where one pair of rows faces each other with a single step between.

    A row along v is cut in the other direction, but for the square in its middle, and begins at its
    end.
    """
    lies = len(below) > len(left)
    lower, upper = (below, above[::-1]) if lies else (left[::-1], right)
    squares, found = len(lower) - 1, list[Triangle]()
    for i in range(squares) if lies else reversed(range(squares)):
        a, b, c, d = lower[i], lower[i + 1], upper[i + 1], upper[i]
        if lies:
            found += [(d, a, b), (d, b, c)]
        elif 2 * i + 1 == squares:
            found += [(b, d, c), (b, a, d)]
        elif squares % 2 == 1:
            found += [(b, a, c), (c, a, d)]
        else:
            found += [(c, b, a), (c, a, d)]
    return found


class _Patch:
    """A patch while it is filled with rings of rows from outside to inside."""

    def __init__(self, rows: Sequence[Sequence[Place]]) -> None:
        """``rows`` are the points of its edges; each ends where the next one begins."""
        self._places: list[Place] = []
        self.cells: list[tuple[int, ...]] = []
        self.rows: list[Row] = self._added(rows)
        """The numbers of the points of the innermost ring."""
        self._is_outermost = True

    @property
    def pattern(self) -> Pattern:
        """The pattern that has been made so far."""
        return Pattern(self._places, self.cells)

    def add_ring(
        self,
        rows: Sequence[Sequence[Place]],
        outer: Sequence[EdgeSteps],
        inner: Sequence[EdgeSteps],
    ) -> None:
        """Fill the space up to the next ring; the levels count behind the edges of the patch."""
        added = self._added(rows)
        for before, row, edge, inside in zip(self.rows, added, outer, inner, strict=True):
            if self._is_outermost:
                self.cells += between_levels(before, row, edge, inside)
            else:
                self.cells += between_rings(before, row)
        self.rows, self._is_outermost = added, False

    def _added(self, rows: Sequence[Sequence[Place]]) -> list[Row]:
        """The numbers of new points; a ring may be so narrow that rows go over the same ones."""
        numbers: dict[Place, int] = {}
        start = len(self._places)
        if any(len(row) == 1 for row in rows):
            for row in rows:
                for place in row:
                    numbers.setdefault(place, start + len(numbers))
            self._places += numbers
            return [[numbers[place] for place in row] for row in rows]
        counts = [len(row) - 1 for row in rows]
        total = sum(counts)
        self._places += [place for row in rows for place in row[:-1]]
        firsts = accumulate(counts[:-1], initial=0)
        return [
            [start + (first + i) % total for i in range(count + 1)]
            for first, count in zip(firsts, counts, strict=True)
        ]

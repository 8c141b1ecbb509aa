"""The patches of a mesh, and the pattern into which each of them is divided.

``expanded_draws.py`` draws with them. A mesh may say which control points its patches have.
Otherwise its triangles and edges are patches, and its grids have patches of any number of points.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from math import isqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.ir.tessellation import PATCH_KINDS, Patch, Spacing
from ...compiler.ir.types import width
from ...compiler.reference.tessellation import ONE, divided
from .meshes import Indices, Mesh, MeshError
from .primitives import primitives


def patches(mesh: Mesh, kind: Patch, points: int, ends: Sequence[int]) -> Indices:
    """The control points of each patch, (patches, points). Raises ``MeshError``."""
    if mesh.patches is not None:
        if mesh.patches.shape[1] != points:
            raise MeshError(
                f"the patches of the mesh have {mesh.patches.shape[1]} control points, and this "
                f"material divides patches of {points}"
            )
        found = mesh.patches
    elif mesh.lattices and (of_a_grid := _of_grids(kind, points)) is not None:
        found = np.concatenate([of_a_grid(each, points, ends) for each in mesh.lattices])
    elif points == PATCH_KINDS[kind].ends:
        found = _MADE[kind](mesh)
    else:
        raise MeshError(
            f"this material divides patches of {points} control points, and the mesh has none"
        )
    if not len(found):
        raise MeshError(f"the mesh has no {kind} patch to divide")
    return found


def pattern(
    kind: Patch, spacing: Spacing, edges: Sequence[float], inside: Sequence[float]
) -> tuple[NDArray[Any], Indices]:
    """The points of a divided patch, in its own coordinates, and its triangles or lines."""
    found = divided(kind, edges, inside, spacing)
    row = PATCH_KINDS[kind]
    lanes = width(row.coordinate.type)
    places = np.array(found.places, np.float64).reshape(-1, 3)[:, :lanes] / ONE
    return places, np.array(found.cells, np.int64).reshape(-1, row.cell)


_Place = tuple[int, int]
"""The row and the column of a vertex of a grid."""

_OfGrid = Callable[[Indices, int, Sequence[int]], Indices]
"""Makes the patches of a grid with a number of points, some of which are their ends."""


def _of_grids(kind: Patch, points: int) -> _OfGrid | None:
    """The function that makes patches of grids; ``None`` if triangles or edges are such patches."""
    if kind == "quad":
        return _windows if isqrt(points) ** 2 == points else _between_corners
    if points == PATCH_KINDS[kind].ends:
        return None
    return _halves if kind == "triangle" else _runs


def _windows(lattice: Indices, points: int, ends: Sequence[int]) -> Indices:
    """Squares of vertices of a grid, row by row, which lie so that neighbours share their ends.

    Four points go round, as ends do.
    """
    side = isqrt(points)
    step = 1 if points == len(ends) else _distance(side, ends[0], ends[1])
    whole = np.array([each.reshape(-1) for each in _squares(lattice, side, step)], np.int64)
    return whole[:, [0, 1, 3, 2]] if points == len(ends) else whole


def _between_corners(lattice: Indices, points: int, ends: Sequence[int]) -> Indices:
    """Squares of a grid whose corners are the ends, and as many of the vertices between these, row
    by row, as there are other points."""
    side = isqrt(points) + 1
    places = [(row, column) for row in range(side) for column in range(side)]
    corners = [(0, 0), (0, side - 1), (side - 1, side - 1), (side - 1, 0)]
    rows, columns = np.array(_placed(points, ends, corners, places)).T
    squares = [each[rows, columns] for each in _squares(lattice, side, side - 1)]
    return np.array(squares, np.int64).reshape(-1, points)


def _halves(lattice: Indices, points: int, ends: Sequence[int]) -> Indices:
    """The two halves of each square of a grid, as triangles whose neighbours share their edges.

    If the ends are those of a triangle that is written row by row, each row shorter by one, the
    points lie so. Otherwise the points that are no ends follow each other along the edges, from the
    first end on, and behind them come those inside. What has no point then is left out.
    """
    steps = _steps(points)
    rows = [(row, column) for row in range(steps + 1) for column in range(steps + 1 - row)]
    corners = [(0, 0), (0, steps), (steps, 0)]
    places = rows
    if len(rows) != points or {rows.index(corner) for corner in corners} != set(ends):
        edges = [(0, k) for k in range(1, steps)]
        edges += [(k, steps - k) for k in range(1, steps)]
        edges += [(steps - k, 0) for k in range(1, steps)]
        inside = [place for place in rows if place not in edges]
        places = _placed(points, ends, corners, [*edges, *inside])
    row, column = np.array(places).T
    squares = list(_squares(lattice, steps + 1, steps))
    halves = [half[row, column] for each in squares for half in (each, each[::-1, ::-1])]
    return np.array(halves, np.int64).reshape(-1, points)


def _placed(
    points: int, ends: Sequence[int], corners: Sequence[_Place], others: Iterable[_Place]
) -> list[_Place]:
    """The position of each point: the ends at the corners, and the others one after the other."""
    left = (place for place in others if place not in corners)
    at_end = dict(zip(ends, corners, strict=True))
    return [at_end.get(number) or next(left) for number in range(points)]


def _runs(lattice: Indices, points: int, ends: Sequence[int]) -> Indices:
    """Vertices that follow each other in a row of a grid; neighbours share their ends."""
    step = max(abs(ends[1] - ends[0]), 1)
    across = lattice.shape[1]
    columns = [np.arange(start, start + points) for start in _starts(across, points, step)]
    found = [row[np.minimum(run, across - 1)] for row in lattice for run in columns]
    return np.array(found, np.int64).reshape(-1, points)


def _steps(points: int) -> int:
    """The number of steps of each edge of a triangle that has room for this number of points."""
    return (isqrt(8 * points - 7) - 1) // 2


def _squares(lattice: Indices, side: int, step: int) -> Iterator[Indices]:
    """Squares of vertices of a grid. Beyond the border of a small grid its last vertices repeat."""
    offsets = np.arange(side)
    for row in _starts(len(lattice), side, step):
        for start in _starts(lattice.shape[1], side, step):
            rows = np.minimum(row + offsets, len(lattice) - 1)
            yield lattice[np.ix_(rows, np.minimum(start + offsets, lattice.shape[1] - 1))]


def _distance(side: int, one: int, other: int) -> int:
    """The distance of two points of a square along a row or a column; 1 if they are one point."""
    (row, column), (other_row, other_column) = divmod(one, side), divmod(other, side)
    return max(abs(other_row - row), abs(other_column - column), 1)


def _starts(count: int, side: int, step: int) -> Iterator[int]:
    yield from range(0, max(count - side, 0) + 1, step)


def _triangles(mesh: Mesh) -> Indices:
    return mesh.triangles


def _lines(mesh: Mesh) -> Indices:
    return primitives(mesh, "line")


def _quads(mesh: Mesh) -> Indices:
    """Two triangles that follow each other and share an edge, as one quad that goes round both."""
    if len(mesh.triangles) % 2:
        raise MeshError("the triangles of the mesh are no pairs, so they make no quads")
    return np.array([_quad(*pair) for pair in mesh.triangles.reshape(-1, 2, 3)]).reshape(-1, 4)


def _quad(one: Indices, other: Indices) -> Indices:
    """The four corners of two triangles, in order, from the corner that only the first one has."""
    alone = [k for k in range(3) if one[k] not in other]
    beyond = [vertex for vertex in other if vertex not in one]
    if len(alone) != 1 or len(beyond) != 1:
        raise MeshError(
            f"the triangles {list(map(int, one))} and {list(map(int, other))} share no edge, so "
            f"they make no quad"
        )
    start, following, last = np.roll(one, -alone[0])
    return np.array([start, following, beyond[0], last])


_MADE: Mapping[Patch, Callable[[Mesh], Indices]] = {
    "triangle": _triangles,
    "quad": _quads,
    "isoline": _lines,
}
"""Makes patches of the primitives that a mesh has anyway."""

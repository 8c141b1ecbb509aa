"""Finds the points, lines and triangles of a mesh, with the vertices next to them.

``expanded_draws.py`` draws with them where a material says what each of them turns into.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from .meshes import Indices, Mesh

PRIMITIVES: Mapping[str, Callable[[Mesh], Indices]]
"""Makes the primitives of each kind: the vertices at their corners, (primitives, corners)."""


_DECIMALS = 5
"""Decimals of positions up to which vertices are in one place; meshes here are about one in
size."""


def primitives(mesh: Mesh, kind: str) -> Indices:
    """The primitives of a mesh, in the order in which its triangles first have them."""
    return PRIMITIVES[kind](mesh)


def _points(mesh: Mesh) -> Indices:
    """Each vertex that a triangle has, once; of a mesh without triangles, each vertex."""
    if not len(mesh.triangles):
        return np.arange(len(mesh))[:, None]
    return _first(mesh.triangles.reshape(-1, 1), mesh.triangles.reshape(-1, 1))


def _lines(mesh: Mesh) -> Indices:
    """Each edge once, in the direction of the first triangle that has it.

    Vertices that lie in one place are one end: a mesh repeats them where a texture has a seam.
    """
    edges = _edges(mesh.triangles)
    return _first(edges, np.sort(_places(mesh)[edges], axis=1))


def _triangles(mesh: Mesh) -> Indices:
    return mesh.triangles


def _lines_between(mesh: Mesh) -> Indices:
    """Each edge between the vertices across it, of the two triangles that share it."""
    across = _across(mesh)
    edges = _edges(mesh.triangles)
    opposite = np.roll(mesh.triangles, 1, axis=1).reshape(-1, 1)
    lines = np.concatenate([opposite, edges, across.reshape(-1, 1)], axis=1)
    return _first(lines, np.sort(_places(mesh)[edges], axis=1))


def _triangles_between(mesh: Mesh) -> Indices:
    """Each triangle with the vertices across its edges; each follows the beginning of its edge."""
    return np.stack([mesh.triangles, _across(mesh)], axis=2).reshape(-1, 6)


PRIMITIVES = {
    "point": _points,
    "line": _lines,
    "triangle": _triangles,
    "line_adjacency": _lines_between,
    "triangle_adjacency": _triangles_between,
}


def _edges(triangles: Indices) -> Indices:
    """All edges of all triangles, three of each: (3 * triangles, 2)."""
    return np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)


def _across(mesh: Mesh) -> Indices:
    """For each edge of each triangle, the vertex of the next triangle that is not on the edge.

    Where there is none it is the triangle's own, as if the triangle had a back.
    """
    places, edges = _places(mesh), _edges(mesh.triangles)
    opposite = np.roll(mesh.triangles, 1, axis=1).reshape(-1)
    begins, ends = places[edges].T
    beyond = {
        (int(begin), int(end)): int(vertex)
        for begin, end, vertex in zip(begins[::-1], ends[::-1], opposite[::-1], strict=True)
    }
    found = [
        beyond.get((int(end), int(begin)), int(own))
        for begin, end, own in zip(begins, ends, opposite, strict=True)
    ]
    return np.array(found, np.int64).reshape(-1, 3)


def _places(mesh: Mesh) -> Indices:
    """For each vertex, a number that it shares with all vertices in its place, up to rounding."""
    rounded = np.round(mesh.channels["position"], _DECIMALS) + 0.0
    _, numbers = np.unique(rounded, axis=0, return_inverse=True)
    return numbers.reshape(-1).astype(np.int64)


def _first(rows: Indices, keys: Indices) -> Indices:
    """The rows whose keys have not occurred before."""
    _, first = np.unique(keys, axis=0, return_index=True)
    return rows[np.sort(first)]

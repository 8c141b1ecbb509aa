"""Turns triangles into their edges, for passes that draw only these.

``assembly.py`` calls ``edges_of`` when triangles have been culled and moved. An edge is a line, but
what it shows is that of its triangle: the side that is seen, and the vertex whose values stay flat.
Sources: Vulkan, "Polygon Mode"; OpenGL 4.6, 14.6.4.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from .faces import CulledFaces, Faces
from .lines import LineFaces, lines_of
from .scene import Bools, Floats, Ints, RasterRules

_ENDS = np.array([[0, 1], [1, 2], [2, 0]])
"""The corners of a triangle between which each edge lies, in the order in which they are drawn."""
_CORNERS = np.array([[0, 1, 0], [1, 2, 1], [2, 0, 2]])
"""The corners of the plane through each edge, as ``lines.py`` has them."""


@dataclass(frozen=True, slots=True)
class EdgeFaces(LineFaces):
    """Edges of triangles."""

    between: Ints
    """(faces, 2): the vertices at the ends, the one with the lower number first."""
    hidden: Bools
    """(faces,): whether the reference does not draw it."""
    doubtful: Bools
    """(faces,): whether rounding decides if it is drawn at all."""

    def settled(
        self, face: Ints, place: tuple[Floats, Floats], covered: Bools, close: Bools
    ) -> tuple[Bools, Bools]:
        # The shortest form of super() does not know classes with slots.
        covered, close = LineFaces.settled(self, face, place, covered, close)
        drawn: Bools = covered & ~self.hidden[face]
        return drawn, close | (covered & self.doubtful[face])


def edges_of(
    faces: Faces,
    unmoved: Faces,
    positions: Floats,
    rules: RasterRules,
    of_vertices: Floats,
) -> Faces:
    """The edges of triangles whose vertices have these clip positions, (vertices, 4).

    ``faces`` are the drawn parts of the triangles, and ``unmoved`` the same without a bias.
    """
    _, first = np.unique(faces.primitive, return_index=True)
    triangles, seen = faces.corners[first], faces.only(_mask(first, len(faces.corners)))
    before = unmoved.only(_mask(first, len(faces.corners)))
    lines = triangles[:, _ENDS].reshape(-1, 2)
    edges = lines_of(positions, lines, rules, of_vertices)
    assert isinstance(edges, LineFaces)
    triangle, number = edges.primitive // len(_ENDS), edges.primitive % len(_ENDS)
    hidden = doubtful = np.zeros(len(triangles), np.bool_)
    if isinstance(seen, CulledFaces):
        hidden, doubtful = seen.hidden, seen.may_turn
    rows = {row.name: getattr(edges, row.name) for row in fields(LineFaces)}
    own = np.eye(3)[_CORNERS[number]]
    rows |= {
        "primitive": seen.primitive[triangle],
        "corners": triangles[triangle],
        "weights": edges.weights @ own,
        "whole": np.zeros(len(triangle), np.bool_),
        "front": seen.front[triangle],
        "z": edges.z + (seen.z - before.z)[triangle, :1],
        "z_off": edges.z_off + (seen.z_off - before.z_off)[triangle],
    }
    return EdgeFaces(
        **rows,
        between=np.sort(lines[edges.primitive], axis=1),
        hidden=hidden[triangle],
        doubtful=doubtful[triangle],
    )


def _mask(chosen: Ints, count: int) -> Bools:
    mask = np.zeros(count, np.bool_)
    mask[chosen] = True
    return mask

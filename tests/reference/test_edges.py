"""Edges of triangles: which lines they are, and what each shows of its triangle."""

from __future__ import annotations

import numpy as np
import pytest

from burnish.compiler.ir.render_state import Cull, DepthState, RenderState
from burnish.compiler.reference.picture import RasterRules
from burnish.compiler.reference.picture.assembly import faces_of
from burnish.compiler.reference.picture.coverage import coverage_of
from burnish.compiler.reference.picture.edges import EdgeFaces
from burnish.compiler.reference.picture.faces import Faces

SIZE = 8
RULES = RasterRules(SIZE, SIZE, subpixel_bits=8)
SQUARE = np.array([(-0.75, 0.75), (-0.75, -0.75), (0.75, -0.75), (0.75, 0.75)])
HALVES = np.array([[0, 1, 2], [0, 2, 3]])
"""Two triangles, both counter-clockwise, which have the edge from 0 to 2 in common."""


def edges(triangles: np.ndarray, state: RenderState, depth: float = 0.5) -> Faces:
    """The edges of triangles between the corners of a square."""
    rest = np.broadcast_to([depth, 1.0], (len(SQUARE), 2))
    return faces_of(np.concatenate([SQUARE, rest], axis=1), triangles, RULES, state=state)


LINES = RenderState(fill="lines")


def test_a_triangle_has_three_edges_in_order() -> None:
    found = edges(HALVES[:1], LINES)
    assert isinstance(found, EdgeFaces)
    assert found.between.tolist() == [[0, 1], [1, 2], [0, 2]]
    # Values are interpolated between the ends of each, and flat ones are those of the first corner.
    assert found.corners.tolist() == [[0, 1, 2]] * 3
    weights = found.weights.argmax(axis=2)
    assert weights.tolist() == [[0, 1, 0], [1, 2, 1], [2, 0, 2]]


def test_what_they_cover() -> None:
    """The square goes from pixel 1 to pixel 7, so lines pass by the pixels 1 or 6, and the middle
    is empty but for the diagonal."""
    with np.errstate(all="ignore"):
        coverage = coverage_of(edges(HALVES, LINES), RULES)
    drawn = np.zeros(SIZE * SIZE, np.bool_)
    drawn[coverage.fragments.sample] = True
    inside = np.argwhere(drawn.reshape(SIZE, SIZE)[2:6, 2:6])
    assert len(inside) == 4
    assert {abs(int(row) - int(column)) for row, column in inside} == {0}


@pytest.mark.parametrize(("cull", "count"), [("none", 6), ("back", 3), ("front", 3)])
def test_edges_of_faces_that_are_culled_are_not_drawn(cull: Cull, count: int) -> None:
    turned = np.array([[0, 1, 2], [3, 2, 0]])
    found = edges(turned, RenderState(cull=cull, fill="lines"))
    assert len(found.front) == count
    assert (
        set(found.front.tolist()) == {"none": {True, False}, "back": {True}, "front": {False}}[cull]
    )


def test_they_are_moved_as_their_triangles_are() -> None:
    bias = DepthState(bias=1 << 20)
    plain, moved = (edges(HALVES, RenderState(fill="lines", depth=depth), depth=0.75)
                    for depth in (DepthState(), bias))  # fmt: skip
    # Depths from 0.5 to 1 have steps of 2^-24.
    assert moved.z - plain.z == pytest.approx(np.full((6, 3), 2.0**-4))

"""Fills the space between two rows of points of a patch with triangles.

Rows are lists of the points' numbers, and all go round the patch in the same direction.
``patterns.py`` calls this for every side of a patch. The point that a triangle begins with is
prescribed, too: values that are not interpolated are those of this point.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...ir.tessellation import MOST_LEVEL
from .levels import EdgeSteps

Row = Sequence[int]
Triangle = tuple[int, int, int]


def _in_order(node: int, nodes: int) -> Iterator[int]:
    """The nodes of a binary tree from left to right; the children of ``n`` are 2 n and 2 n + 1."""
    if node < nodes:
        yield from _in_order(2 * node, nodes)
        yield node
        yield from _in_order(2 * node + 1, nodes)


_RANKS = (MOST_LEVEL // 2, *_in_order(1, MOST_LEVEL // 2))
"""For each step of half an edge, the number of steps that exist before it appears.

The edge is one with the most steps. Its steps stand here from the corner on, without the first one.
As the level rises, steps appear as evenly as a tree grows.
"""


def between_levels(
    outer: Row, inner: Row, edge: EdgeSteps, inside: EdgeSteps
) -> Iterator[Triangle]:
    """Triangles between an edge of the patch and the first row inside, of another level.

    Both are walked along in the order in which steps appear, so that where a row has no step, the
    other one has a triangle to the same point. ``inside`` is that of a row which goes from edge to
    edge, and has a step more at each end.
    """
    walk = _Walk(outer, inner)
    if edge.between:
        yield walk.along_outer()
    for rank in _RANKS:
        if rank < inside.between:
            yield walk.along_inner()
        if rank < edge.between:
            yield walk.along_outer()
    if inside.is_odd:
        yield walk.along_inner()
    if edge.is_odd:
        a, b, c = walk.along_outer()
        yield c, a, b
    for rank in reversed(_RANKS):
        if rank < edge.between:
            yield walk.along_outer()
        if rank < inside.between:
            yield walk.along_inner()
    if edge.between:
        yield walk.along_outer()


def between_rings(outer: Row, inner: Row) -> Iterator[Triangle]:
    """Triangles between two rows inside, of which the inner one has one step less at each end.

    The squares between them are cut from the corners of the patch towards its middle.
    """
    walk = _Walk(outer, inner)
    yield walk.along_outer()
    squares = len(inner) - 1
    for number in range(squares):
        if 2 * number + 1 <= squares:
            a, b, c = walk.along_inner()
            yield b, c, a
            yield walk.along_outer()
        else:
            a, b, c = walk.along_outer()
            yield c, a, b
            yield walk.along_inner()
    yield walk.along_outer()


class _Walk:
    """Two rows, with how far each of them has been walked along."""

    def __init__(self, outer: Row, inner: Row) -> None:
        self._outer, self._inner = outer, inner
        self._at_outer = self._at_inner = 0

    def along_outer(self) -> Triangle:
        """The triangle of the next step of the outer row and a point of the inner one."""
        self._at_outer += 1
        begin, end = self._outer[self._at_outer - 1 : self._at_outer + 1]
        return begin, end, self._inner[self._at_inner]

    def along_inner(self) -> Triangle:
        """The triangle of the next step of the inner row and a point of the outer one."""
        self._at_inner += 1
        begin, end = self._inner[self._at_inner - 1 : self._at_inner + 1]
        return begin, self._outer[self._at_outer], end

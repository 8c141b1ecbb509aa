"""A mesh in clip space made of cells, in each of which a quad or triangle shows one convention."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from burnish.targets.runner.meshes import Mesh

CELL = 16
"""The side of a cell, in pixels."""
COLUMNS, ROWS = 8, 4
WIDTH, HEIGHT = COLUMNS * CELL, ROWS * CELL
LOW, HIGH = 2, 14
"""The begin and the end of a quad in its cell, in pixels."""
CENTER = 8
"""The pixel of a cell that tests examine; it is right of and below the centre."""

Corner = tuple[float, float]
"""A position in a cell, to the right and downwards, in pixels."""

TOP_LEFT, TOP_RIGHT = (LOW, LOW), (HIGH, LOW)
BOTTOM_LEFT, BOTTOM_RIGHT = (LOW, HIGH), (HIGH, HIGH)
TOP = (CENTER, LOW)


WHOLE = (-7, 2**30, -(2**31), 2**24 - 1)
NATURAL = (2**32 - 256, 2**31, 5)
"""Numbers that a float32 represents exactly."""


class Cell(IntEnum):
    """The numbers of the cells, counted from the top left, row by row; other cells are empty."""

    PLAIN = 0
    BEFORE_NEAR = 1
    BEYOND_FAR = 2
    NEAR = 3
    FAR = 4
    DOUBLE_W = 5
    CLOCKWISE = 6
    CROSSING = 7
    RECEDING = 8
    FIRST_LEFT = 9
    FIRST_RIGHT = 10
    FIRST_TOP = 11
    BEHIND = 12
    UNDER_FIRST = 13
    OVER_FIRST = 14
    INTEGERS = 17
    LAST = 31


@dataclass(frozen=True, slots=True)
class Shape:
    """The triangles of one cell."""

    cell: int
    corners: Sequence[Corner] = (TOP_LEFT, BOTTOM_LEFT, BOTTOM_RIGHT, TOP_RIGHT)
    """The corners of a triangle fan, counter-clockwise on the screen."""
    marks: Sequence[int] = ()
    """The mark of each corner; if there are none, it is the cell's number."""
    depth: tuple[float, float] = (0.5, 0.5)
    """z / w at the left and at the right end."""
    w: tuple[float, float] = (1.0, 1.0)
    """Clip w at the left and at the right end."""
    whole: tuple[int, int, int, int] = (0, 0, 0, 0)
    natural: tuple[int, int, int] = (0, 0, 0)


def middle(cell: int) -> tuple[int, int]:
    """The pixel of a cell that tests examine, in the whole picture."""
    row, column = divmod(cell, COLUMNS)
    return column * CELL + CENTER, row * CELL + CENTER


def mesh_of(shapes: Sequence[Shape]) -> Mesh:
    """A mesh of shapes; the attribute ``slide`` counts pixels in the cell, to the right and
    upwards."""
    clip: list[tuple[float, ...]] = []
    marks, slides, wholes, naturals, triangles = [], [], [], [], []
    for shape in shapes:
        first = len(clip)
        count = len(shape.corners)
        clip += [_clip(shape, corner) for corner in shape.corners]
        slides += [(right, -down) for right, down in shape.corners]
        marks += [(mark,) for mark in shape.marks or [shape.cell] * count]
        wholes += [shape.whole] * count
        naturals += [shape.natural] * count
        triangles += [(first, first + i, first + i + 1) for i in range(1, count - 1)]
    places = np.array(clip, float)
    channels = {
        "position": places[:, :3],
        "clip": places,
        "slide": np.array(slides, float),
        "mark": np.array(marks),
        "whole": np.array(wholes),
        "natural": np.array(naturals),
    }
    return Mesh(channels, np.array(triangles))


def _clip(shape: Shape, corner: Corner) -> tuple[float, float, float, float]:
    row, column = divmod(shape.cell, COLUMNS)
    x = 2 * (column * CELL + corner[0]) / WIDTH - 1
    y = 1 - 2 * (row * CELL + corner[1]) / HEIGHT
    share = (corner[0] - LOW) / (HIGH - LOW)
    depth, w = (ends[0] + share * (ends[1] - ends[0]) for ends in (shape.depth, shape.w))
    return x * w, y * w, depth * w, w


LEFT_END, RIGHT_END, TOP_END = (BOTTOM_LEFT, 7), (BOTTOM_RIGHT, 20), (TOP, 33)
"""The corners of a triangle with their marks."""
OVER, UNDER = 100, 200
"""The mark of the nearer shape, and that of the one behind it."""


def _triangle(cell: int, *corners: tuple[Corner, int]) -> Shape:
    return Shape(cell, [corner for corner, _ in corners], [mark for _, mark in corners])


def _over(cell: int) -> Shape:
    return Shape(cell, marks=[OVER] * 4, depth=(0.25, 0.25))


def _under(cell: int) -> Shape:
    return Shape(cell, marks=[UNDER] * 4, depth=(0.75, 0.75))


CELLS = mesh_of(
    [
        Shape(Cell.PLAIN),
        Shape(Cell.BEFORE_NEAR, depth=(-0.25, -0.25)),
        Shape(Cell.BEYOND_FAR, depth=(1.25, 1.25)),
        Shape(Cell.NEAR, depth=(0.125, 0.125)),
        Shape(Cell.FAR, depth=(0.875, 0.875)),
        Shape(Cell.DOUBLE_W, depth=(0.25, 0.25), w=(2, 2)),
        Shape(Cell.CLOCKWISE, (TOP_LEFT, TOP_RIGHT, BOTTOM_RIGHT, BOTTOM_LEFT)),
        Shape(Cell.CROSSING, depth=(-0.75, 0.75)),
        Shape(Cell.RECEDING, w=(1, 3)),
        Shape(Cell.BEHIND, w=(-1, -1)),
        _triangle(Cell.FIRST_LEFT, LEFT_END, RIGHT_END, TOP_END),
        _triangle(Cell.FIRST_RIGHT, RIGHT_END, TOP_END, LEFT_END),
        _triangle(Cell.FIRST_TOP, TOP_END, LEFT_END, RIGHT_END),
        _under(Cell.UNDER_FIRST),
        _over(Cell.UNDER_FIRST),
        _over(Cell.OVER_FIRST),
        _under(Cell.OVER_FIRST),
        Shape(Cell.INTEGERS, whole=WHOLE, natural=NATURAL),
        Shape(Cell.LAST),
    ]
)

"""Divides a picture into tiles with few fragments each, which are drawn one after the other.

What is kept of fragments, from their coverage to their colours, takes hundreds of bytes for each.
So a picture needs no more memory for them if it is large, or if many faces lie behind each other.
Nothing that is drawn depends on the tiles: what fragments meet is in their own pixel.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from .faces import Faces
from .scene import Floats, Ints, RasterRules

MOST = 1 << 18
"""How many samples all faces in a tile may cover together, unless it is a single pixel."""


@dataclass(frozen=True, slots=True)
class Tile:
    """A rectangle of pixels: columns from ``left`` to ``right``, and rows."""

    left: int
    top: int
    right: int
    bottom: int

    @classmethod
    def of(cls, rules: RasterRules) -> Tile:
        """All that may be drawn to."""
        return cls(*rules.drawn)

    @property
    def pixels(self) -> int:
        """How many it has."""
        return max(self.right - self.left, 0) * max(self.bottom - self.top, 0)

    def within(self, rules: RasterRules) -> RasterRules:
        """Rules by which nothing is drawn beside the tile."""
        area = self.left, self.top, self.right - self.left, self.bottom - self.top
        return replace(rules, scissor=area)

    def halves(self) -> tuple[Tile, Tile]:
        """Its upper and its lower half, or the left and the right one of a wide row."""
        if self.bottom - self.top > 1:
            middle = (self.top + self.bottom) // 2
            return replace(self, bottom=middle), replace(self, top=middle)
        middle = (self.left + self.right) // 2
        return replace(self, right=middle), replace(self, left=middle)


def tiles(faces: Faces, whole: Tile, rules: RasterRules) -> Iterator[tuple[Tile, Ints]]:
    """The tiles of a picture, from its top to its bottom, each with the numbers of the faces that
    may cover something in it: of very many, a tile has few."""
    pending = [(whole, np.arange(len(faces.area)))] if whole.pixels else []
    while pending:
        tile, near = pending.pop()
        covered = _most_covered(faces, near, tile)
        near = near[covered != 0]  # It is NaN where nobody knows.
        if tile.pixels > 1 and np.nansum(covered) * rules.samples > MOST:
            pending += [(half, near) for half in reversed(tile.halves())]
        else:
            yield tile, near


def _most_covered(faces: Faces, near: Ints, tile: Tile) -> Floats:
    """How many pixels of a tile each of some faces may cover: those of the rectangle around it."""
    slack = faces.unsure[near].max(axis=1, initial=0.0) + 1.0
    sides = []
    for places, first, last in (
        (faces.x[near], tile.left, tile.right),
        (faces.y[near], tile.top, tile.bottom),
    ):
        begin = np.clip(places.min(axis=1) - slack, first, last)
        end = np.clip(places.max(axis=1) + slack, first, last)
        sides.append(end - begin)
    most: Floats = sides[0] * sides[1]
    return most

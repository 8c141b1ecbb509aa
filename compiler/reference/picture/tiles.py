"""Divides a picture into tiles with few fragments each, which are drawn one after the other.

The data of fragments, from their coverage to their colours, takes hundreds of bytes for each. So a
picture needs no more memory for them if it is large, or if many faces lie behind each other. No
result depends on the tiles: a fragment depends on those in its own pixel only.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from .faces import Faces
from .scene import Floats, Ints, RasterRules

MOST = 1 << 18
"""The limit of samples that all faces in a tile cover together, unless it is a single pixel."""


@dataclass(frozen=True, slots=True)
class Tile:
    """A rectangle of pixels: columns from ``left`` to ``right``, and rows."""

    left: int
    top: int
    right: int
    bottom: int

    @classmethod
    def of(cls, rules: RasterRules) -> Tile:
        """The tile of all pixels that may be drawn to."""
        return cls(*rules.drawn)

    @property
    def pixels(self) -> int:
        """The number of pixels of the tile."""
        return max(self.right - self.left, 0) * max(self.bottom - self.top, 0)

    def within(self, rules: RasterRules) -> RasterRules:
        """Rules by which nothing is drawn beside the tile."""
        area = self.left, self.top, self.right - self.left, self.bottom - self.top
        return replace(rules, scissor=area)

    def halves(self) -> tuple[Tile, Tile]:
        """The upper and the lower half, or the left and the right one of a wide row."""
        if self.bottom - self.top > 1:
            middle = (self.top + self.bottom) // 2
            return replace(self, bottom=middle), replace(self, top=middle)
        middle = (self.left + self.right) // 2
        return replace(self, right=middle), replace(self, left=middle)


@dataclass(frozen=True, slots=True)
class _Around:
    """The rectangles around some faces, widened by the possible rounding of these."""

    face: Ints
    """The numbers of the faces, in ascending order."""
    ends: Floats
    """(4, faces): of each its left and right end, and then its upper and lower one."""

    @classmethod
    def of(cls, faces: Faces) -> _Around:
        """The surroundings of all faces."""
        slack = faces.unsure.max(axis=1, initial=0.0) + 1.0
        ends = [
            end
            for places in (faces.x, faces.y)
            for end in (places.min(axis=1) - slack, places.max(axis=1) + slack)
        ]
        return cls(np.arange(len(slack)), np.stack(ends))

    def within(self, tile: Tile) -> tuple[_Around, float]:
        """The faces that touch a tile, and the sum of the pixels of it that each may cover."""
        left, right = np.clip(self.ends[:2], tile.left, tile.right)
        upper, lower = np.clip(self.ends[2:], tile.top, tile.bottom)
        pixels = (right - left) * (lower - upper)
        some = pixels != 0  # Of a face about which nobody knows anything, it is NaN.
        return _Around(self.face[some], self.ends[:, some]), float(np.nansum(pixels))


def tiles(faces: Faces, whole: Tile, rules: RasterRules) -> Iterator[tuple[Tile, Ints]]:
    """The tiles of a picture, from its top to its bottom, and the faces that may touch each.

    Only these are looked at where a tile is halved, as there may be as many tiles as faces.
    """
    pending = [(whole, _Around.of(faces))] if whole.pixels else []
    while pending:
        tile, around = pending.pop()
        within, pixels = around.within(tile)
        if tile.pixels > 1 and pixels * rules.samples > MOST:
            pending += [(half, within) for half in reversed(tile.halves())]
        else:
            yield tile, within.face

"""Reading textures as Vulkan's chapter on image operations specifies it, in double precision.

The texels and the level that a device may use instead, within the bits it is granted, are a leading
axis of every read: the first of these variants is the exact one.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...ir.leaves import Resource
from ..namespace import Lane, Lanes
from .margins import Margins
from .scene import Floats, Ints, Texels
from .variants import Variants

_COORDINATE_MARGIN = 2.0**-15
"""How far a texture coordinate may be off, in textures: some devices find the nearest texel in 16
bits."""
_FLOAT32_MARGIN = 4e-6
"""How far it may be off besides, relative to itself."""
_FARTHEST = 1e9
"""Coordinates beyond are as good as none."""


class Image:
    """A texture's levels in one table, and its sampler's state."""

    def __init__(self, texels: Texels, resource: Resource, ways: Variants) -> None:
        self.heights, self.widths = np.array([level.shape[:2] for level in texels.levels]).T
        sizes = self.heights * self.widths
        self.starts = np.cumsum(sizes) - sizes
        self.table = np.concatenate([level.reshape(-1, 4) for level in texels.levels])
        self.state: Mapping[str, str] = dict(resource.state)
        self.ways = ways

        same = bool((self.table == self.table[0]).all())
        self.colour: Lanes | None = tuple(self.table[0].tolist()) if same else None
        """The only one, if there is only one."""


class Reader:
    """Reads an image in the quads of one evaluation: a texture's lane for the evaluator."""

    def __init__(self, image: Image, margins: Margins) -> None:
        self._image = image
        self._margins = margins

    def __call__(self, u: Lane, v: Lane) -> Lanes:
        """Four lanes (variants, quads, 2, 2) at coordinates (…, quads, 2, 2) or single numbers."""
        if (only := self._image.colour) is not None:
            return only
        varies = bool(np.ndim(u) or np.ndim(v))
        u, v = np.broadcast_arrays(_tame(u), _tame(v), np.zeros((1, 2, 2)))[:2]
        level = self._level(u, v)
        if self._image.state["mip"] == "linear":
            lower = np.floor(level)
            upper = np.minimum(lower + 1, len(self._image.widths) - 1)
            colour = self._at_level(u, v, lower, varies)
            share = (level - lower)[..., None]
            if share.any():
                colour = colour + share * (self._at_level(u, v, upper, varies) - colour)
        else:
            if len(level) == 1:  # Otherwise the variants read both levels.
                self._margins.at_whole(level + 0.5, _COORDINATE_MARGIN)
            colour = self._at_level(u, v, np.floor(level + 0.5), varies)
        return tuple(np.ascontiguousarray(np.moveaxis(colour, -1, 0)))

    def _level(self, u: Floats, v: Floats) -> Floats:
        """The level of detail, (variants, quads, 1, 1)."""
        image, ways = self._image, self._image.ways
        if image.state["mip"] == "none" or len(image.widths) == 1:
            return np.zeros((len(ways), 1, 1, 1))
        size = (float(image.widths[0]), float(image.heights[0]))
        across = [t[..., :, 1] - t[..., :, 0] for t in (u, v)]
        down = [t[..., 1, :] - t[..., 0, :] for t in (u, v)]
        along_x = [s * _chosen(d, ways.row) for s, d in zip(size, across, strict=True)]
        along_y = [s * _chosen(d, ways.column) for s, d in zip(size, down, strict=True)]
        footprint = np.maximum(_length(along_x, ways.order), _length(along_y, ways.order))
        level = np.log2(np.maximum(footprint, np.finfo(np.float64).tiny)) + ways.level[:, None]
        return np.clip(level, 0, len(image.widths) - 1)[..., None, None]

    def _at_level(self, u: Floats, v: Floats, level: Floats, varies: bool) -> Floats:
        """The colour in one level (variants, quads, 2, 2, 4)."""
        image, ways = self._image, self._image.ways
        number = level.astype(np.int64)
        width, height = image.widths[number], image.heights[number]
        x, y = u * width, v * height
        if image.state["filter"] == "nearest":
            if varies:
                # Variants that read another level have other texels, which is no decision.
                same = number == number[:1]
                self._margins.at_whole(np.where(same, x, x[:1]), _nearest_margin(x, width))
                self._margins.at_whole(np.where(same, y, y[:1]), _nearest_margin(y, height))
            return self._texel(np.floor(x), np.floor(y), number)
        x = x - 0.5 + ways.across[:, None, None, None]
        y = y - 0.5 + ways.down[:, None, None, None]
        left, top = np.floor(x), np.floor(y)
        right, down = (x - left)[..., None], (y - top)[..., None]
        upper = _mixed(self._texel(left, top, number), self._texel(left + 1, top, number), right)
        lower = _mixed(
            self._texel(left, top + 1, number), self._texel(left + 1, top + 1, number), right
        )
        return _mixed(upper, lower, down)

    def _texel(self, x: Floats, y: Floats, level: Ints) -> Floats:
        image = self._image
        width, height = image.widths[level], image.heights[level]
        column = _wrapped(x.astype(np.int64), width, image.state["wrap"])
        row = _wrapped(y.astype(np.int64), height, image.state["wrap"])
        texel: Floats = image.table[image.starts[level] + row * width + column]
        return texel


def _nearest_margin(place: Floats, size: Ints) -> Floats:
    """How far a place in texels may be off where the nearest is taken."""
    off: Floats = _COORDINATE_MARGIN * size + _FLOAT32_MARGIN * np.abs(place)
    return off


def _tame(coordinate: Lane) -> Floats:
    """Without NaN and infinity, which helper lanes may have."""
    tame = np.nan_to_num(np.asarray(coordinate, dtype=np.float64), posinf=0.0, neginf=0.0)
    return np.clip(tame, -_FARTHEST, _FARTHEST)


def _wrapped(index: Ints, size: Ints, wrap: str) -> Ints:
    """The texel that a number stands for outside of the texture."""
    if wrap == "clamp":
        return np.clip(index, 0, size - 1)
    if wrap == "repeat":
        return index % size
    folded = index % (2 * size)
    return np.where(folded < size, folded, 2 * size - 1 - folded)


def _mixed(a: Floats, b: Floats, share: Floats) -> Floats:
    return a + share * (b - a)


def _chosen(differences: Floats, which: Ints) -> Floats:
    """Each variant's choice (variants, quads) among two differences (…, quads, 2)."""
    shape = (len(which), *differences.shape[-2:])
    chosen: Floats = np.broadcast_to(differences, shape)[
        np.arange(len(which)), :, np.maximum(which, 0)
    ]
    return chosen


def _length(lanes: list[Floats], order: Floats) -> Floats:
    """The norm of two lanes (variants, quads), of a variant's own order."""
    a, b = np.abs(lanes[0]), np.abs(lanes[1])
    order = order[:, None]
    return np.where(order == 2, np.hypot(a, b), np.where(order == 1, a + b, np.maximum(a, b)))

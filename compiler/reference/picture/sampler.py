"""Reading textures as Vulkan's chapter on image operations specifies it, in double precision.

The texels and the level that a device may use instead, within the bits it is granted, are a leading
axis of every read: the first of these variants is the exact one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace

import numpy as np

from ...ir.leaves import Resource
from ..namespace import Lane, Lanes
from .margins import Margins
from .scene import Floats, Ints, Texels

_COORDINATE_MARGIN = 2.0**-15
"""How far a texture coordinate may be off, in textures: some devices find the nearest texel in 16
bits."""
_FLOAT32_MARGIN = 4e-6
"""How far it may be off besides, relative to itself."""
_FARTHEST = 1e9
"""Coordinates beyond are as good as none."""


@dataclass(frozen=True, slots=True)
class Variants:
    """How a read may be done; arrays have one element for each variant."""

    across: Floats
    """Texels by which a linear filter is shifted to the right."""
    down: Floats
    row: Ints
    """Which row of the quad derivatives along x are taken from; -1: the texture's from the upper
    one, a pixel's from its own."""
    column: Ints
    """Likewise along y: the left column, or the pixel's own."""
    level: Floats
    """What is added to the level of detail."""
    nudge: Floats
    """By how much interpolated values are off, relative to the largest of their corners."""
    checkered: Ints
    """1: to the other side in every other pixel and lane."""
    rounding: Floats
    """By how much operations are off, relative to what they give."""
    period: Ints
    """After how many calls the functions that are off by more change sides; 0: they are exact."""
    kind: Ints
    """What it varies: 0 nothing; 1, 2, 3, 4 the place across, down, the derivatives, the level;
    5 and 6 what is interpolated, everything alike and checkered; 7 what operations give; 8 to 10
    what functions give, with three periods."""
    order: Floats
    """Of the norm that makes a length of the derivatives: 2; any between the largest lane
    (infinity) and the sum (1) is allowed."""

    def __len__(self) -> int:
        return len(self.across)


_EXACT = Variants(*(np.array([value]) for value in (0.0, 0.0, -1, -1, 0.0, 0.0, 0, 0.0, 0, 0, 2.0)))


def variants(
    subtexel_bits: int | None,
    mip_bits: int | None,
    varying_bits: int | None,
    rounding_bits: int | None,
    functions: bool,
) -> Variants:
    """The exact way and, where a device's bits matter, those at their limits."""
    found = [_EXACT]

    def add(kind: int, **changes: float) -> None:
        new = {name: np.array([value]) for name, value in changes.items()}
        found.append(replace(_EXACT, kind=np.array([kind]), **new))

    if subtexel_bits is not None:
        for step in (-(2.0**-subtexel_bits), 2.0**-subtexel_bits):
            add(1, across=step)
            add(2, down=step)
    if mip_bits is not None:
        for row, column in ((0, 0), (0, 1), (1, 0), (1, 1)):
            add(3, row=row, column=column)
        add(4, level=-(2.0**-mip_bits), order=np.inf)
        add(4, level=2.0**-mip_bits, order=1.0)
    if varying_bits is not None:
        add(5, nudge=2.0**-varying_bits)
        add(6, nudge=2.0**-varying_bits, checkered=1)
    if rounding_bits is not None:
        add(7, rounding=2.0**-rounding_bits)
    if functions:
        for kind, period in ((8, 1 << 30), (9, 1), (10, 2)):
            add(kind, period=period)
    names = [field.name for field in fields(Variants)]
    return Variants(*(np.concatenate([getattr(one, name) for one in found]) for name in names))


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

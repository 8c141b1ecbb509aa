"""Reads textures as Vulkan's chapter on image operations specifies it, in double precision.

The evaluator gets a ``QuadReader`` as the value of a texture. A device may use other texels and
another level, within its number of bits. These variants are a leading axis of every read; the first
one is exact.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import product
from typing import Any

import numpy as np

from ..namespace import Lane, Lanes
from . import levels
from .cube import between_faces, beyond_corner, met
from .margins import Margins, margin
from .scene import Floats, Ints
from .texels import Image
from .variants import Variants

_COORDINATE_MARGIN = 2.0**-15
"""The error that a texture coordinate may have, in units of the texture: some devices find the
nearest texel with 16 bits."""
_FLOAT32_MARGIN = 4e-6
"""The further error that it may have, relative to itself."""
_GATHER_MARGIN = 2.0**-12
"""The error, in texels, with which the four gathered texels may be chosen."""
_FARTHEST = 1e9
"""Larger coordinates have no meaning."""

_COMPARISONS: Mapping[str, Callable[[Any, Any], Any]] = {
    "less": np.less,
    "less_equal": np.less_equal,
    "greater": np.greater,
    "greater_equal": np.greater_equal,
}
_GATHERED = ((0, 1), (1, 1), (1, 0), (0, 0))
"""The columns and rows of the four texels, relative to the one at the upper left."""

Shown = Callable[[Floats], Floats]
"""A function that is applied to texels (…, lanes) before they are blended."""


@dataclass(frozen=True, slots=True)
class _Place:
    """The place at which a texture is read."""

    coordinate: Sequence[Floats]
    """The program's coordinate: two or three lanes."""
    axes: Sequence[Floats]
    """In units of the texture, or of the face."""
    layer: Ints
    """The layer, or the face of a cube."""
    varies: bool


class QuadReader:
    """Reads an image in the quads of one evaluation; it is a texture's lane for the evaluator.

    ``turns`` gives every read of the evaluation a number, whichever image it is of.
    """

    def __init__(
        self, image: Image, ways: Variants, margins: Margins, turns: Iterator[int]
    ) -> None:
        self._image = image
        self._all_ways = self._ways = ways
        self._margins = margins
        self._turns = turns

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of the builtin ``name``; ``operands`` are those after the texture.

        Lanes are (variants, quads, side, side), from operands (…, quads, side, side) or numbers.
        """
        self._ways = self._all_ways.at(next(self._turns))
        read: Callable[..., Lanes] = getattr(self, f"_{name}")
        return read(*operands)

    # --- the builtins -----------------------------------------------------------------------------

    def _sample(self, *where: Lanes) -> Lanes:
        if self._image.only is not None:
            return self._image.only
        place = self._place(where)
        if not levels.has_one(self._image):
            self._margins.spread()
        return self._filtered(place, levels.implicit(self._image, place.coordinate, self._ways))

    def _sample_level(self, *operands: Lanes) -> Lanes:
        *where, (level,) = operands
        if self._image.only is not None:
            return self._image.only
        named = levels.given(self._image, _tame(level), self._ways)
        return self._filtered(self._place(where), named)

    def _sample_grad(self, *operands: Lanes) -> Lanes:
        *where, across, down = operands
        if self._image.only is not None:
            return self._image.only
        place = self._place(where)
        right, below = ([_whole(_tame(lane)) for lane in lanes] for lanes in (across, down))
        level = levels.by_changes(self._image, place.coordinate, right, below, self._ways)
        return self._filtered(place, level)

    def _gather(self, *operands: Lanes) -> Lanes:
        *where, (lane,) = operands
        if self._image.only is not None:
            return (self._image.only[int(lane)],) * 4
        return self._four(self._place(where), lambda texels: texels[..., int(lane)])

    def _compare(self, *operands: Lanes) -> Lanes:
        *where, (reference,) = operands
        place, first = self._place(where), np.zeros((len(self._ways), 1, 1, 1))
        return (self._at_level(place, first, self._comparison(reference)),)

    def _gather_compare(self, *operands: Lanes) -> Lanes:
        *where, (reference,) = operands
        return self._four(self._place(where), self._comparison(reference))

    def _load(self, *operands: Lanes) -> Lanes:
        place, *rest = operands
        layer = rest[0][0] if self._image.type.layered else 0
        numbers = [np.asarray(lane, dtype=np.int64) for lane in (*place, layer, rest[-1][0])]
        *wide, layers, level = np.broadcast_arrays(*numbers)
        texels = self._image.load(wide, layers, level)
        lanes = np.moveaxis(texels, -1, 0)
        return tuple(lane if lane.ndim else lane.item() for lane in lanes)

    def _texture_size(self, level: Lanes) -> Lanes:
        number = np.clip(np.asarray(level[0], dtype=np.int64), 0, self._image.levels - 1)
        return tuple(size if size.ndim else size.item() for size in self._image.sizes(number))

    def _texture_layers(self) -> Lanes:
        return (self._image.layers,)

    def _texture_levels(self) -> Lanes:
        return (self._image.levels,)

    # --- inside -----------------------------------------------------------------------------------

    def _place(self, where: Sequence[Lanes]) -> _Place:
        """The place for a coordinate and, for an array, a layer."""
        quad = np.zeros((1, *self._margins.undecided.shape[1:]))
        coordinate = list(np.broadcast_arrays(*map(_tame, where[0]), quad))[:-1]
        varies = any(np.ndim(lane) for lane in where[0])
        if self._image.type.dimension == "cube":
            found = met(coordinate)
            return _Place(coordinate, (found.across, found.down), found.face, varies)
        given = where[1][0] if self._image.type.layered else 0
        layer = self._image.layer(_whole(np.asarray(given, dtype=np.int64)))
        return _Place(coordinate, coordinate, layer, varies)

    def _filtered(self, place: _Place, level: Floats) -> Lanes:
        """The colours, blended between two levels."""
        if self._image.state["mip"] == "linear":
            lower = np.floor(level)
            upper = np.minimum(lower + 1, self._image.levels - 1)
            colour = self._at_level(place, lower)
            share = (level - lower)[..., None]
            if share.any():
                colour = colour + share * (self._at_level(place, upper) - colour)
            if self._image.state["filter"] == "nearest":
                colour = colour + self._ways.mixed[:, None, None, None, None]
        else:
            if len(level) == 1:  # Otherwise the variants read both levels.
                self._margins.at_whole(level + 0.5, _COORDINATE_MARGIN)
            colour = self._at_level(place, np.floor(level + 0.5))
        return tuple(np.ascontiguousarray(np.moveaxis(colour, -1, 0)))

    def _at_level(self, place: _Place, level: Floats, shown: Shown | None = None) -> Floats:
        """The mean of texels, or of a function of them, in one level."""
        number = level.astype(np.int64)
        sizes = self._image.sizes(number)
        scaled = [at * size for at, size in zip(place.axes, sizes, strict=True)]
        show = shown or (lambda texels: texels)
        if self._image.state["filter"] == "nearest":
            if place.varies:
                self._watch_nearest(place, scaled, sizes, number)
            near = [np.floor(at).astype(np.int64) for at in scaled]
            return show(self._within(near, place.layer, number))
        shifts = (self._ways.across, self._ways.down, self._ways.inward)
        moved = [
            at - 0.5 + shift[:, None, None, None]
            for at, shift in zip(scaled, shifts[: len(scaled)], strict=True)
        ]
        first = [np.floor(at).astype(np.int64) for at in moved]
        shares = [at - i for at, i in zip(moved, first, strict=True)]
        return self._mixed(place.layer, number, first, shares, show)

    def _mixed(
        self, layer: Ints, level: Ints, first: list[Ints], shares: list[Floats], show: Shown
    ) -> Floats:
        """The mean of the texels around a place; ``first`` is the one with the smallest indices."""
        total: Any = 0.0
        for steps in product((0, 1), repeat=len(first)):
            corner = [i + step for i, step in zip(first, steps, strict=True)]
            weights = [
                share if step else 1.0 - share for share, step in zip(shares, steps, strict=True)
            ]
            weight: Floats = reduce(np.multiply, weights)
            value = show(self._texel(corner, layer, level))
            total = total + (weight if value.ndim == weight.ndim else weight[..., None]) * value
        mean: Floats = total
        return mean

    def _within(self, place: list[Ints], layer: Ints, level: Ints) -> Floats:
        """A face's own texels only: a place is within a face, including its edges."""
        if self._image.type.dimension == "cube":
            sizes = self._image.sizes(level)
            place = [np.clip(i, 0, size - 1) for i, size in zip(place, sizes, strict=True)]
        return self._image.texel(place, layer, level)

    def _texel(self, place: list[Ints], layer: Ints, level: Ints) -> Floats:
        """A texel; beyond a cube's corner, the mean of the three texels around it.

        Vulkan recommends the mean. A device that uses one of the three is a variant.
        """
        texel = self._image.texel(place, layer, level)
        if self._image.type.dimension != "cube":
            return texel
        sizes = self._image.sizes(level)
        beyond = beyond_corner(place, sizes[0])
        if not beyond.any():
            return texel
        inside = [np.clip(i, 0, size - 1) for i, size in zip(place, sizes, strict=True)]
        three = np.stack([
            np.broadcast_to(self._image.texel(around, layer, level), texel.shape)
            for around in (inside, [inside[0], place[1]], [place[0], inside[1]])
        ])  # fmt: skip
        choice = self._ways.corner[:, None, None, None, None]
        picked = np.where(choice < 0, three.mean(axis=0), 0.0)
        for number in range(3):
            picked = np.where(choice == number, three[number], picked)
        return np.where(beyond[..., None], picked, texel)

    def _comparison(self, reference: Lane) -> Shown:
        """1 where a reference, clamped to the range of depths, passes the comparison with a
        depth."""
        given = np.clip(_whole(_tame(reference)), 0.0, 1.0)
        compared = _COMPARISONS[self._image.state["compare"]]

        def show(texels: Floats) -> Floats:
            depth = texels[..., 0]
            if np.ndim(reference):
                self._margins.at_zero(given - depth, margin(given, depth))
            found: Floats = compared(given, depth).astype(np.float64)
            return found

        return show

    def _four(self, place: _Place, show: Shown) -> Lanes:
        """A function of each of the four texels that a filtered read of level 0 would blend."""
        first = np.zeros((len(self._ways), 1, 1, 1), dtype=np.int64)
        sizes = self._image.sizes(first)
        scaled = [at * size for at, size in zip(place.axes, sizes, strict=True)]
        moved = [at - 0.5 for at in scaled]
        for at, size in zip(moved, sizes, strict=True):
            self._margins.at_whole(at, _nearest_margin(at, size) + _GATHER_MARGIN)
        upper_left = [np.floor(at).astype(np.int64) for at in moved]
        found = []
        for steps in _GATHERED:
            corner = [i + step for i, step in zip(upper_left, steps, strict=True)]
            if self._image.type.dimension == "cube":
                self._watch_faces(place)
                beyond = beyond_corner(corner, sizes[0])
                self._margins.at_zero(np.where(beyond, 0.0, 1.0), 0.0)
            found.append(show(self._texel(corner, place.layer, first)))
        return tuple(found)

    def _watch_nearest(
        self, place: _Place, scaled: Sequence[Floats], sizes: Sequence[Ints], level: Ints
    ) -> None:
        if self._image.type.dimension == "cube":
            self._watch_faces(place)
        # Variants that read another level get other texels, which does not count as a decision.
        same = level == level[:1]
        for at, size in zip(scaled, sizes, strict=True):
            self._margins.at_whole(np.where(same, at, at[:1]), _nearest_margin(at, size))

    def _watch_faces(self, place: _Place) -> None:
        close = between_faces(place.coordinate, _FLOAT32_MARGIN)
        self._margins.at_zero(np.where(close, 0.0, place.layer + 1.0), 0.0)
        self._margins.at_whole(place.layer + 0.5, 0.0)


def _nearest_margin(place: Floats, size: Ints) -> Floats:
    """The error that a place, in texels, may have where the nearest texel is used."""
    off: Floats = _COORDINATE_MARGIN * size + _FLOAT32_MARGIN * np.abs(place)
    return off


def _tame(coordinate: Lane) -> Floats:
    """The coordinate without NaN and infinity, which helper lanes may have."""
    tame = np.nan_to_num(np.asarray(coordinate, dtype=np.float64), posinf=0.0, neginf=0.0)
    return np.clip(tame, -_FARTHEST, _FARTHEST)


def _whole(lane: Any) -> Any:
    """A lane with the axes of quads, even if it is the same in all."""
    return lane if np.ndim(lane) else np.full((1, 1, 1), lane)

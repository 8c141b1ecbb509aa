"""Finds the levels and the texels around places of a texture, and makes one value of them.

The sampler makes a ``Filter`` for each read. Arrays are (pixels,) or (lanes, pixels) here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ....stdlib.builtins.facts import ULP
from ..bounds import Bounded, exact
from ..bounds.lanes import limited
from .blending import BLENDING, blended
from .choices import Choice, Part, at, hull_of_choices, lane_at, replaced, sure
from .intervals import increasing, widened
from .scene import Floats, Ints
from .texels import EVERY_LANE, Image

_NEAREST = 2.0**-15
"""The error of a place where single texels are used, in units of the texture.

Some devices find them with 16 bits. Assumed: only Direct3D promises anything, namely a number of
bits behind the point in units of texels (11.3 functional specification, 7.18.7), and these count,
too.
"""
_NEAREST_RELATIVE = 4e-6
"""The further error of the same place, relative to itself."""
_GATHERED = 2.0**-12
"""The further error, in texels, with which the four gathered texels may be chosen."""
_NEAREST_LEVEL = 2.0**-15
"""The error with which the nearest level may be chosen."""

_COMPARISONS: Mapping[str, Callable[[Bounded, Bounded], Bounded]] = {
    "less": lambda reference, depth: reference < depth,
    "less_equal": lambda reference, depth: reference <= depth,
    "greater": lambda reference, depth: reference > depth,
    "greater_equal": lambda reference, depth: reference >= depth,
}
_ROUND = (1, 3, 2, 0)
"""Gathered texels go round from the lower left; these are their numbers in ``Image.cell``."""


@dataclass(frozen=True, slots=True)
class Place:
    """The places at which a texture is read, one for each pixel."""

    axes: Sequence[Bounded]
    """The coordinates, in units of the texture, or of a cube's face."""
    layer: Choice
    """The layer, or the face of a cube; the faces of several cubes are counted on."""
    level: Bounded | None
    """``None`` if all reads use the first one."""
    reference: Bounded | None
    """The references that depths are compared with."""

    def at(self, part: Part) -> Place:
        """The places of some pixels."""
        level, reference = (
            None if lane is None else lane_at(part, lane) for lane in (self.level, self.reference)
        )
        return Place([lane_at(part, x) for x in self.axes], self.layer.at(part), level, reference)


class Filter:
    """Filters the texels around a place to one value."""

    def __init__(self, image: Image, kind: str, lanes: slice = EVERY_LANE) -> None:
        """``kind`` is ``nearest``, ``linear``, or ``gather``; ``lanes`` are those that are read.

        ``gather`` reads the four texels that ``linear`` would blend.
        """
        self._image = image
        self._kind = kind
        self._lanes = lanes

    def of(self, place: Place) -> Bounded:
        """The lanes of a read at these places."""
        level = place.level
        blends = level is not None and self._image.state["mip"] == "linear"

        def compute(part: Part, numbers: list[Ints]) -> Bounded:
            layer, number = numbers
            here = place.at(part)
            if level is None or not blends:
                return self._in_level(here, layer, number)
            share = increasing(lambda x: np.clip(x - number, 0.0, 1.0), lane_at(part, level))
            return self._between_levels(here, layer, number, share)

        def anything(pixels: Ints) -> tuple[Floats, Floats]:
            return self._anything(place, np.zeros(len(pixels), dtype=np.int64), every_level=True)

        found = hull_of_choices([place.layer, self._number(level)], compute, anything)
        if place.reference is None:
            return self._kept(self._weighed(found), blends)
        # A blend of zeros and ones may exceed 1, but not fall below 0 (``builtins/texture.py``).
        return exact(found.value) if found.is_exact else limited(found, 0.0, np.inf)

    def of_any(self, place: Place) -> Bounded:
        """The lanes of reads of any texels, in any level; only the number of places counts."""
        level = np.zeros(place.axes[0].value.shape, dtype=np.int64)
        low, high = self._anything(place, level, every_level=True)
        return self._weighed(Bounded(low, low, high))

    def of_equal(self, texel: Bounded) -> Bounded:
        """A read of a texture all of whose texels are the same, lane by lane."""
        blends = self._image.axes if self._kind == "linear" else 0
        blends += self._image.state["mip"] == "linear"
        if blends and not self._image.is_exact:
            # Texels in fixed point and halves stay what they are (Direct3D, 7.18.16.3).
            error = self._image.blending if self._image.stored == "float" else BLENDING
            texel = widened(texel, blends * (error or 0.0) * texel.magnitude)
        return self._weighed(texel)

    # --- levels -----------------------------------------------------------------------------------

    def _number(self, level: Bounded | None) -> Choice:
        """The level that is read, or the lower one of two that are blended."""
        if level is None:
            return sure(0)
        if self._image.state["mip"] == "linear":
            home, first = _floor(level.value), _floor(level.low)
            if level.is_exact:
                return sure(home)
            last = np.maximum(np.ceil(level.high).astype(np.int64) - 1, first)
            return Choice(np.clip(home, first, last), first, last)
        middle = increasing(lambda x: x + 0.5, level)
        if not self._image.is_exact:
            middle = widened(middle, _NEAREST_LEVEL)
        return _floors(middle).limited(0, self._image.levels - 1)

    def _between_levels(self, place: Place, layer: Ints, number: Ints, share: Bounded) -> Bounded:
        """The blend of two levels; ``share`` is that of the higher one."""
        lower = self._in_level(place, layer, number)
        reached = np.flatnonzero(share.high > 0)
        if not len(reached):
            return lower
        above = np.minimum(number + 1, self._image.levels - 1)
        if len(reached) == len(above):
            upper = self._in_level(place, layer, above)
            return blended((lower, upper), (share,), self._image.blending)
        upper = self._in_level(place.at(reached), at(reached, layer), at(reached, above))
        both = lane_at(reached, lower), upper
        mixed = blended(both, (lane_at(reached, share),), self._image.blending)
        return replaced(lower, reached, mixed)

    def _weighed(self, found: Bounded) -> Bounded:
        """A read of single texels from a sampler that blends levels, as a device weighs them.

        It may do so even where all of the weight belongs to one level.
        """
        bits = self._image.rules.mixing_bits
        blends = self._kind == "nearest" and self._image.state["mip"] == "linear"
        return widened(found, 2.0**-bits) if blends and bits is not None else found

    def _kept(self, found: Bounded, blends_levels: bool) -> Bounded:
        """The result of a filter over texels in fixed point, with as many bits as a device keeps.

        It stays between 0 and 1, as all texels do.
        """
        image = self._image
        bits = image.rules.fixed_bits if image.stored == "fixed" else None
        if bits is None or not (blends_levels or self._kind == "linear"):
            return found
        off = 2.0**-bits
        low = np.maximum(found.low - off, np.minimum(found.low, 0.0))
        return Bounded(found.value, low, np.minimum(found.high + off, np.maximum(found.high, 1.0)))

    # --- texels -----------------------------------------------------------------------------------

    def _in_level(self, place: Place, layer: Ints, level: Ints) -> Bounded:
        """The read in one layer and one level for each pixel."""
        image = self._image
        sizes = image.sizes(level)
        texels = [self._in_texels(x, size) for x, size in zip(place.axes, sizes, strict=True)]
        choices = [_floors(lane) for lane in texels]
        if image.type.is_cube:
            before = int(self._kind != "nearest")
            choices = [
                choice.limited(-before, size - 1)
                for choice, size in zip(choices, sizes, strict=True)
            ]

        def compute(part: Part, cell: list[Ints]) -> Bounded:
            reference = None if place.reference is None else lane_at(part, place.reference)
            where = cell, at(part, layer), at(part, level), self._lanes
            if self._kind == "nearest":
                return self._shown(image.texel(*where), reference)
            corners = [self._shown(texel, reference) for texel in image.cell(*where)]
            if self._kind == "gather":
                return _stacked([corners[number] for number in _ROUND])
            shares = [
                increasing(lambda x, first=first: np.clip(x - first, 0.0, 1.0), lane_at(part, lane))
                for lane, first in zip(texels, cell, strict=True)
            ]
            return blended(corners, shares, image.blending, image.of_products)

        def anything(pixels: Ints) -> tuple[Floats, Floats]:
            return self._anything(place, at(pixels, np.broadcast_to(level, texels[0].shape)))

        return hull_of_choices(choices, compute, anything)

    def _in_texels(self, lane: Bounded, size: Ints) -> Bounded:
        """A coordinate in texels, from the first texel's edge, or its centre for blending."""
        shift = 0.0 if self._kind == "nearest" else 0.5
        found = increasing(lambda x: x * size - shift, lane)
        bits = self._image.rules.subtexel_bits
        if bits is None:
            return found
        if self._kind == "linear":
            # A coordinate is wrapped, multiplied by the size and shifted, and may be rounded to
            # float32 each time: in proportion to the place in texels, and to the texture.
            return widened(found, 2.0**-bits + ULP * (found.magnitude + size))
        off = np.maximum(2.0**-bits, _NEAREST * size) + (_GATHERED if self._kind == "gather" else 0)
        return widened(found, off + _NEAREST_RELATIVE * found.magnitude)

    def _shown(self, texel: Bounded, reference: Bounded | None) -> Bounded:
        """A texel, or 1 where a reference passes the comparison with a depth, else 0."""
        if reference is None:
            return texel
        passed = _COMPARISONS[self._image.state["compare"]](reference, texel)
        return passed.mapped(lambda array: array.astype(np.float64))

    def _anything(
        self, place: Place, level: Ints, every_level: bool = False
    ) -> tuple[Floats, Floats]:
        """The least and the greatest values for any place, one for each level."""
        lanes = 4 if self._kind == "gather" else 1
        if place.reference is not None:
            return np.zeros((lanes, len(level))), np.ones((lanes, len(level)))
        low, high = self._image.hull(level, self._lanes, every_level=every_level)
        return np.repeat(low, lanes, axis=0), np.repeat(high, lanes, axis=0)


def _floor(x: Floats) -> Ints:
    return np.floor(x).astype(np.int64)


def _floors(lane: Bounded) -> Choice:
    """The whole numbers of which the largest is not larger than the lane."""
    if lane.is_exact:
        return sure(_floor(lane.value))
    return Choice(*map(_floor, (lane.value, lane.low, lane.high)))


def _stacked(texels: Sequence[Bounded]) -> Bounded:
    """Texels of one lane as lanes of one read."""
    value = np.concatenate([texel.value for texel in texels])
    if all(texel.is_exact for texel in texels):
        return exact(value)
    low, high = ([getattr(x, end) for x in texels] for end in ("low", "high"))
    return Bounded(value, np.concatenate(low), np.concatenate(high))

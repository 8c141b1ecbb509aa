"""Looks up a texture's texels by their indices: in levels, layers, and beyond the edges.

The sampler makes an ``Image`` for each texture. Pixels are the last axis of all arrays here, and
the lanes of texels are the first.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....support.frozen import cached_property
from ...ir.leaves import Texture
from ...ir.types import AXES, TextureType
from ..bounds import Bounded, exact, hull
from ..namespace import Lanes
from .blending import BLENDING
from .canvas import with_missing
from .cube import FACES, across_edges, beyond_corner
from .intervals import increasing, widened
from .scene import Floats, Ints, RasterRules, Texels

_DECODING = 2.0**-22
"""The error of a texel that is not a float32, such as 1/255, relative to itself.

A device computes it from the bits that are stored.
"""

_SRGB_STEP = 1.05 * 0.5 / 255
"""The possible error of a device that decodes sRGB, in encoded units.

It is half a step of 8 bits (Direct3D 11.3 functional specification, 3.2.3.7), and the bend of the
curve within it. Its slope is that of IEC 61966-2-1. Vulkan, OpenGL and WebGPU name the curve, but
limit no error: there it is assumed, and Direct3D's exception is not, that 0 and 1 are exact.
"""

EVERY_LANE = slice(None)
_ON_BORDER = -1
"""The index of whatever is beyond an edge that has a border."""
BORDERS: Mapping[str, tuple[float, float]] = {
    "transparent": (0.0, 0.0), "black": (0.0, 1.0), "white": (1.0, 1.0),
}  # fmt: skip
"""The colours of borders: their first three lanes, and their alpha."""


class Image:
    """A texture's levels in one table, and its sampler's state."""

    def __init__(self, texels: Texels, texture: Texture, rules: RasterRules) -> None:
        assert isinstance(texture.type, TextureType)
        self.rules = rules
        self.type = texture.type
        self.state: Mapping[str, str] = dict(texture.state)
        shapes = [level.shape[:-1] if level.ndim == 4 else (1, *level.shape[:-1])
                  for level in texels.levels]  # fmt: skip
        layers, heights, widths = np.array(shapes).T
        self._border = layers * heights * widths
        """The number of the border's texel in each level, behind all others."""
        border = _border(self.state, texels)
        counts = self._border + len(border)
        self.stored = texels.stored
        self._starts = np.cumsum(counts) - counts
        self._table = _table(texels.levels, border)
        self._ends = None if self.is_exact else _ends_of(self._table, texels, border)
        """Between which numbers the texels of a device are, if it does not have just these."""
        self._size = np.stack([widths, heights, layers])
        self._slices = int(layers[0])
        """The layers of an array, with six for each cube, or the faces of a cube."""
        tables = (self._table, *(self._ends or ()))
        same = all(bool((table == table[:, :1]).all()) for table in tables)
        self.only = _lanes(self._texel_at(np.int64(0))) if same else None
        """The lanes of all texels, if they are the same."""

    @property
    def is_exact(self) -> bool:
        """True if the device reads texels without any error."""
        return self.rules.subtexel_bits is None

    @property
    def blending(self) -> float | None:
        """The error of one blend of two texels, relative to the larger one; ``None``: no error."""
        if self.is_exact:
            return None
        rules = self.rules
        bits = {"fixed": None, "half": rules.half_bits, "float": rules.float_bits}[self.stored]
        return BLENDING if bits is None else 2.0**-bits

    @property
    def of_products(self) -> float:
        """The error of the weight of one of the texels around a place, from its weights along the
        axes."""
        bits = self.rules.product_bits
        return 0.0 if bits is None else 2.0**-bits

    @property
    def has_known_steps(self) -> bool:
        """True if the device takes the steps of a quad as the reference does."""
        is_known = self.rules.footprint == "euclidean" and not self.type.is_cube
        return self.is_exact or is_known

    @property
    def levels(self) -> int:
        """The number of levels."""
        return len(self._starts)

    @property
    def layers(self) -> int:
        """The layers of an array, each of which may be a cube; 1 of any other texture."""
        if not self.type.layered:
            return 1
        return self._slices // FACES if self.type.is_cube else self._slices

    @property
    def has_one_level(self) -> bool:
        """True if all filtered reads use the same level."""
        return self.state["mip"] == "none" or self.levels == 1

    @property
    def axes(self) -> int:
        """The number of axes of a layer or face."""
        return 3 if self.type.dimension == "3d" else 2

    def sizes(self, level: Ints) -> list[Ints]:
        """The numbers of texels along each axis of a layer, or face, in these levels."""
        return [self._size[axis][level] for axis in range(self.axes)]

    @property
    def first_sizes(self) -> list[Ints]:
        """The sizes of the first level."""
        return self.sizes(np.zeros((), dtype=np.int64))

    def layer(self, number: Ints) -> Ints:
        """The nearest layer that exists."""
        return np.clip(number, 0, self.layers - 1)

    def load(self, place: Sequence[Ints], layer: Ints, level: Ints) -> Bounded:
        """Texels by their indices; out of bounds, the nearest ones."""
        level = np.clip(level, 0, self.levels - 1)
        sizes = self.sizes(level)
        within = [np.clip(i, 0, size - 1) for i, size in zip(place, sizes, strict=True)]
        return self._texels(within, self.layer(layer), level)

    def texel(
        self, place: Sequence[Ints], layer: Ints, level: Ints, lanes: slice = EVERY_LANE
    ) -> Bounded:
        """Texels as the sampler sees them: beyond the edges, too, but not beyond those of faces."""
        sizes = zip(place, self.sizes(level), self._wraps, strict=True)
        within = [_wrapped(i, size, wrap) for i, size, wrap in sizes]
        return self._texels(within, layer, level, lanes)

    def cell(
        self, first: Sequence[Ints], layer: Ints, level: Ints, lanes: slice = EVERY_LANE
    ) -> list[Bounded]:
        """The neighbouring texels that a linear filter blends; ``first`` has the least indices.

        They are in the order of their steps along the axes: (0, 0), (0, 1), (1, 0), (1, 1).
        """
        pairs = [(i, i + 1) for i in first]
        sizes = self.sizes(level)
        if self.type.is_cube:
            return [self._around_cube(place, layer, level, lanes) for place in product(*pairs)]
        within = [
            tuple(_wrapped(i, size, wrap) for i in pair)
            for pair, size, wrap in zip(pairs, sizes, self._wraps, strict=True)
        ]
        return [self._texels(place, layer, level, lanes) for place in product(*within)]

    def hull(
        self, level: Ints, lanes: slice = EVERY_LANE, *, every_level: bool = False
    ) -> tuple[Floats, Floats]:
        """The least and the greatest texels of each of these levels, or of all that there are."""
        least, greatest = (ends[lanes] for ends in self._hulls)
        if every_level:
            least, greatest = least.min(axis=1), greatest.max(axis=1)
            level, least, greatest = np.zeros_like(level), least[:, None], greatest[:, None]
        return least[:, level], greatest[:, level]

    @cached_property
    def _wraps(self) -> list[str]:
        """The texels beyond the edges along each axis."""
        if self.type.is_cube:
            return ["clamp"] * self.axes
        return [self.state.get(f"wrap_{axis}", self.state["wrap"]) for axis in AXES[: self.axes]]

    @cached_property
    def _hulls(self) -> tuple[Floats, Floats]:
        """The least and the greatest texel, for each lane and each level."""
        low, high = self._ends or (self._table, self._table)
        least = np.minimum.reduceat(low, self._starts, axis=1)
        return least, np.maximum.reduceat(high, self._starts, axis=1)

    def _around_cube(
        self, place: Sequence[Ints], number: Ints, level: Ints, lanes: slice
    ) -> Bounded:
        """Texels of a face or, beyond one of its edges, of its neighbours.

        ``number`` counts the faces of all cubes.
        Beyond a corner there is none. Vulkan recommends the mean of the three texels around it; a
        device may use one of them. Other methods are allowed as well, as long as they keep a value
        that all three have: devices take the mean of comparisons instead of depths, or something
        else, so that nothing more is known of a depth that is compared.
        """
        size = self.sizes(level)[0]
        cube, face = np.divmod(number, FACES)
        there, other = across_edges(place, face, size)
        within = [np.clip(i, 0, size - 1) for i in there]
        texel = self._texels(within, cube * FACES + other, level, lanes)
        beyond = beyond_corner(place, size)
        if not beyond.any():
            return texel
        inside = [np.clip(i, 0, size - 1) for i in place]
        three = [
            self._around_cube(around, number, level, lanes)
            for around in (inside, [inside[0], place[1]], [place[0], inside[1]])
        ]
        mean = increasing(lambda x, y, z: (x + y + z) / 3, *three)
        value = np.where(beyond, mean.value, texel.value)
        if self.is_exact:
            return exact(value)
        bits = self.rules.corner_bits
        if self.type.sample == "depth":
            found = _any_depth(mean, three)
        else:
            found = reduce(hull, three, mean) if bits is None else widened(mean, 2.0**-bits)
        low, high = np.where(beyond, found.low, texel.low), np.where(beyond, found.high, texel.high)
        return Bounded(value, low, high)

    def _texels(
        self, place: Sequence[Ints], layer: Ints, level: Ints, lanes: slice = EVERY_LANE
    ) -> Bounded:
        """Texels by indices that are within the texture, or on its border."""
        column, row = place[0], place[1]
        slice_ = place[2] if len(place) == 3 else layer
        row = slice_ * self._size[1][level] + row
        index = row * self._size[0][level] + column
        if "border" in self.state:
            outside = reduce(np.logical_or, (i == _ON_BORDER for i in place))
            index = np.where(outside, self._border[level], index)
        return self._texel_at(self._starts[level] + index, lanes)

    def _texel_at(self, index: Any, lanes: slice = EVERY_LANE) -> Bounded:
        """Texels by their numbers in the table."""
        found = self._table[lanes].take(index, axis=1)
        if self._ends is None:
            return exact(found)
        low, high = (end[lanes].take(index, axis=1) for end in self._ends)
        return Bounded(found, low, high)


def _border(state: Mapping[str, str], texels: Texels) -> Floats:
    """The texel of the border as a table of one row, or of none if there is no border.

    Lanes that the format lacks are what they are of its texels: APIs replace a texel, and make
    four lanes of it then.
    """
    count = texels.levels[0].shape[-1]
    if "border" not in state:
        return np.empty((0, count))
    value, alpha = BORDERS[state["border"]]
    return np.array([with_missing((value, value, value, alpha), texels.lanes)[:count]])


def _table(levels: Sequence[Floats | Ints], border: Floats) -> NDArray[Any]:
    """The texels of all levels, one behind the other: (lanes, texels).

    If there is a ``border``, its texel follows those of each level.
    """
    rows = [
        part.astype(level.dtype, copy=False)
        for level in levels
        for part in (level.reshape(-1, level.shape[-1]), border)
    ]
    return np.ascontiguousarray(np.concatenate(rows).T)


def _any_depth(mean: Bounded, three: Sequence[Bounded]) -> Bounded:
    """The depth of three texels if all have the same one, and else any."""
    x, y, z = (texel.value for texel in three)
    same = (x == y) & (y == z)
    return Bounded(mean.value, np.where(same, mean.low, 0.0), np.where(same, mean.high, 1.0))


def _ends_of(table: NDArray[Any], texels: Texels, border: Floats) -> tuple[Floats, Floats] | None:
    """The bounds of the texels that a device decodes; ``None`` if it reads just the table.

    The result of an earlier step is stored somewhere between its bounds, and is decoded then.
    """
    was_drawn = bool(texels.low)
    low, high = table, table
    if was_drawn:
        low, high = _table(texels.low, border), _table(texels.high, border)
    below, above = _errors_of(low, texels.is_srgb), _errors_of(high, texels.is_srgb)
    if below is not None:
        low = np.maximum(low - below, np.minimum(low, 0.0))
    if above is not None:
        high = high + above
    return (low, high) if was_drawn or below is not None else None


def _errors_of(table: NDArray[Any], is_srgb: bool) -> Floats | None:
    """The possible errors of devices that decode texels; ``None`` if all are float32."""
    if table.dtype.kind != "f":
        return None
    rounded = table != table.astype(np.float32)
    if not rounded.any() and not is_srgb:
        return None
    errors = np.where(rounded, np.abs(table) * _DECODING, 0.0)
    if is_srgb:
        errors[:3] = np.maximum(2.4 / 1.055 * table[:3] ** (1.4 / 2.4), 1 / 12.92) * _SRGB_STEP
    return errors


def _lanes(texel: Bounded) -> Lanes:
    """The lanes of a single texel."""
    if texel.is_exact:
        return tuple(map(exact, texel.value))
    return tuple(Bounded(*ends) for ends in zip(texel.value, texel.low, texel.high, strict=True))


def _wrapped(index: Ints, size: Ints, wrap: str) -> Ints:
    """The texel that an index outside of the texture means."""
    if wrap == "clamp":
        return np.clip(index, 0, size - 1)
    if wrap == "border":
        return np.where((index < 0) | (index >= size), _ON_BORDER, index)
    if np.min(index, initial=0) >= 0 and np.all(index < size):
        return index
    if wrap == "repeat":
        return index % size
    folded = index % (2 * size)
    return np.where(folded < size, folded, 2 * size - 1 - folded)

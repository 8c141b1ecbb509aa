"""Looks up a texture's texels by their indices: in levels, layers, and beyond the edges.

The sampler makes an ``Image`` for each texture.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ...ir.leaves import Resource
from ...ir.types import Texture
from ..namespace import Lanes
from .cube import across_edges
from .scene import Floats, Ints, RasterRules, Texels


class Image:
    """A texture's levels in one table, and its sampler's state."""

    def __init__(self, texels: Texels, resource: Resource, rules: RasterRules) -> None:
        assert isinstance(resource.type, Texture)
        self.rules = rules
        self.type = resource.type
        self.state: Mapping[str, str] = dict(resource.state)
        shapes = [level.shape[:-1] if level.ndim == 4 else (1, *level.shape[:-1])
                  for level in texels.levels]  # fmt: skip
        layers, heights, widths = np.array(shapes).T
        counts = layers * heights * widths
        self._starts = np.cumsum(counts) - counts
        self._table = np.concatenate(
            [level.reshape(-1, level.shape[-1]) for level in texels.levels]
        )
        self._size = np.stack([widths, heights, layers])
        self.layers = int(layers[0])
        """The layers of an array, or the faces of a cube."""
        same = bool((self._table == self._table[0]).all())
        self.only: Lanes | None = tuple(self._table[0].tolist()) if same else None
        """The value of all texels, if they are the same."""

    @property
    def levels(self) -> int:
        """The number of levels."""
        return len(self._starts)

    @property
    def axes(self) -> int:
        """The number of axes of a layer or face."""
        return 3 if self.type.dimension == "3d" else 2

    def sizes(self, level: Ints) -> list[Ints]:
        """The numbers of texels along each axis of a layer, or face, in these levels."""
        return [self._size[axis][level] for axis in range(self.axes)]

    def load(self, place: Sequence[Ints], layer: Ints, level: Ints) -> Floats | Ints:
        """Texels (…, lanes); out of bounds, the nearest ones."""
        level = np.clip(level, 0, self.levels - 1)
        sizes = self.sizes(level)
        within = [np.clip(i, 0, size - 1) for i, size in zip(place, sizes, strict=True)]
        return self._texels(within, self.layer(layer), level)

    def layer(self, number: Ints) -> Ints:
        """The nearest layer that exists."""
        return np.clip(number, 0, self.layers - 1)

    def texel(self, place: Sequence[Ints], layer: Ints, level: Ints) -> Floats:
        """Texels (…, lanes) as the sampler sees them, also beyond the edges."""
        sizes = self.sizes(level)
        if self.type.dimension == "cube":
            place, layer = across_edges(place, layer, sizes[0])
        wrap = self.state["wrap"]
        within = [_wrapped(i, size, wrap) for i, size in zip(place, sizes, strict=True)]
        return self._texels(within, layer, level)

    def _texels(self, place: Sequence[Ints], layer: Ints, level: Ints) -> Floats:
        """Texels by indices that are within the texture."""
        column, row = place[0], place[1]
        slice_ = place[2] if len(place) == 3 else layer
        row = slice_ * self._size[1][level] + row
        index = self._starts[level] + row * self._size[0][level] + column
        found: Floats = np.take(self._table, index, axis=0)
        return found


def _wrapped(index: Ints, size: Ints, wrap: str) -> Ints:
    """The texel that an index outside of the texture means."""
    if wrap == "clamp":
        return np.clip(index, 0, size - 1)
    if wrap == "repeat":
        return index % size
    folded = index % (2 * size)
    return np.where(folded < size, folded, 2 * size - 1 - folded)

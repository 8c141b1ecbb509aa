"""The textures of a frame that the reference draws, with the bounds of a device's values.

``by_reference.py`` makes and reads them. ``load`` puts the contents that a step finds on a canvas,
and ``store`` keeps those that it leaves.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....compiler.documents.plan import (
    AttachmentRow,
    DrawStep,
    FrameTextureRow,
    ResolveRow,
)
from ....compiler.ir.image_sizes import halved
from ....compiler.reference.picture import (
    NOWHERE,
    Canvas,
    Hulls,
    RasterRules,
    Stored,
    Texels,
    depth_ends,
    expected_on,
    formats,
    samples_on,
)

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

DEPTHS, STENCILS = "depth", "stencil8"
"""The beginning of depth formats, and their ending if there are stencil values."""
_BESIDE = 20
"""Bytes of each texel besides its lanes: the undecided mark, stencil values, and faces."""
_ENDS = 3
"""The numbers for each value: the value itself, and the bounds of a device's value."""


@dataclass(eq=False, slots=True)
class DrawnTexture:
    """A texture while a frame is drawn.

    If its texels have several samples, these follow each other in the row, as if the row were
    several times as wide.
    """

    format: str
    dimension: str
    levels: list[Floats]
    """For each level (3, layers, height, width, lanes): values, and their lower and upper
    bounds."""
    undecided: list[Bools]
    """For each level (layers, height, width): the pixels that depend on rounding."""
    stencil: list[NDArray[np.int64]]
    """For each level (layers, height, width): the stencil values; empty if there are none."""
    stencil_unsure: list[Bools]
    """For each level (layers, height, width): True where a device may have another stencil
    value."""
    faces: list[NDArray[np.int64]]
    """For each level of depths (layers, height, width): the face of each depth, by the number of
    its place; empty if there are none."""

    @classmethod
    def empty(cls, row: FrameTextureRow, size: tuple[int, int]) -> DrawnTexture:
        """A cleared texture: transparent black, or depths at the far plane."""
        lanes, value = (1, 1.0) if row.format.startswith(DEPTHS) else (4, 0.0)
        levels = []
        for level in range(row.levels):
            width, height = (halved(side, level) for side in size)
            shape = _ENDS, row.layers, height, width * row.samples, lanes
            levels.append(np.full(shape, value))
        undecided = [np.zeros(level.shape[1:4], np.bool_) for level in levels]
        beside = undecided if row.format.endswith(STENCILS) else []
        stencil = [np.zeros(level.shape, np.int64) for level in beside]
        unsure = [level.copy() for level in beside]
        deep = undecided if row.format.startswith(DEPTHS) else []
        faces = [np.full(level.shape, NOWHERE) for level in deep]
        return cls(row.format, row.dimension, levels, undecided, stencil, unsure, faces)

    @property
    def lanes(self) -> int:
        """The number of lanes of the texture's format."""
        return 1 if self.format.startswith(DEPTHS) else formats.lanes_of(self.format)

    def texels(self) -> Texels:
        """The texture as a shader reads it."""
        flat = self.dimension == "2d"
        value, low, high = (
            tuple(level[end, 0] if flat else level[end] for level in self.levels)
            for end in range(_ENDS)
        )
        has_undefined = any(
            bool(np.isnan(level[0][undecided]).any())
            for level, undecided in zip(self.levels, self.undecided, strict=True)
        )
        is_srgb = self.format.endswith("srgb")
        return Texels(value, is_srgb, low, high, has_undefined, self._stored, self.lanes)

    @property
    def _stored(self) -> Stored:
        """The kind of the format's numbers."""
        if self.format.startswith(DEPTHS):
            return "float"
        return formats.format_of(self.format).stored

    def arrays(self, layer: int, level: int) -> Iterator[NDArray[Any]]:
        """All that is kept of one layer and level, as views of it."""
        yield self.levels[level][:, layer]
        for kept in (self.undecided, self.stencil, self.stencil_unsure, self.faces):
            if kept:
                yield kept[level][layer]

    def copy(self) -> DrawnTexture:
        """A texture of its own with the same contents."""
        return deepcopy(self)


def size_of_drawn(row: FrameTextureRow, size: tuple[int, int]) -> int:
    """The bytes of a plan's texture, with its levels and the marks beside them."""
    width, height = size
    texels = sum(halved(width, level) * halved(height, level) for level in range(row.levels))
    lanes = 1 if row.format.startswith(DEPTHS) else 4
    return texels * row.layers * row.samples * (_ENDS * lanes * 8 + _BESIDE)


Textures = Mapping[int, DrawnTexture]
"""All textures of a frame, by their numbers in the plan."""


# --- contents before a step ----------------------------------------------------------------------


def load(canvas: Canvas, hulls: Hulls, step: DrawStep, layer: int, textures: Textures) -> None:
    """Put the contents of attachments on a canvas, with the range of undecided samples."""
    for number, target in enumerate(step.targets):
        if target.load == "load":
            there = _samples(target, layer, textures)
            canvas.targets[number][:] = there
            hulls.targets[number][:] = there[1:]
    depth = step.depth
    if depth is not None and depth.load == "load":
        value, low, high = there = _samples(depth, layer, textures)[..., 0]
        canvas.depth[:] = value
        canvas.depth_off[:] = np.maximum(high - value, value - low)
        texture, at, level = place_of(depth, layer)
        canvas.place[:] = textures[texture].faces[level][at].ravel()
        hulls.depth[:] = there[1:]
        _load_stencil(canvas, depth, layer, textures)
    for target in step.attachments:
        if target.load == "load":
            texture, at, level = place_of(target, layer)
            canvas.shaky |= textures[texture].undecided[level][at].ravel()


def _load_stencil(canvas: Canvas, depth: AttachmentRow, layer: int, textures: Textures) -> None:
    texture, at, level = place_of(depth, layer)
    kept = textures[texture]
    if kept.stencil:
        canvas.stencil.values[:] = kept.stencil[level][at].ravel()
        canvas.stencil.unsure[:] = kept.stencil_unsure[level][at].ravel()


def _samples(target: AttachmentRow, layer: int, textures: Textures) -> Floats:
    """The contents of a layer and level: (3, samples, lanes)."""
    texture, at, level = place_of(target, layer)
    found = textures[texture].levels[level][:, at]
    return found.reshape(_ENDS, -1, found.shape[-1])


# --- contents after a step -----------------------------------------------------------------------


def store(
    canvas: Canvas, hulls: Hulls, step: DrawStep, layer: int, rules: RasterRules, textures: Textures
) -> None:
    """Keep the samples that were drawn and, where the plan resolves them, their means."""
    picture = expected_on(canvas, rules, hulls=hulls)
    undecided = canvas.undecided | canvas.shaky
    for number, target in enumerate(step.targets):
        mean: AttachmentRow | ResolveRow | None = target
        if rules.samples > 1:
            samples = samples_on(canvas, number, hulls)
            _keep(place_of(target, layer), samples, undecided, textures)
            mean = target.resolve
        if mean is not None:
            ends = picture.targets[number], picture.low[number], picture.high[number]
            _keep(place_of(mean, layer), ends, picture.undecided, textures)
    if step.depth is not None:
        texture, at, level = place = place_of(step.depth, layer)
        _keep(place, depth_ends(canvas, hulls), undecided, textures)
        faces = textures[texture].faces[level]
        faces[at] = canvas.place.reshape(faces[at].shape)
        _keep_stencil(step.depth, layer, canvas, textures)


def _keep(
    place: tuple[int, int, int], ends: Iterable[Floats], undecided: Bools, textures: Textures
) -> None:
    """Keep values and their bounds, of samples in the order of the texture's rows."""
    texture, at, level = place
    drawn = textures[texture]
    has_depths = drawn.format.startswith(DEPTHS)
    for kept, end in zip(drawn.levels[level][:, at], ends, strict=True):
        values = end if has_depths else formats.clamped(drawn.format, end)
        kept[:] = values.reshape(kept.shape)
    drawn.undecided[level][at] = undecided.reshape(drawn.undecided[level][at].shape)


def _keep_stencil(depth: AttachmentRow, layer: int, canvas: Canvas, textures: Textures) -> None:
    texture, at, level = place_of(depth, layer)
    drawn = textures[texture]
    if drawn.stencil:
        shape = drawn.stencil[level][at].shape
        drawn.stencil[level][at] = canvas.stencil.values.reshape(shape)
        drawn.stencil_unsure[level][at] = canvas.stencil.unsure.reshape(shape)


def place_of(target: AttachmentRow | ResolveRow, layer: int) -> tuple[int, int, int]:
    """The texture, the layer and the level where a step that draws to ``layer`` keeps something."""
    at = layer if target.layer is None else target.layer
    return target.texture, at, target.level

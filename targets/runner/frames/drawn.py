"""The textures of a frame that the reference draws, with the bounds of what a device has in them.

``by_reference.py`` makes and reads them. ``load`` puts on a canvas what a step finds there, and
``store`` keeps what it leaves.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from copy import deepcopy
from dataclasses import dataclass

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
    Texels,
    expected_on,
    formats,
    samples_on,
)

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

DEPTHS, STENCILS = "depth", "stencil8"
"""The beginning of depth formats, and their ending if there are stencil values."""
_BESIDE = 20
"""Bytes of each texel besides its lanes: what is undecided, stencil values, and faces."""
_ENDS = 3
"""A value, and between which numbers that of a device is."""


@dataclass(eq=False, slots=True)
class Drawn:
    """A texture while a frame is drawn. If its texels have several samples, these stand one behind
    the other in the row, as if it were so many times as wide."""

    format: str
    dimension: str
    levels: list[Floats]
    """Of each level (3, layers, height, width, lanes): values, and their lower and upper ends."""
    undecided: list[Bools]
    """Of each level (layers, height, width): the pixels that hang on rounding."""
    stencil: list[NDArray[np.int64]]
    """Of each level (layers, height, width): the values beside depths; empty if there are none."""
    stencil_unsure: list[Bools]
    """Likewise: where a device may have another one."""
    faces: list[NDArray[np.int64]]
    """Of each level of depths (layers, height, width): of which face each is, by the number of its
    place; empty if there are none."""

    @classmethod
    def empty(cls, row: FrameTextureRow, size: tuple[int, int]) -> Drawn:
        """Transparent black, or as far away as can be."""
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
        """How many lanes its format has."""
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
        return Texels(value, self.format.endswith("srgb"), low, high, has_undefined)

    def copy(self) -> Drawn:
        """The same contents in a texture of its own."""
        return deepcopy(self)


def size_of_drawn(row: FrameTextureRow, size: tuple[int, int]) -> int:
    """How many bytes a texture of a plan takes, with its levels and what is noted beside it."""
    width, height = size
    texels = sum(halved(width, level) * halved(height, level) for level in range(row.levels))
    lanes = 1 if row.format.startswith(DEPTHS) else 4
    return texels * row.layers * row.samples * (_ENDS * lanes * 8 + _BESIDE)


Textures = Mapping[int, Drawn]
"""All of a frame, by their numbers in the plan."""


# --- what a step finds ---------------------------------------------------------------------------


def load(canvas: Canvas, hulls: Hulls, step: DrawStep, layer: int, textures: Textures) -> None:
    """Put what is there before on a canvas, and what undecided samples of it may be."""
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
        texture, at, level = _place(depth, layer)
        canvas.place[:] = textures[texture].faces[level][at].ravel()
        hulls.depth[:] = there[1:]
        _load_stencil(canvas, depth, layer, textures)
    for target in step.attachments:
        if target.load == "load":
            texture, at, level = _place(target, layer)
            canvas.shaky |= textures[texture].undecided[level][at].ravel()


def _load_stencil(canvas: Canvas, depth: AttachmentRow, layer: int, textures: Textures) -> None:
    texture, at, level = _place(depth, layer)
    kept = textures[texture]
    if kept.stencil:
        canvas.stencil.values[:] = kept.stencil[level][at].ravel()
        canvas.stencil.unsure[:] = kept.stencil_unsure[level][at].ravel()


def _samples(target: AttachmentRow, layer: int, textures: Textures) -> Floats:
    """The contents of a layer and level: (3, samples, lanes)."""
    texture, at, level = _place(target, layer)
    found = textures[texture].levels[level][:, at]
    return found.reshape(_ENDS, -1, found.shape[-1])


# --- what a step leaves --------------------------------------------------------------------------


def store(
    canvas: Canvas, hulls: Hulls, step: DrawStep, layer: int, rules: RasterRules, textures: Textures
) -> None:
    """Keep what was drawn: all samples and, where the plan resolves them, their means."""
    picture = expected_on(canvas, rules, hulls=hulls)
    undecided = canvas.undecided | canvas.shaky
    for number, target in enumerate(step.targets):
        mean: AttachmentRow | ResolveRow | None = target
        if rules.samples > 1:
            samples = samples_on(canvas, number, hulls)
            _keep(_place(target, layer), samples, undecided, textures)
            mean = target.resolve
        if mean is not None:
            ends = picture.targets[number], picture.low[number], picture.high[number]
            _keep(_place(mean, layer), ends, picture.undecided, textures)
    if step.depth is not None:
        value, off = canvas.depth, canvas.depth_off
        low, high = (
            np.where(undecided, *ends)
            for ends in zip(hulls.depth, (value - off, value + off), strict=True)
        )
        texture, at, level = place = _place(step.depth, layer)
        _keep(place, (value, low, high), undecided, textures)
        faces = textures[texture].faces[level]
        faces[at] = canvas.place.reshape(faces[at].shape)
        _keep_stencil(step.depth, layer, canvas, textures)


def _keep(
    place: tuple[int, int, int], ends: Iterable[Floats], undecided: Bools, textures: Textures
) -> None:
    """Keep values and their ends, of samples in the order of the texture's rows."""
    texture, at, level = place
    drawn = textures[texture]
    has_depths = drawn.format.startswith(DEPTHS)
    for kept, end in zip(drawn.levels[level][:, at], ends, strict=True):
        values = np.clip(end, 0.0, 1.0) if has_depths else formats.clamped(drawn.format, end)
        kept[:] = values.reshape(kept.shape)
    drawn.undecided[level][at] = undecided.reshape(drawn.undecided[level][at].shape)


def _keep_stencil(depth: AttachmentRow, layer: int, canvas: Canvas, textures: Textures) -> None:
    texture, at, level = _place(depth, layer)
    drawn = textures[texture]
    if drawn.stencil:
        shape = drawn.stencil[level][at].shape
        drawn.stencil[level][at] = canvas.stencil.values.reshape(shape)
        drawn.stencil_unsure[level][at] = canvas.stencil.unsure.reshape(shape)


def _place(target: AttachmentRow | ResolveRow, layer: int) -> tuple[int, int, int]:
    at = layer if target.layer is None else target.layer
    return target.texture, at, target.level

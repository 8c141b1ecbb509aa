"""What a pipeline reads and writes besides vertices and targets, and where each is bound."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ....compiler.ir.render_state import Compare
from .render_state import TargetFormat
from .texels import Dimension, Sample

Filter = Literal["linear", "nearest"]
Mip = Literal["linear", "nearest", "none"]
Wrap = Literal["repeat", "clamp", "mirror"]
Sampling = Literal["filtering", "non-filtering", "comparison"]
"""How a shader uses a sampler."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where a block, texture or sampler is bound."""

    identifier: str
    """Its name in the text; OpenGL binds by it."""
    group: int | None
    """The descriptor set or bind group; ``None`` if it is bound by name."""
    binding: int | None


@dataclass(frozen=True, slots=True)
class UniformSlot:
    """A uniform on its own, which has the value of a member of a block."""

    identifier: str
    """Its name in the text."""
    offset: int
    """The byte of the block where its value begins."""
    size: int


@dataclass(frozen=True, slots=True)
class BlockSlot:
    """A uniform block of the pipeline."""

    place: Place
    size: int
    """The number of bytes."""
    uniforms: tuple[UniformSlot, ...] = ()
    """What the text has instead, if it has no blocks."""


@dataclass(frozen=True, slots=True)
class BufferSlot:
    """A storage buffer of the pipeline."""

    place: Place
    stride: int
    """The number of bytes from one element to the next."""
    written: bool = False
    """Whether a kernel writes it; all others are only read."""


@dataclass(frozen=True, slots=True)
class ImageSlot:
    """An image of the pipeline, which a kernel writes."""

    place: Place
    format: TargetFormat


@dataclass(frozen=True, slots=True)
class TextureSlot:
    """A texture of the pipeline with the sampler that reads it."""

    texture: Place
    sampler: Place | None
    """``None`` if texture and sampler are one object, bound at ``texture``, or if there is no
    sampler."""
    filter: Filter = "linear"
    mip: Mip = "linear"
    wrap: Wrap = "repeat"
    compare: Compare | None = None
    """How the sampler compares a reference with depths; ``None`` if it does not."""
    dimension: Dimension = "2d"
    sample: Sample = "float"
    sampling: Sampling | None = "filtering"
    """``None`` if texels are only loaded, without a sampler."""

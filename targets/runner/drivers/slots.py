"""The bindings of a pipeline: its blocks, buffers, images and textures, and where each is bound."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ....compiler.ir.render_state import Compare
from ....compiler.ir.types import Border, Wrap
from .render_state import TargetFormat
from .texels import Dimension, Sample

Filter = Literal["linear", "nearest"]
Mip = Literal["linear", "nearest", "none"]
Sampling = Literal["filtering", "non-filtering", "comparison"]
"""The use of a sampler by a shader."""


@dataclass(frozen=True, slots=True)
class Place:
    """The binding of a block, buffer, texture or sampler."""

    identifier: str
    """The name in the text; OpenGL binds by it."""
    group: int | None
    """The descriptor set or bind group; ``None`` if it is bound by name."""
    binding: int | None


@dataclass(frozen=True, slots=True)
class UniformSlot:
    """A loose uniform, which has the value of a member of a block."""

    identifier: str
    """The uniform's name in the text."""
    offset: int
    """The byte of the block at which the value begins."""
    size: int


@dataclass(frozen=True, slots=True)
class BlockSlot:
    """A uniform block of the pipeline."""

    place: Place
    size: int
    """The block's size in bytes."""
    uniforms: tuple[UniformSlot, ...] = ()
    """The loose uniforms that replace the block, if the text has no blocks."""
    pushed: bool = False
    """True for push constants, which have no place. Only Vulkan has them."""


@dataclass(frozen=True, slots=True)
class BufferSlot:
    """A storage buffer of the pipeline."""

    place: Place
    stride: int
    """The number of bytes from one element to the next."""
    written: bool = False
    """True if a kernel writes the buffer; all others are only read."""


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
    """The sampler's binding; ``None`` if texture and sampler are one object, bound at ``texture``,
    or if there is no sampler."""
    filter: Filter = "linear"
    mip: Mip = "linear"
    wrap: Wrap = "repeat"
    wrap_u: Wrap | None = None
    """The texels beyond the edges of one axis; ``None`` if they are as ``wrap`` says."""
    wrap_v: Wrap | None = None
    wrap_w: Wrap | None = None
    border: Border | None = None
    """The texel of a border, if there is one."""
    border_color: tuple[float, float, float, float] | None = None
    """A border of any colour in place of ``border``. Only the driver for OpenGL has it: no text of
    Burnish asks for one, but texts of others may."""
    compare: Compare | None = None
    """The comparison of a reference with depths; ``None`` if the sampler does not compare."""
    anisotropy: int = 1
    """The most samples along the longer side of a footprint. Only packages for web pages say more
    than 1: no API says what such a filter computes, so what is compared is drawn without it."""
    combined: bool = False
    """True if a descriptor has to be of a texture and a sampler in one, even if nothing samples.
    Where something does, a texture without a sampler's place is one anyway."""
    dimension: Dimension = "2d"
    sample: Sample = "float"
    sampling: Sampling | None = "filtering"
    """The use of the sampler; ``None`` if texels are only loaded, without a sampler."""

    @property
    def wraps(self) -> tuple[Wrap, Wrap, Wrap]:
        """The texels beyond the edges of each axis."""
        return self.wrap_u or self.wrap, self.wrap_v or self.wrap, self.wrap_w or self.wrap

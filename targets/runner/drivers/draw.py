"""What a driver is asked to draw and what it answers: plain data, the same for every API.

A job is one pipeline and several draws with it, because making a pipeline costs a driver far more
than drawing with it. Everything is as the shader wants it: who fills this in has resolved names to
bindings and values to bytes.

Pictures have their first row on top, whatever the API's framebuffer does, and each draw starts from
a cleared picture and a depth of 1; the nearer fragment wins (``less``).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

VertexFormat = Literal[
    "float32", "float32x2", "float32x3", "float32x4",
    "sint32", "sint32x2", "sint32x3", "sint32x4",
    "uint32", "uint32x2", "uint32x3", "uint32x4",
]  # fmt: skip
"""WebGPU's names: kind of a lane and number of lanes, tightly packed."""

Step = Literal["vertex", "instance"]
"""How often an attribute goes on to its next value."""

TextureFormat = Literal["rgba8unorm", "rgba8unorm-srgb", "rgba32float"]
TargetFormat = Literal[
    "r32float", "rg32float", "rgba32float", "r8unorm", "rg8unorm", "rgba8unorm", "rgba8unorm-srgb",
    "r16float", "rg16float", "rgba16float",
]  # fmt: skip

Filter = Literal["linear", "nearest"]
Mip = Literal["linear", "nearest", "none"]
Wrap = Literal["repeat", "clamp", "mirror"]
Blend = Literal["none", "alpha", "premultiplied", "add", "multiply"]
Cull = Literal["none", "back", "front"]


@dataclass(frozen=True, slots=True)
class Code:
    """One stage as a driver takes it: SPIR-V for Vulkan, else text."""

    entry: str
    text: str = ""
    spirv: bytes = b""


@dataclass(frozen=True, slots=True)
class VertexInput:
    """A vertex attribute of the pipeline; each is given by itself."""

    identifier: str
    """Its name in the text."""
    location: int
    format: VertexFormat
    step: Step = "vertex"


@dataclass(frozen=True, slots=True)
class Place:
    """Where a block, texture or sampler is bound."""

    identifier: str
    """Its name in the text, by which GL binds."""
    group: int | None
    """Descriptor set or bind group; ``None`` where there is only the name."""
    binding: int | None


@dataclass(frozen=True, slots=True)
class BlockSlot:
    """A uniform block of the pipeline."""

    place: Place
    size: int
    """Bytes."""


@dataclass(frozen=True, slots=True)
class TextureSlot:
    """A texture of the pipeline with the sampler that reads it."""

    texture: Place
    sampler: Place | None
    """``None`` where texture and sampler are one object, bound at ``texture``."""
    filter: Filter = "linear"
    mip: Mip = "linear"
    wrap: Wrap = "repeat"


@dataclass(frozen=True, slots=True)
class Target:
    """One render target."""

    format: TargetFormat
    blend: Blend = "none"


@dataclass(frozen=True, slots=True)
class Pipeline:
    """Everything about drawing that is the same for all draws of a job."""

    vertex: Code
    fragment: Code
    inputs: tuple[VertexInput, ...]
    blocks: tuple[BlockSlot, ...]
    textures: tuple[TextureSlot, ...]
    targets: tuple[Target, ...]
    """In the order of their locations."""
    cull: Cull = "none"
    flip_y: bool = False
    """Whether the text negates clip y; by this a Vulkan driver chooses its viewport."""
    front_face: Literal["ccw", "cw"] = "ccw"
    """The winding to be set as front, as the API judges it."""
    first_row: Literal["top", "bottom"] = "top"
    """Which row of the picture comes first in the framebuffer's memory."""
    host_uniforms: tuple[str, ...] = ()
    """Loose float uniforms that get the picture's height (the reflection's ``host_uniforms``)."""


@dataclass(frozen=True, slots=True)
class Image:
    """A texture's texels, mip levels and all, the first row on top."""

    format: TextureFormat
    width: int
    """Of the first level; each further one halves both, rounding down, to no less than 1."""
    height: int
    levels: tuple[bytes, ...]


@dataclass(frozen=True, slots=True)
class Draw:
    """One picture: the bytes for every slot of the pipeline, in its order."""

    width: int
    height: int
    vertex_count: int
    vertices: tuple[bytes, ...]
    """For each of ``Pipeline.inputs`` the values of all vertices, or of all instances."""
    indices: bytes
    """uint32, three for each triangle; their first is the provoking vertex."""
    blocks: tuple[bytes, ...]
    textures: tuple[Image, ...]
    clear: tuple[tuple[float, float, float, float], ...]
    """One colour for each target."""
    instance_count: int = 1


@dataclass(frozen=True, slots=True)
class Job:
    """A pipeline and what to draw with it."""

    pipeline: Pipeline
    draws: tuple[Draw, ...]


@dataclass(frozen=True, slots=True)
class Picture:
    """What one draw left in the targets."""

    width: int
    height: int
    targets: tuple[bytes, ...]
    """For each target float32 RGBA, row by row from the top; lanes the format lacks are 0, 0, 1."""


@dataclass(frozen=True, slots=True)
class Device:
    """What a driver says of itself."""

    name: str
    """``llvmpipe (LLVM 15.0.6, 256 bits)``."""
    version: str
    """Of the driver: ``Mesa 22.3.6``."""
    subpixel_bits: int
    """To how many binary places of a pixel vertices are snapped."""
    subtexel_bits: int
    """Binary places of a linear filter's weights; 0 where the API does not tell."""
    mip_bits: int
    """Likewise, of the weights between mip levels."""


class DriverError(Exception):
    """A driver could not draw; the text says why, for people."""

"""What a driver is asked to draw and what it answers: plain data, the same for every API.

A job is one pipeline and several draws with it, because making a pipeline costs a driver far more
than drawing with it. Everything is as the shader wants it: who fills this in has resolved names to
bindings and values to bytes.

Pictures have their first row on top, whatever the API's framebuffer does, and each draw starts from
a cleared picture and a depth of 1; the nearer fragment wins (``less``).
"""

from __future__ import annotations

from collections.abc import Mapping
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

TextureFormat = Literal[
    "rgba8unorm", "rgba8unorm-srgb", "rgba32float", "depth32float",
    "r8uint", "rgba8uint", "r32uint", "rgba32uint", "r32sint", "rgba32sint",
]  # fmt: skip
TargetFormat = Literal[
    "r32float", "rg32float", "rgba32float", "r8unorm", "rg8unorm", "rgba8unorm", "rgba8unorm-srgb",
    "r16float", "rg16float", "rgba16float",
]  # fmt: skip

Dimension = Literal["2d", "2d_array", "3d", "cube"]
Sample = Literal["float", "unfilterable-float", "depth", "sint", "uint"]
"""What a shader reads from a texture; the second is a promise that nothing filters it."""
Sampling = Literal["filtering", "non-filtering", "comparison"]
"""How a shader uses a sampler."""

Filter = Literal["linear", "nearest"]
Mip = Literal["linear", "nearest", "none"]
Wrap = Literal["repeat", "clamp", "mirror"]
Compare = Literal[
    "never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"
]
"""The reference, on the left, with a depth."""
Blend = Literal["none", "alpha", "premultiplied", "add", "multiply"]
Cull = Literal["none", "back", "front"]


@dataclass(frozen=True, slots=True)
class Texel:
    """How a ``TextureFormat`` lies in memory."""

    lanes: int
    """1 or 4; the others of a single one read as 0, 0, 1."""
    kind: Literal["u1", "<u4", "<i4", "<f4"]
    """Of a lane, in NumPy's words."""
    sample: Sample

    @property
    def size(self) -> int:
        """Bytes."""
        return self.lanes * int(self.kind[-1])


TEXELS: Mapping[TextureFormat, Texel] = {
    "rgba8unorm": Texel(4, "u1", "float"),
    "rgba8unorm-srgb": Texel(4, "u1", "float"),
    "rgba32float": Texel(4, "<f4", "float"),
    "depth32float": Texel(1, "<f4", "depth"),
    "r8uint": Texel(1, "u1", "uint"),
    "rgba8uint": Texel(4, "u1", "uint"),
    "r32uint": Texel(1, "<u4", "uint"),
    "rgba32uint": Texel(4, "<u4", "uint"),
    "r32sint": Texel(1, "<i4", "sint"),
    "rgba32sint": Texel(4, "<i4", "sint"),
}


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
    """``None`` where texture and sampler are one object, bound at ``texture``; and where there is
    no sampler."""
    filter: Filter = "linear"
    mip: Mip = "linear"
    wrap: Wrap = "repeat"
    compare: Compare | None = None
    """How the sampler compares a reference with depths; ``None`` where it does not."""
    dimension: Dimension = "2d"
    sample: Sample = "float"
    sampling: Sampling | None = "filtering"
    """``None`` where texels are only loaded, without a sampler."""


@dataclass(frozen=True, slots=True)
class Target:
    """One render target."""

    format: TargetFormat
    blend: Blend = "none"


@dataclass(frozen=True, slots=True)
class Pipeline:
    """Everything about drawing that is the same for all draws of a job."""

    stages: Mapping[str, Code]
    """By the name of the stage, in pipeline order."""
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
    """A texture's texels, mip levels and all.

    Row by row, the first on top (at v = 0); then layer by layer, or slice by slice of a volume, or
    face by face of a cube: +x, -x, +y, -y, +z, -z, each as all APIs turn it.
    """

    format: TextureFormat
    width: int
    """Of the first level; each further one halves both, rounding down, to no less than 1."""
    height: int
    levels: tuple[bytes, ...]
    dimension: Dimension = "2d"
    depth: int = 1
    """Layers, faces, or the slices of a volume's first level, which are halved likewise."""


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

"""Jobs and pictures: what a driver is asked to draw, and its answer, as plain data for every API.

A job is one pipeline and several draws with it, because making a pipeline takes a driver much
longer than drawing. ``runner.py`` sends jobs; names have already been resolved to bindings, and
values to bytes.

The first row of a picture is the top one, whatever the API's framebuffer does. Each draw starts
with a cleared picture and cleared depths.
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
"""WebGPU's names: the type of a lane and the number of lanes, tightly packed."""

StepMode = Literal["vertex", "instance"]
"""When an attribute advances to its next value."""

TextureFormat = Literal[
    "rgba8unorm", "rgba8unorm-srgb", "rgba32float", "depth32float",
    "r8uint", "rgba8uint", "r32uint", "rgba32uint", "r32sint", "rgba32sint",
]  # fmt: skip
TargetFormat = Literal[
    "r32float", "rg32float", "rgba32float", "r8unorm", "rg8unorm", "rgba8unorm", "rgba8unorm-srgb",
    "r16float", "rg16float", "rgba16float",
]  # fmt: skip

DepthFormat = Literal["depth32float", "depth32float-stencil8"]
"""Of the depths that are drawn to, and of the stencil values beside them."""

Primitive = Literal["point", "line", "triangle", "line_adjacency", "triangle_adjacency", "patch"]
"""What the vertices are, in turn. Triangles and lines are drawn as they are; all others need a
geometry stage, and patches need the stages of tessellation instead."""

CORNERS: Mapping[Primitive, int] = {
    "point": 1, "line": 2, "triangle": 3, "line_adjacency": 4, "triangle_adjacency": 6,
}  # fmt: skip
"""How many vertices each of them has, but for patches: a pipeline says how many theirs have."""

Sides = tuple[int, int, int]
"""Lengths along x, y and z."""

Dimension = Literal["2d", "2d_array", "3d", "cube"]
Sample = Literal["float", "unfilterable-float", "depth", "sint", "uint"]
"""What a shader reads from a texture; ``unfilterable-float`` promises that it never filters."""
Sampling = Literal["filtering", "non-filtering", "comparison"]
"""How a shader uses a sampler."""

Filter = Literal["linear", "nearest"]
Mip = Literal["linear", "nearest", "none"]
Wrap = Literal["repeat", "clamp", "mirror"]
Compare = Literal[
    "never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"
]
"""How the reference, or the depth of a fragment, on the left, is compared with a depth."""
Factor = Literal[
    "zero", "one", "src", "one_minus_src", "src_alpha", "one_minus_src_alpha", "dst",
    "one_minus_dst", "dst_alpha", "one_minus_dst_alpha", "src_alpha_saturated", "constant",
    "one_minus_constant",
]  # fmt: skip
"""By what a side is multiplied when colours are blended: the source is what is drawn, the
destination what is there."""
Operation = Literal["add", "subtract", "reverse_subtract", "min", "max"]
"""How the two products are joined; ``min`` and ``max`` have factors of ``one``."""
Cull = Literal["none", "back", "front"]
"""Which triangles are not drawn."""
Winding = Literal["ccw", "cw"]
"""How the corners of a front go around."""
Fill = Literal["faces", "lines"]
"""What is drawn of triangles: all of them, or their edges."""
StencilOperation = Literal[
    "keep", "zero", "replace", "invert",
    "increment_clamp", "decrement_clamp", "increment_wrap", "decrement_wrap",
]  # fmt: skip
"""What becomes of a stencil value."""


@dataclass(frozen=True, slots=True)
class Texel:
    """The memory layout of a ``TextureFormat``."""

    lanes: int
    """1 or 4; if it is 1, a shader reads 0, 0, 1 for the others."""
    kind: Literal["u1", "<u4", "<i4", "<f4"]
    """The type of a lane, as NumPy spells it."""
    sample: Sample

    @property
    def size(self) -> int:
        """The number of bytes."""
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
    """One stage in the form that a driver takes: SPIR-V for Vulkan, otherwise text."""

    entry: str
    text: str = ""
    spirv: bytes = b""


@dataclass(frozen=True, slots=True)
class VertexInput:
    """A vertex attribute of the pipeline; each has a buffer of its own."""

    identifier: str
    """Its name in the text."""
    location: int
    format: VertexFormat
    step: StepMode = "vertex"


@dataclass(frozen=True, slots=True)
class Place:
    """Where a block, texture or sampler is bound."""

    identifier: str
    """Its name in the text; OpenGL binds by it."""
    group: int | None
    """The descriptor set or bind group; ``None`` if it is bound by name."""
    binding: int | None


@dataclass(frozen=True, slots=True)
class BlockSlot:
    """A uniform block of the pipeline."""

    place: Place
    size: int
    """The number of bytes."""


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


@dataclass(frozen=True, slots=True)
class BlendEquation:
    """What is kept of two colours, or of two alphas."""

    source: Factor = "one"
    destination: Factor = "zero"
    operation: Operation = "add"


@dataclass(frozen=True, slots=True)
class Blend:
    """How a target is blended."""

    color: BlendEquation
    alpha: BlendEquation


ALL_LANES = "rgba"


@dataclass(frozen=True, slots=True)
class RenderTarget:
    """One render target."""

    format: TargetFormat
    blend: Blend | None = None
    """``None`` where what is drawn takes the place of what is there."""
    mask: str = ALL_LANES
    """Which lanes are written: some of these letters, or ``none``."""

    def writes(self, lane: str) -> bool:
        """Whether a lane is written."""
        return self.mask != "none" and lane in self.mask


@dataclass(frozen=True, slots=True)
class DepthBias:
    """How far triangles are moved away from the eye before the depth test."""

    constant: int = 0
    """In steps of the format."""
    slope: float = 0.0
    """In times of what the depth changes from one pixel to the next."""
    clamp: float = 0.0
    """How far both together move at most; 0: any distance."""


@dataclass(frozen=True, slots=True)
class StencilSide:
    """The stencil test of triangles of which one side is seen, and what becomes of the values."""

    compare: Compare = "always"
    """How the reference, on the left, has to compare with the value, both masked."""
    fail: StencilOperation = "keep"
    depth_fail: StencilOperation = "keep"
    passed: StencilOperation = "keep"
    """Where the test fails, where only the depth test does, and where neither does."""


@dataclass(frozen=True, slots=True)
class Stencil:
    """The stencil test of either side. Each draw of a job begins with values of 0."""

    front: StencilSide
    back: StencilSide
    reference: int
    read_mask: int
    write_mask: int


@dataclass(frozen=True, slots=True)
class CapturedOutput:
    """An output of the last stage that a stream output writes."""

    identifier: str
    """Its name in the text; OpenGL finds it by that where the text does not say its place."""
    location: int
    offset: int
    """In bytes, from where a vertex begins."""


@dataclass(frozen=True, slots=True)
class StreamOutput:
    """How vertices are captured instead of drawing."""

    outputs: tuple[CapturedOutput, ...]
    stride: int
    """The bytes from one vertex to the next."""
    primitive: Literal["point", "line", "triangle"]
    """What the captured vertices are, in turn."""
    in_text: bool
    """Whether the text says where its outputs go."""


@dataclass(frozen=True, slots=True)
class Pipeline:
    """The state that all draws of a job share."""

    stages: Mapping[str, Code]
    """By the names of the stages, in pipeline order."""
    inputs: tuple[VertexInput, ...]
    blocks: tuple[BlockSlot, ...]
    textures: tuple[TextureSlot, ...]
    targets: tuple[RenderTarget, ...]
    """In the order of their locations."""
    layers: int = 0
    """How many layers each target has, if a geometry stage draws to all of them; 0: none."""
    primitive: Primitive = "triangle"
    patch_points: int = 0
    """How many vertices each patch has, where that is what the vertices are."""
    cull: Cull = "none"
    fill: Fill = "faces"
    depth_compare: Compare = "less"
    """What the depth test lets through, where there are depths."""
    depth_write: bool = True
    depth_bias: DepthBias = DepthBias()
    stencil: Stencil | None = None
    """``None`` where there is no stencil test, and no stencil values are needed."""
    flip_y: bool = False
    """Whether the text negates clip y; a Vulkan driver chooses its viewport by it."""
    front_face: Winding = "ccw"
    """The winding to set as front, in the API's own terms."""
    first_row: Literal["top", "bottom"] = "top"
    """Which row of the picture comes first in the framebuffer's memory."""
    buffers: tuple[BufferSlot, ...] = ()
    images: tuple[ImageSlot, ...] = ()
    host_uniforms: tuple[str, ...] = ()
    """Single float uniforms that get the picture's height (the reflection's ``host_uniforms``)."""
    clip_control: tuple[str, ...] = ()
    """What ``glClipControl`` is given (the reflection's ``clip_control``); empty: OpenGL's own."""
    stream_output: StreamOutput | None = None
    """Where vertices are captured; then there are no targets."""

    @property
    def corners(self) -> int:
        """How many vertices each primitive has."""
        return self.patch_points or CORNERS[self.primitive]

    @property
    def depth_format(self) -> DepthFormat:
        """What depths it needs, if it has its own."""
        return "depth32float" if self.stencil is None else "depth32float-stencil8"

    @property
    def has_bias(self) -> bool:
        """Whether depths are moved: only those of triangles are."""
        return self.depth_bias != DepthBias() and self.primitive != "line"


@dataclass(frozen=True, slots=True)
class Image:
    """The texels of a texture with all its mip levels.

    They are stored row by row, the first at the top (v = 0), then layer by layer, slice by slice of
    a 3D texture, or face by face of a cube: +x, -x, +y, -y, +z, -z, each oriented as in all APIs.
    """

    format: TextureFormat
    width: int
    """The width of the first level. Each further level halves both sides, rounded down, but not
    below 1."""
    height: int
    levels: tuple[bytes, ...]
    dimension: Dimension = "2d"
    depth: int = 1
    """Layers, faces, or slices of the first level, which are halved like the sides."""


@dataclass(frozen=True, slots=True)
class Draw:
    """One picture: the bytes for every slot of the pipeline, in the pipeline's order."""

    width: int
    height: int
    vertex_count: int
    vertices: tuple[bytes, ...]
    """For each of ``Pipeline.inputs``, the values of all vertices or of all instances."""
    indices: bytes
    """A uint32 for each corner of each primitive; the first one's vertex is the provoking one.

    Empty where there is nothing to draw, such as patches of level 0: the targets are only
    cleared."""
    blocks: tuple[bytes, ...]
    textures: tuple[Image, ...]
    clear: tuple[tuple[float, float, float, float], ...]
    """One colour for each target."""
    instance_count: int = 1
    buffers: tuple[bytes, ...] = ()
    """The contents of all storage buffers, in the pipeline's order."""
    clear_depth: float = 1.0
    blend_constant: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    """What the factor ``constant`` means, in all targets."""
    layers: tuple[tuple[bytes, ...], ...] = ()
    """For each layer of the picture, what stands in place of ``blocks``, if every layer is a draw
    of its own. Drivers get these draws one by one."""


@dataclass(frozen=True, slots=True)
class Job:
    """A pipeline and what to draw with it."""

    pipeline: Pipeline
    draws: tuple[Draw, ...]


@dataclass(frozen=True, slots=True)
class Picture:
    """The contents of the targets after one draw."""

    width: int
    height: int
    """All rows: those of the first layer come first."""
    targets: tuple[bytes, ...]
    """For each target float32 RGBA, row by row from the top; lanes that the format lacks are 0, 0,
    1."""


@dataclass(frozen=True, slots=True)
class CaptureJob:
    """A pipeline with a stream output, and what to capture with it."""

    pipeline: Pipeline
    draws: tuple[Draw, ...]
    """The sizes of their pictures do not matter."""
    most: tuple[int, ...]
    """Of each draw, how many vertices it captures at most."""


@dataclass(frozen=True, slots=True)
class Captured:
    """What was captured by one draw."""

    count: int
    """The number of vertices."""
    data: bytes
    """All of them, without gaps."""


@dataclass(frozen=True, slots=True)
class Device:
    """A driver's description of itself."""

    name: str
    """For example ``llvmpipe (LLVM 15.0.6, 256 bits)``."""
    version: str
    """The driver's version, for example ``Mesa 22.3.6``."""
    subpixel_bits: int
    """To how many binary places of a pixel vertices are snapped."""
    subtexel_bits: int
    """The binary places of a linear filter's weights; 0 if the API does not tell."""
    mip_bits: int
    """The binary places of the weights between mip levels; 0 if the API does not tell."""


@dataclass(frozen=True, slots=True)
class Dispatch:
    """One run of a kernel: the bytes for every slot, and how many elements it computes."""

    extent: Sides
    """The elements along x, y and z; a buffer's stand along x. Of images, the width, the height and
    1."""
    blocks: tuple[bytes, ...]
    textures: tuple[Image, ...]
    buffers: tuple[bytes, ...]
    """What all storage buffers hold before it, in the pipeline's order: also those that it
    writes."""


@dataclass(frozen=True, slots=True)
class KernelJob:
    """A pipeline with a kernel as its only stage, and what to compute with it."""

    pipeline: Pipeline
    work_group: Sides
    """The invocations in a work group, as the text declares them."""
    dispatches: tuple[Dispatch, ...]

    def groups(self, dispatch: Dispatch) -> Sides:
        """How many work groups a dispatch takes along x, y and z."""
        x, y, z = (
            -(-length // side)
            for length, side in zip(dispatch.extent, self.work_group, strict=True)
        )
        return x, y, z


@dataclass(frozen=True, slots=True)
class Written:
    """What a dispatch has written: all bytes of each buffer that the pipeline writes, in order."""

    buffers: tuple[bytes, ...]
    images: tuple[bytes, ...] = ()
    """The texels of each image, as ``Picture`` has them."""


class DriverError(Exception):
    """A driver could not draw; the text tells people why."""

"""Pipelines as data: the texts of the stages, what they read and write, and all state.

``binding.py`` makes one of a program and its reflection. Names are resolved to bindings here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from ....compiler.ir.render_state import Cull, DepthState, Fill, StencilState
from .render_state import DepthFormat, RenderTarget, Winding
from .slots import BlockSlot, BufferSlot, ImageSlot, TextureSlot

NEAREST = DepthState()
"""The depth test of a pass that says nothing of it: the nearest fragment is seen."""

VertexFormat = Literal[
    "float32", "float32x2", "float32x3", "float32x4",
    "sint32", "sint32x2", "sint32x3", "sint32x4",
    "uint32", "uint32x2", "uint32x3", "uint32x4",
]  # fmt: skip
"""WebGPU's names: the type of a lane and the number of lanes, tightly packed."""

StepMode = Literal["vertex", "instance"]
"""When an attribute advances to its next value."""

Primitive = Literal["point", "line", "triangle", "line_adjacency", "triangle_adjacency", "patch"]
"""What the vertices are, in turn. Triangles and lines are drawn as they are; all others need a
geometry stage, and patches need the stages of tessellation instead."""

CORNERS: Mapping[Primitive, int] = {
    "point": 1, "line": 2, "triangle": 3, "line_adjacency": 4, "triangle_adjacency": 6,
}  # fmt: skip
"""How many vertices each of them has, but for patches: a pipeline says how many theirs have."""


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
    samples: int = 1
    """How many samples each pixel has of all that is drawn to; targets are resolved then."""
    depth: DepthState = NEAREST
    """What the depth test lets through, where there are depths, and how far these are moved."""
    stencil: StencilState | None = None
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
        return self.depth.is_biased and self.primitive != "line"

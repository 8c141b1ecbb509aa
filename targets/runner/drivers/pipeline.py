"""Pipelines as data: the texts of the stages, their inputs and outputs, and all state.

``binding.py`` makes one from a program and its reflection. Names are resolved to bindings here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from ....compiler.ir.formats import VertexFormat
from ....compiler.ir.render_state import Cull, DepthState, Fill, StencilState
from .render_state import DepthFormat, RenderTarget, Winding
from .slots import BlockSlot, BufferSlot, ImageSlot, TextureSlot

NEAREST = DepthState()
"""The depth test of a pass that says nothing of it: the nearest fragment is seen."""

StepMode = Literal["vertex", "instance"]
"""The step at which an attribute advances to its next value."""

Primitive = Literal["point", "line", "triangle", "line_adjacency", "triangle_adjacency", "patch"]
"""The primitive topology. Triangles and lines are drawn as they are; all others need a geometry
stage, and patches need the tessellation stages instead."""

CORNERS: Mapping[Primitive, int] = {
    "point": 1, "line": 2, "triangle": 3, "line_adjacency": 4, "triangle_adjacency": 6,
}  # fmt: skip
"""The number of vertices of each primitive. Patches are not among them: a pipeline states their
number."""


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
    """The attribute's name in the text."""
    location: int
    format: VertexFormat
    step: StepMode = "vertex"


@dataclass(frozen=True, slots=True)
class CapturedOutput:
    """An output of the last stage that a stream output writes."""

    identifier: str
    """The output's name in the text. OpenGL finds the output by it if the text does not say its
    offset."""
    location: int
    offset: int
    """The offset in bytes from the beginning of a vertex."""


@dataclass(frozen=True, slots=True)
class StreamOutput:
    """The stream output of a pipeline: captures vertices instead of drawing."""

    outputs: tuple[CapturedOutput, ...]
    stride: int
    """The bytes from one vertex to the next."""
    primitive: Literal["point", "line", "triangle"]
    """The primitives that the captured vertices form."""
    in_text: bool
    """True if the text says where its outputs are captured."""


@dataclass(frozen=True, slots=True)
class Pipeline:
    """The state that all draws of a job share."""

    stages: Mapping[str, Code]
    """The codes by the names of the stages, in pipeline order."""
    inputs: tuple[VertexInput, ...]
    blocks: tuple[BlockSlot, ...]
    textures: tuple[TextureSlot, ...]
    targets: tuple[RenderTarget, ...]
    """The render targets, in the order of their locations."""
    layers: int = 0
    """The number of layers of each target, if one draw reaches all of them; 0: none."""
    view_mask: int = 0
    """The views that a draw reaches, a bit for each; each is drawn to the layer of its number. 0: a
    geometry stage chooses the layer, if there are any."""
    primitive: Primitive = "triangle"
    patch_points: int = 0
    """The number of vertices of each patch, if the primitives are patches."""
    cull: Cull = "none"
    fill: Fill = "faces"
    samples: int = 1
    """The number of samples of each pixel, in all attachments; the targets are then resolved."""
    alpha_to_coverage: bool = False
    """True if the alpha of the first target says how many of the samples a fragment covers."""
    depth: DepthState = NEAREST
    """The depth test, if there are depths, and their bias."""
    stencil: StencilState | None = None
    """The stencil test; ``None`` if there is none, and no stencil values are needed."""
    flip_y: bool = False
    """True if the text negates clip y; a Vulkan driver chooses its viewport by it."""
    front_face: Winding = "ccw"
    """The winding to set as front, in the API's own terms."""
    first_row: Literal["top", "bottom"] = "top"
    """The row of the picture that comes first in the framebuffer's memory."""
    buffers: tuple[BufferSlot, ...] = ()
    images: tuple[ImageSlot, ...] = ()
    host_uniforms: tuple[str, ...] = ()
    """Single float uniforms that get the picture's height (the reflection's ``host_uniforms``)."""
    clip_control: tuple[str, ...] = ()
    """The arguments of ``glClipControl`` (the reflection's ``clip_control``). Empty: OpenGL's
    defaults."""
    stream_output: StreamOutput | None = None
    """The stream output; if there is one, there are no targets."""

    @property
    def corners(self) -> int:
        """The number of vertices of each primitive."""
        return self.patch_points or CORNERS[self.primitive]

    @property
    def depth_format(self) -> DepthFormat:
        """The format of the depth attachment, if the pipeline has one."""
        return "depth32float" if self.stencil is None else "depth32float-stencil8"

    @property
    def has_bias(self) -> bool:
        """True if depths have a bias, which only those of triangles can have."""
        return self.depth.is_biased and self.primitive != "line"

"""Frame jobs: many draws and kernels over textures and buffers that stay on the device.

They are the only work for a driver. ``targets/runner/frames`` makes a job of a plan: of a frame's,
or of that of a single shader. ``capturing.py`` makes one that captures vertices. A job has any
number of pipelines, and its steps draw into textures that later steps read. Only requested results
are read back.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from ....compiler.documents.plan import BufferState, ResolveRow, TextureState
from .draws import Dispatch, Draw, Sides
from .pipeline import Pipeline
from .render_state import DepthFormat, TargetFormat

Area = tuple[int, int, int, int]
"""A part of a picture: left, top, width and height."""

BLACK = (0.0, 0.0, 0.0, 0.0)

OWN = -1
"""Stands for a texture or a buffer that the draw itself carries, in place of a number."""


@dataclass(frozen=True, slots=True)
class FrameTexture:
    """A texture that the job makes."""

    format: TargetFormat | DepthFormat
    width: int
    height: int
    layers: int = 1
    """The number of layers; 6 for a cube."""
    levels: int = 1
    dimension: Literal["2d", "2d_array", "cube"] = "2d"
    is_black: bool = False
    """True if the texture is read before a step draws to it: it then starts transparent black or,
    with depths, at the far plane."""
    samples: int = 1
    """The number of samples of each texel. A texture with several has one layer and one level, and
    no shader reads it."""
    memory: int | None = None
    """The number of the memory that the texture shares with others, as no step needs two of them:
    when a barrier takes one of them from ``undefined``, the others lose their contents."""

    @property
    def is_depth(self) -> bool:
        """True if the texture holds depths."""
        return self.format.startswith("depth")

    @property
    def has_stencil(self) -> bool:
        """True if the texture holds stencil values beside the depths."""
        return self.format.endswith("stencil8")


@dataclass(frozen=True, slots=True)
class Barrier:
    """A barrier for a texture: from here on, it is used in another way."""

    texture: int
    before: TextureState
    after: TextureState


@dataclass(frozen=True, slots=True)
class BufferBarrier:
    """A barrier for a storage buffer: from here on, it is used in another way."""

    buffer: int
    before: BufferState
    after: BufferState


@dataclass(frozen=True, slots=True)
class Attachment:
    """An attachment of a render pass: a colour target, or the depths."""

    texture: int
    layer: int = 0
    layers: int = 1
    """The number of layers that one draw reaches, from ``layer`` on."""
    level: int = 0
    loads: bool = False
    """The load operation: True keeps the contents, False clears them."""
    stores: bool = True
    stores_stencil: bool = True
    """The store operation of the stencil values, if there are any: True keeps them. They are loaded
    if the depths are, and otherwise cleared to 0."""
    clear: tuple[float, float, float, float] = BLACK
    """The clear colour; for depths, the first number."""
    resolve: ResolveRow | None = None
    """The place of the samples' means. ``None``: no step reads them, or there is one sample."""


@dataclass(frozen=True, slots=True)
class FrameDraw:
    """One draw, or one dispatch, of a step."""

    pipeline: int
    textures: tuple[int, ...]
    """For each texture of the pipeline, the number of one of the frame's textures; ``OWN`` stands
    for the next one of the draw's own textures."""
    buffers: tuple[int, ...]
    """The numbers of the frame's buffers in the same way, for the pipeline's storage buffers."""
    draw: Draw | None = None
    dispatch: Dispatch | None = None

    @property
    def values(self) -> Draw | Dispatch:
        """The draw or the dispatch."""
        values = self.draw or self.dispatch
        assert values is not None, "one of both is there"
        return values

    def own(self, pipeline: Pipeline) -> Pipeline:
        """The pipeline as if it read only what the draw itself carries."""
        textures = zip(pipeline.textures, self.textures, strict=True)
        buffers = zip(pipeline.buffers, self.buffers, strict=True)
        return replace(
            pipeline,
            textures=tuple(slot for slot, number in textures if number == OWN),
            buffers=tuple(slot for slot, number in buffers if number == OWN),
        )


@dataclass(frozen=True, slots=True)
class FrameStep:
    """One action of the device: a render pass, a kernel, a copy of a texture, or a read-back.

    A step may also do nothing but wait at barriers.
    """

    barriers: tuple[Barrier, ...] = ()
    targets: tuple[Attachment, ...] = ()
    depth: Attachment | None = None
    draws: tuple[FrameDraw, ...] = ()
    """The draws of one render pass; of a kernel, a single dispatch."""
    viewport: Area | None = None
    """The part of the targets to which the clip volume is mapped; ``None``: all of it. Nothing is
    drawn outside of it."""
    scissor: Area | None = None
    """The part of the targets to which fragments are written; ``None``: all of it."""
    blend_constant: tuple[float, float, float, float] = BLACK
    """The colour of the blend factor ``constant``, for all targets."""
    view_mask: int = 0
    """The views that each draw reaches, a bit for each, as all of its pipelines say; 0: none."""
    images: tuple[int, ...] = ()
    """The textures that a kernel writes, in the order of its pipeline."""
    groups: Sides = (0, 0, 0)
    """The numbers of work groups that a kernel runs in."""
    copied: tuple[int, ...] = ()
    """For a copy, the numbers of the source and of the destination."""
    read: tuple[int, ...] = ()
    """The textures whose first level is read back."""
    buffer_barriers: tuple[BufferBarrier, ...] = ()
    read_buffers: tuple[int, ...] = ()
    """The buffers that are read back."""
    captures: int | None = None
    """The largest number of vertices that the step's draw captures, which has a stream output and
    no targets."""
    name: str = ""
    """The step as errors call it. Empty: ``step`` and its number."""

    @property
    def drawn_to(self) -> tuple[Attachment, ...]:
        """All attachments of the step; the depths come last."""
        return self.targets if self.depth is None else (*self.targets, self.depth)

    def areas(self, width: int, height: int) -> tuple[Area, Area]:
        """The viewport in targets of this size, and the part of them that is drawn to."""
        whole = (0, 0, width, height)
        viewport = whole if self.viewport is None else self.viewport
        return viewport, _common(viewport, whole if self.scissor is None else self.scissor, whole)


def _common(*areas: Area) -> Area:
    """The intersection of all areas."""
    left, top = max(area[0] for area in areas), max(area[1] for area in areas)
    right = min(area[0] + area[2] for area in areas)
    bottom = min(area[1] + area[3] for area in areas)
    if right <= left or bottom <= top:
        return (0, 0, 0, 0)
    return left, top, right - left, bottom - top


@dataclass(frozen=True, slots=True)
class FrameBuffer:
    """A storage buffer that the job makes."""

    words: int
    """The number of words of four bytes."""
    initial: int = 0
    """The first value of each word."""

    @property
    def size(self) -> int:
        """The number of bytes."""
        return 4 * self.words

    @property
    def contents(self) -> bytes:
        """The buffer's first contents."""
        return self.initial.to_bytes(4, "little") * self.words


@dataclass(frozen=True, slots=True)
class FrameJob:
    """Steps in order, and the resources that they share."""

    textures: tuple[FrameTexture, ...]
    buffers: tuple[FrameBuffer, ...]
    pipelines: tuple[Pipeline, ...]
    steps: tuple[FrameStep, ...]

    def called(self, number: int) -> str:
        """A step as errors call it."""
        return self.steps[number].name or f"step {number}"


@dataclass(frozen=True, slots=True)
class FrameTexels:
    """The texels of a texture's first level, read back."""

    width: int
    height: int
    layers: int
    texels: bytes
    """float32 RGBA, layer by layer, in the order of the texture's rows; lanes that the format lacks
    are 0, 0, 1. Depths are in the first lane."""


@dataclass(frozen=True, slots=True)
class Captured:
    """The vertices that one draw has captured."""

    count: int
    """The number of vertices."""
    data: bytes
    """The bytes of all vertices, without gaps."""


@dataclass(frozen=True, slots=True)
class Found:
    """The results of a frame job: all that it has read back, step by step."""

    texels: tuple[FrameTexels, ...] = ()
    buffers: tuple[bytes, ...] = ()
    captured: tuple[Captured, ...] = ()

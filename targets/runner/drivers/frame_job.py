"""Frame jobs: many draws and kernels over textures and buffers that stay on the device.

``targets/runner/frames`` makes a job of a plan, and ``by_frames.py`` of single draws. Where the
``Job`` of ``draw_job.py`` has one pipeline, and each draw a picture of its own, a frame job has as
many as it likes, and its steps draw into textures that later steps read. Only what is asked for
comes back.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from .capture_job import Captured
from .draw_job import Draw
from .kernel_job import Dispatch, KernelJob, Sides
from .pipeline import Pipeline
from .render_state import DepthFormat, TargetFormat

TextureUse = Literal["undefined", "target", "depth", "image", "sampled", "copied_from", "copied_to"]
"""What a texture is used as; at first it has no contents."""

BufferUse = Literal["undefined", "written", "read"]
"""What a storage buffer is used as; at first it has what ``FrameBuffer`` says."""

Area = tuple[int, int, int, int]
"""A part of a picture: left, top, width and height."""

BLACK = (0.0, 0.0, 0.0, 0.0)

OWN = -1
"""In place of the number of a texture or a buffer: one that the draw brings along."""


@dataclass(frozen=True, slots=True)
class FrameTexture:
    """A texture that the job makes."""

    format: TargetFormat | DepthFormat
    width: int
    height: int
    layers: int = 1
    """How many; 6 of a cube."""
    levels: int = 1
    dimension: Literal["2d", "2d_array", "cube"] = "2d"
    is_black: bool = False
    """Whether it is read before a step draws to it: it is transparent black then, or as far away as
    can be."""
    samples: int = 1
    """How many each texel has. A texture with several has one layer and one level, and nobody reads
    it."""
    memory: int | None = None
    """Of textures with the same number, no step needs two, so they may lie in the same memory: when
    a barrier takes one of them from ``undefined``, the others lose their contents."""

    @property
    def is_depth(self) -> bool:
        """Whether it holds depths."""
        return self.format.startswith("depth")

    @property
    def has_stencil(self) -> bool:
        """Whether it holds stencil values beside them."""
        return self.format.endswith("stencil8")


@dataclass(frozen=True, slots=True)
class Barrier:
    """From here on, a texture is used in another way."""

    texture: int
    before: TextureUse
    after: TextureUse


@dataclass(frozen=True, slots=True)
class BufferBarrier:
    """From here on, a storage buffer is used in another way."""

    buffer: int
    before: BufferUse
    after: BufferUse


@dataclass(frozen=True, slots=True)
class Resolve:
    """Where the mean of each texel's samples is written behind a step."""

    texture: int
    layer: int = 0
    level: int = 0


@dataclass(frozen=True, slots=True)
class Attachment:
    """What a target, or the depths, are drawn to."""

    texture: int
    layer: int = 0
    layers: int = 1
    """To how many layers a geometry stage draws at once, from ``layer`` on."""
    level: int = 0
    loads: bool = False
    """Whether what is there is kept; else it is cleared."""
    stores: bool = True
    stores_stencil: bool = True
    """Whether the stencil values are kept, where there are any. They are loaded where depths are,
    and else cleared to 0."""
    clear: tuple[float, float, float, float] = BLACK
    """A colour; of depths, the first number."""
    resolve: Resolve | None = None
    """``None`` where nobody reads the means, or there are no samples."""


@dataclass(frozen=True, slots=True)
class FrameDraw:
    """One draw, or one dispatch, of a step."""

    pipeline: int
    textures: tuple[int, ...]
    """For each texture of the pipeline the number of one of the frame's; ``OWN`` for the next one
    of the draw's own."""
    buffers: tuple[int, ...]
    """Likewise for its storage buffers, and those of the frame."""
    draw: Draw | None = None
    dispatch: Dispatch | None = None


@dataclass(frozen=True, slots=True)
class FrameStep:
    """Something that the device does: it draws, runs a kernel, copies a texture, or brings texels
    back; or nothing but to wait at barriers."""

    barriers: tuple[Barrier, ...] = ()
    targets: tuple[Attachment, ...] = ()
    depth: Attachment | None = None
    draws: tuple[FrameDraw, ...] = ()
    """In one render pass; of a kernel, only one."""
    viewport: Area | None = None
    """Into which part of the targets the clip volume is drawn; ``None``: into all of it. Nothing is
    drawn outside of it."""
    scissor: Area | None = None
    """To which part of the targets is drawn, likewise."""
    blend_constant: tuple[float, float, float, float] = BLACK
    """What the factor ``constant`` means in all of them."""
    images: tuple[int, ...] = ()
    """The textures that a kernel writes, in the order of its pipeline."""
    groups: Sides = (0, 0, 0)
    """How many work groups a kernel runs in."""
    copied: tuple[int, ...] = ()
    """From which texture to which other one, if it is a copy."""
    read: tuple[int, ...] = ()
    """The textures whose first level is read back."""
    buffer_barriers: tuple[BufferBarrier, ...] = ()
    read_buffers: tuple[int, ...] = ()
    """The buffers that are read back."""
    captures: int | None = None
    """How many vertices its draw captures at most, which has a stream output and no targets."""

    @property
    def drawn_to(self) -> tuple[Attachment, ...]:
        """All that it draws to, its depths last."""
        return self.targets if self.depth is None else (*self.targets, self.depth)

    def areas(self, width: int, height: int) -> tuple[Area, Area]:
        """The viewport in targets of this size, and all that is drawn to."""
        whole = (0, 0, width, height)
        viewport = whole if self.viewport is None else self.viewport
        return viewport, _common(viewport, whole if self.scissor is None else self.scissor, whole)


def _common(*areas: Area) -> Area:
    """What lies in all areas."""
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
    """How many words of four bytes it has."""
    initial: int = 0
    """What each of them is at first."""
    data: bytes = b""
    """Instead of both: what it holds at first."""

    @property
    def contents(self) -> bytes:
        """What it holds at first."""
        return self.data or self.initial.to_bytes(4, "little") * self.words


@dataclass(frozen=True, slots=True)
class FrameJob:
    """Steps in order, and what they share."""

    textures: tuple[FrameTexture, ...]
    buffers: tuple[FrameBuffer, ...]
    pipelines: tuple[Pipeline, ...]
    steps: tuple[FrameStep, ...]


@dataclass(frozen=True, slots=True)
class FrameTexels:
    """What was read back of a texture's first level."""

    width: int
    height: int
    layers: int
    texels: bytes
    """float32 RGBA, layer by layer and row by row from the top; lanes that the format lacks are 0,
    0, 1. Depths are in the first lane."""


@dataclass(frozen=True, slots=True)
class Found:
    """What a frame job has read back, step by step."""

    texels: tuple[FrameTexels, ...] = ()
    buffers: tuple[bytes, ...] = ()
    captured: tuple[Captured, ...] = ()


def groups_of(pipeline: Pipeline, dispatch: Dispatch, work_group: Sides) -> Sides:
    """How many work groups a dispatch takes."""
    return KernelJob(pipeline, work_group, (dispatch,)).groups(dispatch)

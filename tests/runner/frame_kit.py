"""Frame jobs made by hand, whose texels the tests know exactly, for the drivers that draw them.

The texts are GLSL that Vulkan and OpenGL both take: places are bound by numbers of their own, and
OpenGL's clip space is made Vulkan's by ``clip_control``.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.draws import Dispatch, Draw
from burnish.targets.runner.drivers.frame_job import (
    Attachment,
    Barrier,
    Found,
    FrameBuffer,
    FrameDraw,
    FrameJob,
    FrameStep,
    FrameTexels,
    FrameTexture,
)
from burnish.targets.runner.drivers.pipeline import Code, Pipeline, VertexInput
from burnish.targets.runner.drivers.render_state import RenderTarget, TargetFormat
from burnish.targets.runner.drivers.slots import (
    BlockSlot,
    BufferSlot,
    ImageSlot,
    Place,
    TextureSlot,
)
from burnish.targets.runner.drivers.wire import joined
from burnish.targets.runner.runner import frame_request
from burnish.targets.toolchain.workers import Answer

from .vulkan_kit import glsl, quad, spirv

Floats = npt.NDArray[np.float32]
Color = tuple[float, float, float, float]

TIME_LIMIT = 60.0
SIZE = 4
FORMAT: TargetFormat = "rgba32float"

CLEAR: Color = (0.0, 0.0, 0.0, 0.0)
RED: Color = (1.0, 0.0, 0.0, 1.0)
GREEN: Color = (0.0, 1.0, 0.0, 1.0)
BLUE: Color = (0.0, 0.0, 1.0, 1.0)

HEADS = {
    "vulkan": "#version 450\n",
    "opengl": "#version 450 core\n",
}
UPPER_LEFT = ("GL_UPPER_LEFT", "GL_ZERO_TO_ONE")

PLACED = """layout(location = 0) in vec3 place;
void main() { gl_Position = vec4(place, 1.0); }
"""
PAINT = """layout(binding = 0) uniform Paint { vec4 paint; };
layout(location = 0) out vec4 target;
void main() { target = paint; }
"""
TWICE = """layout(binding = 0) uniform sampler2D before;
layout(location = 0) out vec4 target;
void main() { target = 2.0 * texelFetch(before, ivec2(gl_FragCoord.xy), 0); }
"""
PAINT_SLOT = BlockSlot(Place("Paint", 0, 0), 16)


class Driver:
    """A driver that draws frame jobs, in a worker process that a test file shares."""

    def __init__(self, api: str, asker: Any) -> None:
        """``asker`` is that of one of the other kits."""
        self.api = api
        self._asker = asker

    def draw(self, job: FrameJob) -> list[Floats]:
        """The texels read back, by layer, row, column and lane. Raises ``DriverError``."""
        answer: Answer = self._asker.answer(frame_request(job), TIME_LIMIT)
        assert answer.ending == "ended", answer.log
        if "error" in answer.reply:
            raise DriverError(answer.reply["error"])
        return [_array(each) for each in joined(Found, answer.reply["found"], answer.data).texels]

    def pipeline(
        self,
        fragment: str,
        *,
        targets: Sequence[RenderTarget] = (RenderTarget(FORMAT),),
        **slots: Any,
    ) -> Pipeline:
        """A pipeline of vertices that have only their places; ``slots`` are what it binds."""
        stages = {"vertex": self._code("vert", PLACED), "fragment": self._code("frag", fragment)}
        return Pipeline(
            stages,
            (VertexInput("place", 0, "float32x3"),),
            slots.pop("blocks", ()),
            slots.pop("textures", ()),
            tuple(targets),
            clip_control=UPPER_LEFT if self.api == "opengl" else (),
            **slots,
        )

    def painting(self, *targets: RenderTarget) -> Pipeline:
        """A pipeline that draws in the colour of its block."""
        return self.pipeline(
            PAINT, targets=targets or (RenderTarget(FORMAT),), blocks=(PAINT_SLOT,)
        )

    def kernel(self, text: str, **slots: Any) -> Pipeline:
        """A pipeline with a kernel of a single invocation in each work group."""
        head = "layout(local_size_x = 1) in;\n"
        textures = slots.pop("textures", ())
        return Pipeline({"compute": self._code("comp", head + text)}, (), (), textures, (), **slots)

    def _code(self, stage: str, text: str) -> Code:
        whole = HEADS[self.api] + text
        if self.api == "vulkan":
            return (
                Code("main", spirv=spirv("comp", whole)) if stage == "comp" else glsl(stage, whole)
            )
        return Code("main", whole)


def _array(found: FrameTexels) -> Floats:
    lanes = np.frombuffer(found.texels, np.float32)
    return lanes.reshape(found.layers, found.height, found.width, 4)


# --- parts of jobs -------------------------------------------------------------------------------


@dataclass(frozen=True)
class Area:
    """A rectangle of clip space, in which y points up, at a depth."""

    left: float = -1.0
    bottom: float = -1.0
    right: float = 1.0
    top: float = 1.0
    depth: float = 0.5


ALL = Area()
LEFT = Area(right=0.0)
TOP = Area(bottom=0.0)


def draw_of(area: Area, *blocks: bytes) -> Draw:
    """Two triangles over an area."""
    corners = quad(area.left, area.bottom, area.right, area.top, area.depth)
    lanes = [lane for corner in corners for lane in corner]
    return Draw(
        width=SIZE,
        height=SIZE,
        vertex_count=len(corners),
        vertices=(struct.pack(f"<{len(lanes)}f", *lanes),),
        indices=struct.pack(f"<{len(corners)}I", *range(len(corners))),
        blocks=blocks,
        textures=(),
    )


def painted(paint: Color, area: Area = ALL, pipeline: int = 0) -> FrameDraw:
    """A draw of one colour."""
    return FrameDraw(pipeline, (), (), draw_of(area, struct.pack("<4f", *paint)))


def reading(pipeline: int, *textures: int, buffers: Sequence[int] = ()) -> FrameDraw:
    """A draw over everything that reads textures and buffers of the frame."""
    return FrameDraw(pipeline, textures, tuple(buffers), draw_of(ALL))


def dispatched(pipeline: int, *textures: int, buffers: Sequence[int] = ()) -> FrameDraw:
    """A kernel's run over textures and buffers of the frame."""
    nothing = Dispatch((1, 1, 1), (), (), ())
    return FrameDraw(pipeline, textures, tuple(buffers), dispatch=nothing)


def step(
    target: int, *draws: FrameDraw, barriers: Sequence[Barrier] = (), **attached: Any
) -> FrameStep:
    """A step that draws to one target."""
    return FrameStep(tuple(barriers), (Attachment(target, **attached),), None, draws)


def back(*textures: int, before: Any = "target") -> FrameStep:
    """A step that brings textures back; ``before`` is how they were used last."""
    barriers = tuple(Barrier(each, before, "copied_from") for each in textures)
    return FrameStep(barriers, read=textures)


def drawn_first(*textures: int) -> tuple[Barrier, ...]:
    """The barriers before textures are drawn to for the first time."""
    return tuple(Barrier(each, "undefined", "target") for each in textures)


def texture(**more: Any) -> FrameTexture:
    """A small square texture."""
    format_ = more.pop("format", FORMAT)
    size = more.pop("size", SIZE)
    return FrameTexture(format_, size, size, **more)


def slot(binding: int = 0, **more: Any) -> TextureSlot:
    """A texture that is read texel by texel."""
    place = Place("before", 0, binding)
    return TextureSlot(place, None, filter="nearest", mip="nearest", wrap="clamp", **more)


def image_slot(binding: int = 0) -> ImageSlot:
    """An image that a kernel writes."""
    return ImageSlot(Place("result", 0, binding), FORMAT)


def buffer_slot(binding: int, *, written: bool = False) -> BufferSlot:
    """A buffer of floats."""
    return BufferSlot(Place(f"buffer_{binding}", 0, binding), 4, written=written)


def job(
    textures: Sequence[FrameTexture],
    pipelines: Sequence[Pipeline],
    *steps: FrameStep,
    buffers: Sequence[FrameBuffer] = (),
) -> FrameJob:
    """A whole job."""
    return FrameJob(tuple(textures), tuple(buffers), tuple(pipelines), steps)

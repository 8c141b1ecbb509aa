"""Draws small scenes with the drivers that take shaders as text: OpenGL and the browser.

Every shader is written twice: in GLSL, whose two dialects differ only in the first lines, and in
WGSL. Positions are in Direct3D's clip space, as everywhere in Burnish.
"""

from __future__ import annotations

import struct
import sys
from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import numpy as np
import numpy.typing as npt

from burnish.compiler.ir.formats import VertexFormat
from burnish.targets.runner.drivers.device import Device, DriverError
from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.drivers.frame_job import Found, FrameJob
from burnish.targets.runner.drivers.pipeline import Code, Pipeline, VertexInput
from burnish.targets.runner.drivers.render_state import RenderTarget
from burnish.targets.runner.drivers.slots import BlockSlot, Place, TextureSlot
from burnish.targets.runner.drivers.texels import Image, TextureFormat
from burnish.targets.runner.drivers.wire import from_json, joined
from burnish.targets.runner.runner import frame_request
from burnish.targets.toolchain.limits import BROWSERS
from burnish.targets.toolchain.pipe import Packet
from burnish.targets.toolchain.workers import Answer, Worker

from . import textual_shaders as shaders
from .jobs_kit import Picture, draw_job, pictures

Floats = npt.NDArray[np.float32]
Color = tuple[float, float, float, float]

COMMANDS = {
    "opengl": ("burnish.targets.runner.drivers.opengl",),
    "webgpu": ("burnish.targets.runner.drivers.browser", "webgpu"),
    "webgl2": ("burnish.targets.runner.drivers.browser", "webgl2"),
}
GLSL_HEADS = {
    "opengl": "#version 330 core\n",
    "webgl2": "#version 300 es\nprecision highp float;\nprecision highp int;\n",
}
TIME_LIMIT = 120.0
SIZE = 8

CORNERS = ((-1, -1), (3, -1), (-1, 3))
"""The corners of a triangle that covers the picture."""


class Asker:
    """A driver in a worker process of its own."""

    def __init__(self, api: str) -> None:
        self.api = api
        self._worker = Worker(lambda: [sys.executable, "-m", *COMMANDS[api]], BROWSERS)

    def answer(self, request: Packet, time_limit: float = TIME_LIMIT) -> Answer:
        """The worker's answer to a request, whatever it is."""
        return self._worker.ask(request.content, time_limit, request.data)

    def device(self) -> Device:
        """The device that the worker draws with."""
        return from_json(Device, self._reply(Packet({})).content["device"])

    def draw(self, job: FrameJob) -> list[Picture]:
        """The pictures of a job. Raises ``DriverError`` as the worker does."""
        reply = self._reply(frame_request(job))
        return pictures(job, joined(Found, reply.content["found"], reply.data))

    def close(self) -> None:
        """End the worker."""
        self._worker.close()

    def _reply(self, request: Packet) -> Packet:
        answer = self.answer(request)
        assert answer.ending == "ended", answer.log
        if "error" in answer.reply:
            raise DriverError(answer.reply["error"])
        return Packet(answer.reply, answer.data)


@cache
def asker(api: str) -> Asker:
    """The worker that all tests of this process share."""
    return Asker(api)


def pixels(picture: Picture, target: int = 0) -> Floats:
    """A target of a picture, of shape (height, width, 4)."""
    found: Floats = picture[target].astype(np.float32)
    return found


def shoot(api: str, job: FrameJob, target: int = 0) -> Floats:
    """A target of the only draw of a job."""
    (picture,) = asker(api).draw(job)
    return pixels(picture, target)


def floats(values: object) -> bytes:
    """Numbers, nested to any depth, as float32."""
    return np.asarray(values, "<f4").tobytes()


def indices(*numbers: int) -> bytes:
    """Numbers as uint32."""
    return struct.pack(f"<{len(numbers)}I", *numbers)


def place(identifier: str, group: int | None = None, binding: int | None = None) -> Place:
    """The place of a binding: a name, with numbers if they are given."""
    return Place(identifier, group, binding)


def codes(api: str, glsl: str, wgsl: str) -> tuple[Code, Code]:
    """Both stages of a shader, whose texts have a bar between the stages."""
    text = wgsl if api == "webgpu" else glsl
    vertex, fragment = (GLSL_HEADS.get(api, "") + stage for stage in text.split("|"))
    return Code("main", vertex), Code("main", fragment)


def pipeline(
    api: str,
    glsl: str = shaders.PAINT_GLSL,
    wgsl: str = shaders.PAINT_WGSL,
    *,
    paint: VertexFormat = "float32x4",
    targets: Sequence[RenderTarget] = (RenderTarget("rgba32float"),),
    blocks: Sequence[BlockSlot] = (),
) -> Pipeline:
    """A pipeline whose vertices have a position and a colour, ``paint``."""
    vertex, fragment = codes(api, glsl, wgsl)
    return Pipeline(
        stages={"vertex": vertex, "fragment": fragment},
        inputs=(VertexInput("place", 0, "float32x3"), VertexInput("paint", 1, paint)),
        blocks=tuple(blocks),
        textures=(),
        targets=tuple(targets),
        first_row="top" if api == "webgpu" else "bottom",
    )


def mesh(places: Sequence[Sequence[float]], paint: object, kind: str = "<f4") -> Draw:
    """A draw of triangles, given as their vertices; a position without a depth has 0.5.

    ``paint`` is one value for each vertex, or one for all.
    """
    count = len(places)
    lanes = np.asarray(paint, kind)
    each = lanes if lanes.ndim == 2 else np.tile(lanes, (count, 1))
    return Draw(
        width=SIZE,
        height=SIZE,
        vertex_count=count,
        vertices=(floats([(*p, 0.5)[:3] for p in places]), each.tobytes()),
        indices=indices(*range(count)),
        blocks=(),
        textures=(),
    )


def full(paint: object) -> Draw:
    """A draw that covers the whole picture with one colour."""
    return mesh(CORNERS, paint)


def with_blocks(draw: Draw, *blocks: bytes) -> Draw:
    """The draw with uniform blocks."""
    return replace(draw, blocks=blocks)


NUMBERS = BlockSlot(place("Numbers"), 64)
NUMBERS_DATA = np.array([-7, 2**20, -(2**30), 0] + [9] * 8 + [16777213, 9, 9, 9], "<i4").tobytes()


def numbers(api: str, slot: BlockSlot = NUMBERS) -> Pipeline:
    """A pipeline that adds a block of numbers to its colour."""
    where = place("numbers", 2, 5) if api == "webgpu" else place("Numbers")
    return pipeline(
        api,
        shaders.NUMBERS_GLSL,
        shaders.NUMBERS_WGSL,
        paint="sint32x3",
        blocks=[replace(slot, place=where)],
    )


RED, GREEN, BLUE = np.eye(4)[:3] + np.array((0, 0, 0, 1))
TEXELS = (np.arange(16, dtype="<f4").reshape(2, 2, 4) + 1) / 16
NEAREST = TextureSlot(place("image"), None, filter="nearest", mip="none", wrap="clamp")


def image(*levels: np.ndarray) -> Image:
    height, width, _ = levels[0].shape
    kind: TextureFormat = "rgba32float" if levels[0].dtype == np.float32 else "rgba8unorm"
    return Image(kind, width, height, tuple(level.tobytes() for level in levels))


def read(api: str, slot: TextureSlot, picture: Image, corners: tuple[float, float]) -> np.ndarray:
    """A texture over the picture; u and v go from one corner to the other."""
    low, high = corners
    if api == "webgpu":
        slot = replace(slot, texture=place("image", 0, 0), sampler=place("reader", 0, 1))
    chosen = replace(pipeline(api, shaders.TEXTURED_GLSL, shaders.TEXTURED_WGSL), textures=(slot,))
    span = high - low
    uv = [(low, high), (low + 2 * span, high), (low, high - 2 * span)]  # v runs down
    draw = mesh(CORNERS, [(*each, 0, 0) for each in uv])
    return shoot(api, draw_job(chosen, (replace(draw, textures=(picture,)),)))

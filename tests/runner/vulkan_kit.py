"""Draws small scenes with the Vulkan drivers, whose pictures the tests know exactly."""

from __future__ import annotations

import os
import re
import signal
import struct
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from burnish.targets.runner.codes import modules
from burnish.targets.runner.drivers.device import Device, DriverError
from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.drivers.frame_job import Found, FrameJob
from burnish.targets.runner.drivers.pipeline import Code, Pipeline, VertexInput
from burnish.targets.runner.drivers.render_state import RenderTarget
from burnish.targets.runner.drivers.texels import Image
from burnish.targets.runner.drivers.wire import from_json, joined
from burnish.targets.runner.routes import DRIVERS
from burnish.targets.runner.runner import frame_request
from burnish.targets.toolchain import Job, Toolchain
from burnish.targets.toolchain.pipe import Packet
from burnish.targets.toolchain.tools import inspect_all, tool_named
from burnish.targets.toolchain.workers import Answer, Worker

from .jobs_kit import Picture, draw_job, pictures

Floats = npt.NDArray[np.float32]

TIME_LIMIT = 60.0
SIZE = 8

FLAT = """#version 450
layout(location = 0) in vec3 place;
void main() { gl_Position = vec4(place, 1.0); }
"""

PAINTED = """#version 450
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 paint;
layout(location = 0) out vec4 colour;
void main() { gl_Position = vec4(place, 1.0); colour = paint; }
"""

PAINT = """#version 450
layout(location = 0) in vec4 colour;
layout(location = 0) out vec4 target;
void main() { target = colour; }
"""


class Asker:
    """A driver in a worker process of its own."""

    def __init__(self, driver: str) -> None:
        row = DRIVERS[driver]
        states = inspect_all(map(tool_named, row.needs))
        problems = [state.problem for state in states.values() if state.problem]
        assert not problems, "; ".join(problems)
        self.driver = driver
        self.command = row.command(states)
        self._worker = Worker(lambda: self.command, row.limits)

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

    def one(self, pipeline: Pipeline, draw: Draw, **settings: Any) -> Floats:
        """The first target of the only picture, as an array of rows, columns and lanes.

        ``settings`` are those of ``draw_job``.
        """
        (picture,) = self.draw(draw_job(pipeline, (draw,), **settings))
        return pixels(picture)

    def kill(self) -> None:
        """Kill the worker's process from outside."""
        os.kill(self._process(), signal.SIGKILL)

    def resident_bytes(self) -> int:
        """The resident memory of the worker's process, in bytes."""
        status = Path(f"/proc/{self._process()}/status").read_text()
        found = re.search(r"VmRSS:\s+(\d+) kB", status)
        assert found
        return int(found[1]) * 1024

    def close(self) -> None:
        """End the worker."""
        self._worker.close()

    def _process(self) -> int:
        child = self._worker._child
        assert child is not None
        return child.pid

    def _reply(self, request: Packet) -> Packet:
        answer = self.answer(request)
        assert answer.ending == "ended", answer.log
        if "error" in answer.reply:
            raise DriverError(answer.reply["error"])
        return Packet(answer.reply, answer.data)


def pixels(picture: Picture, target: int = 0) -> Floats:
    """A target as an array of rows, columns and lanes."""
    found: Floats = picture[target].astype(np.float32)
    return found


@cache
def tools() -> Toolchain:
    """The downstream compilers."""
    return Toolchain()


@cache
def spirv(
    stage: str,
    text: str,
    checker: str = "glslang-vulkan",
    entry: str = "main",
    flags: tuple[str, ...] = (),
) -> bytes:
    """The SPIR-V that a compiler makes of a text, unless another process has kept it."""
    job = Job(checker=checker, stage=stage, text=text, entry=entry, flags=flags)
    made = modules([job], tools())[job]
    assert isinstance(made, bytes), made.report()
    return made


def glsl(stage: str, text: str) -> Code:
    """A stage in GLSL."""
    return Code("main", spirv=spirv(stage, text))


PLACE = VertexInput("place", 0, "float32x3")
PAINTS = VertexInput("paint", 1, "float32x4")

WHITE = """#version 450
layout(location = 0) out vec4 target;
void main() { target = vec4(1.0); }
"""


def flat_pipeline(fragment: str = WHITE, **more: Any) -> Pipeline:
    """A pipeline whose vertices have only positions in clip space."""
    targets = more.pop("targets", (RenderTarget("rgba32float"),))
    return Pipeline(
        stages={
            "vertex": glsl("vert", more.pop("vertex", FLAT)),
            "fragment": glsl("frag", fragment),
        },
        inputs=(PLACE,),
        blocks=more.pop("blocks", ()),
        textures=more.pop("textures", ()),
        targets=targets,
        **more,
    )


def painted_pipeline(*targets: RenderTarget, **more: Any) -> Pipeline:
    """A pipeline whose vertices also have colours."""
    return Pipeline(
        stages={"vertex": glsl("vert", PAINTED), "fragment": glsl("frag", PAINT)},
        inputs=(PLACE, PAINTS),
        blocks=(),
        textures=(),
        targets=targets or (RenderTarget("rgba32float"),),
        **more,
    )


def shading(pipeline: Pipeline, fragment: Code) -> Pipeline:
    """The pipeline with another fragment stage."""
    return replace(pipeline, stages={**pipeline.stages, "fragment": fragment})


def quad(left: float, bottom: float, right: float, top: float, depth: float) -> list[list[float]]:
    """The corners of two triangles in clip space, counter-clockwise with y upwards."""
    a, b = [left, bottom, depth], [right, bottom, depth]
    c, d = [right, top, depth], [left, top, depth]
    return [a, b, c, a, c, d]


WHOLE = quad(-1, -1, 1, 1, 0.5)


def draw_of(
    places: Sequence[Sequence[float]],
    paints: Sequence[Sequence[float]] | None = None,
    *,
    size: tuple[int, int] = (SIZE, SIZE),
    blocks: Sequence[bytes] = (),
    textures: Sequence[Image] = (),
) -> Draw:
    """A draw of triangles that share no vertices."""
    streams = [places] if paints is None else [places, paints]
    return Draw(
        width=size[0],
        height=size[1],
        vertex_count=len(places),
        vertices=tuple(
            floats(*(lane for vertex in stream for lane in vertex)) for stream in streams
        ),
        indices=struct.pack(f"<{len(places)}I", *range(len(places))),
        blocks=tuple(blocks),
        textures=tuple(textures),
    )


def floats(*values: float) -> bytes:
    """float32, little-endian."""
    return struct.pack(f"<{len(values)}f", *values)

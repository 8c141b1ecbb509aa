"""Draws a job with OpenGL; the driver keeps one ``Renderer`` for all jobs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager

import moderngl

from ..draw import (
    CORNERS,
    Captured,
    CaptureJob,
    Device,
    Draw,
    DriverError,
    Job,
    Picture,
    Pipeline,
    Primitive,
    StepMode,
)
from .context import CLIP_CONTROL, GL_FRAMEBUFFER_SRGB, Functions, create_context
from .program import attribute_layout, bound_at, link
from .screen import Screen
from .texture_units import bound_texture

RATES: Mapping[StepMode, str] = {"vertex": "/v", "instance": "/i"}
"""The suffix of moderngl's layouts for each rate."""

OWN_CLIP_CONTROL = ("GL_LOWER_LEFT", "GL_NEGATIVE_ONE_TO_ONE")
"""OpenGL's own clip space, which texts have that are for older versions, too."""

MODES: Mapping[Primitive, int] = {
    "point": moderngl.POINTS,
    "line": moderngl.LINES,
    "triangle": moderngl.TRIANGLES,
    "line_adjacency": moderngl.LINES_ADJACENCY,
    "triangle_adjacency": moderngl.TRIANGLES_ADJACENCY,
}


class Renderer:
    """An OpenGL context that draws one job after the other."""

    def __init__(self) -> None:
        self._context = create_context()
        self._functions = Functions()
        self._nowhere = self._context.simple_framebuffer((1, 1))
        """What is bound while vertices are captured: OpenGL wants something to draw to, although
        nothing is drawn."""

    def device(self) -> Device:
        """The device; OpenGL reports only one precision, that of snapping vertices."""
        info = self._context.info
        return Device(
            name=info["GL_RENDERER"],
            version=info["GL_VERSION"],
            subpixel_bits=info["GL_SUBPIXEL_BITS"],
            subtexel_bits=0,
            mip_bits=0,
        )

    def draw(self, job: Job) -> Sequence[Picture]:
        """Link the job's program and draw with it. Raises ``DriverError``."""
        self._context.clear_errors()  # of a job that broke off
        program = link(self._context, self._functions, job.pipeline)
        try:
            return [
                _picture(self._context, self._functions, program, job.pipeline, draw)
                for draw in job.draws
            ]
        except moderngl.Error as error:
            raise DriverError(f"OpenGL: {error}") from None
        finally:
            program.release()

    def capture(self, job: CaptureJob) -> Sequence[Captured]:
        """Link the job's program and capture with it. Raises ``DriverError``."""
        self._context.clear_errors()  # of a job that broke off
        self._nowhere.use()
        program = link(self._context, self._functions, job.pipeline)
        try:
            return [
                _captured(self._context, self._functions, program, job.pipeline, draw, most)
                for draw, most in zip(job.draws, job.most, strict=True)
            ]
        except moderngl.Error as error:
            raise DriverError(f"OpenGL: {error}") from None
        finally:
            program.release()


def _captured(
    context: moderngl.Context,
    functions: Functions,
    program: moderngl.Program,
    pipeline: Pipeline,
    draw: Draw,
    most: int,
) -> Captured:
    """What one draw captures into a buffer for so many vertices at most."""
    stream = pipeline.stream_output
    assert stream is not None
    context.provoking_vertex = context.FIRST_VERTEX_CONVENTION
    buffer = context.buffer(reserve=max(most, 1) * stream.stride)
    counting = context.query(primitives=True)
    with _bound(context, functions, program, pipeline, draw) as array, counting:
        array.transform(buffer, MODES[pipeline.primitive], instances=draw.instance_count)
    count = int(counting.primitives) * CORNERS[stream.primitive]
    if (error := context.error) != "GL_NO_ERROR":
        raise DriverError(f"OpenGL reports {error}")
    if count > most:
        raise DriverError(f"{count} vertices were captured, and there was room for {most}")
    return Captured(count, buffer.read(count * stream.stride) if count else b"")


def _picture(
    context: moderngl.Context,
    functions: Functions,
    program: moderngl.Program,
    pipeline: Pipeline,
    draw: Draw,
) -> Picture:
    screen = Screen(context, functions, pipeline.targets, (draw.width, draw.height))
    try:
        _set_state(context, functions, pipeline)
        screen.clear(draw.clear)
        screen.set_blending()
        with _bound(context, functions, program, pipeline, draw) as array:
            array.render(MODES[pipeline.primitive], instances=draw.instance_count)
        picture = Picture(draw.width, draw.height, screen.read(pipeline))
    finally:
        screen.release()
    if (error := context.error) != "GL_NO_ERROR":
        raise DriverError(f"OpenGL reports {error}")
    return picture


def _set_state(context: moderngl.Context, functions: Functions, pipeline: Pipeline) -> None:
    culling = 0 if pipeline.cull == "none" else context.CULL_FACE
    context.enable_only(context.DEPTH_TEST | culling)
    context.depth_func = "<"
    context.front_face = pipeline.front_face
    context.cull_face = "front" if pipeline.cull == "front" else "back"
    context.provoking_vertex = context.FIRST_VERTEX_CONVENTION
    functions.glEnable(GL_FRAMEBUFFER_SRGB)
    names = pipeline.clip_control or OWN_CLIP_CONTROL
    functions.glClipControl(*(CLIP_CONTROL[name] for name in names))


@contextmanager
def _bound(
    context: moderngl.Context,
    functions: Functions,
    program: moderngl.Program,
    pipeline: Pipeline,
    draw: Draw,
) -> Iterator[moderngl.VertexArray]:
    """The vertices of a draw, while everything is bound that the program reads."""
    for name in pipeline.host_uniforms:
        uniform = program.get(name, None)
        if isinstance(uniform, moderngl.Uniform):
            uniform.value = float(draw.height)
    blocks = [context.buffer(data) for data in draw.blocks]
    for number, (block, buffer) in enumerate(zip(pipeline.blocks, blocks, strict=True)):
        buffer.bind_to_uniform_block(bound_at(block.place, number))
    attributes = [
        (
            context.buffer(data),
            f"{attribute_layout(slot.format)}{RATES[slot.step]}",
            slot.identifier,
        )
        for slot, data in zip(pipeline.inputs, draw.vertices, strict=True)
        if program.get(slot.identifier, None) is not None
    ]
    indices = context.buffer(draw.indices)
    array = context.vertex_array(program, attributes, index_buffer=indices, index_element_size=4)
    with ExitStack() as textures:
        for number, (slot, image) in enumerate(zip(pipeline.textures, draw.textures, strict=True)):
            unit = bound_at(slot.texture, number)
            textures.enter_context(bound_texture(functions, slot, image, unit))
        yield array

"""Captures the vertices of a job by OpenGL's transform feedback."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import moderngl

from ..capture_job import Captured, CaptureJob
from ..device import DriverError
from ..draw_job import Draw
from ..pipeline import CORNERS, Pipeline, StreamOutput
from .context import Functions
from .program import link
from .vertices import MODES, bound_vertices

GL_TRANSFORM_FEEDBACK_BUFFER = 0x8C8E
GL_RASTERIZER_DISCARD = 0x8C89
GL_UNSIGNED_INT = 0x1405

INDEX_SIZE = 4


def capture_job(context: moderngl.Context, functions: Functions, job: CaptureJob) -> list[Captured]:
    """What each draw captures. Raises ``DriverError``."""
    program = link(context, functions, job.pipeline)
    try:
        return [
            _captured(context, functions, program, job.pipeline, draw, most)
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
    if not draw.indices:  # a buffer of no bytes cannot be made
        return Captured(0, b"")
    context.provoking_vertex = context.FIRST_VERTEX_CONVENTION
    buffer = context.buffer(reserve=max(most, 1) * stream.stride)
    counting = context.query(primitives=True)
    if pipeline.patch_points:
        context.patch_vertices = pipeline.patch_points
    with bound_vertices(context, functions, program, pipeline, draw) as array, counting:
        functions.glUseProgram(program.glo)
        functions.glBindVertexArray(array.glo)
        with _recording(functions, stream, buffer):
            functions.glDrawElementsInstanced(
                MODES[pipeline.primitive],
                len(draw.indices) // INDEX_SIZE,
                GL_UNSIGNED_INT,
                None,
                draw.instance_count,
            )
    count = int(counting.primitives) * CORNERS[stream.primitive]
    if (error := context.error) != "GL_NO_ERROR":
        raise DriverError(f"OpenGL reports {error}")
    if count > most:
        raise DriverError(f"{count} vertices were captured, and there was room for {most}")
    return Captured(count, buffer.read(count * stream.stride) if count else b"")


@contextmanager
def _recording(
    functions: Functions, stream: StreamOutput, buffer: moderngl.Buffer
) -> Iterator[None]:
    """Capture what is drawn inside by the program that is used. moderngl captures no patches."""
    functions.glEnable(GL_RASTERIZER_DISCARD)
    functions.glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer.glo)
    functions.glBeginTransformFeedback(MODES[stream.primitive])
    try:
        yield
    finally:
        functions.glEndTransformFeedback()
        functions.glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0)
        functions.glDisable(GL_RASTERIZER_DISCARD)

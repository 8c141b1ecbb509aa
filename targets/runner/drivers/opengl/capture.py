"""Captures the vertices of a job by OpenGL's transform feedback."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import moderngl

from ..device import DriverError
from ..draws import Draw
from ..frame_job import Captured
from ..pipeline import CORNERS, Pipeline, StreamOutput
from .context import Functions
from .vertices import MODES

GL_TRANSFORM_FEEDBACK_BUFFER = 0x8C8E
GL_RASTERIZER_DISCARD = 0x8C89
GL_UNSIGNED_INT = 0x1405

INDEX_SIZE = 4


def captured(
    context: moderngl.Context,
    functions: Functions,
    pipeline: Pipeline,
    draw: Draw,
    made: tuple[moderngl.Program, moderngl.VertexArray],
    most: int,
) -> Captured:
    """Draw once, and return the captured vertices. Raises ``DriverError``.

    The draw uses a program and its vertices, and the buffer has room for ``most`` vertices.
    """
    stream, (program, array) = pipeline.stream_output, made
    assert stream is not None
    context.provoking_vertex = context.FIRST_VERTEX_CONVENTION
    buffer = context.buffer(reserve=max(most, 1) * stream.stride)
    counting = context.query(primitives=True)
    if pipeline.patch_points:
        context.patch_vertices = pipeline.patch_points
    with counting:
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
    """Capture the draws inside the ``with`` block. moderngl captures no patches."""
    functions.glEnable(GL_RASTERIZER_DISCARD)
    functions.glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer.glo)
    functions.glBeginTransformFeedback(MODES[stream.primitive])
    try:
        yield
    finally:
        functions.glEndTransformFeedback()
        functions.glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0)
        functions.glDisable(GL_RASTERIZER_DISCARD)

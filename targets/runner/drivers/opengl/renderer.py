"""Draws a job with OpenGL; the driver keeps one ``Renderer`` for all jobs."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl

from ..draw import (
    Captured,
    CaptureJob,
    Device,
    Draw,
    DriverError,
    Job,
    KernelJob,
    Picture,
    Pipeline,
    Written,
)
from .capture import capture_job
from .compute import compute_job
from .context import CLIP_CONTROL, GL_FRAMEBUFFER_SRGB, Functions, create_context
from .layered_screen import LayeredScreen
from .program import link
from .screen import Screen
from .vertices import MODES, vertices

OWN_CLIP_CONTROL = ("GL_LOWER_LEFT", "GL_NEGATIVE_ONE_TO_ONE")
"""OpenGL's own clip space, which texts have that are for older versions, too."""


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
        return capture_job(self._context, self._functions, job)

    def compute(self, job: KernelJob) -> Sequence[Written]:
        """Link the job's kernel and run it. Raises ``DriverError``."""
        self._context.clear_errors()  # of a job that broke off
        return compute_job(self._context, self._functions, job)


def _picture(
    context: moderngl.Context,
    functions: Functions,
    program: moderngl.Program,
    pipeline: Pipeline,
    draw: Draw,
) -> Picture:
    size, layers = (draw.width, draw.height), pipeline.layers
    screen = (
        LayeredScreen(context, functions, pipeline.targets, size, layers)
        if layers
        else Screen(context, functions, pipeline.targets, size)
    )
    try:
        _set_state(context, functions, pipeline)
        screen.clear(draw.clear)
        screen.set_blending()
        if draw.indices:  # a buffer of no bytes cannot be made
            with vertices(context, functions, program, pipeline, draw) as array:
                array.render(MODES[pipeline.primitive], instances=draw.instance_count)
        picture = Picture(draw.width, draw.height * (layers or 1), screen.read(pipeline))
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
    if pipeline.patch_points:
        context.patch_vertices = pipeline.patch_points
    functions.glEnable(GL_FRAMEBUFFER_SRGB)
    names = pipeline.clip_control or OWN_CLIP_CONTROL
    functions.glClipControl(*(CLIP_CONTROL[name] for name in names))

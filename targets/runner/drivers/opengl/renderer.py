"""Draws a job with OpenGL; the driver keeps one ``Renderer`` for all jobs."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl

from ..capture_job import Captured, CaptureJob
from ..device import Device, DriverError
from ..draw_job import Draw, Job, Picture
from ..frame_job import FrameJob, FrameTexels
from ..kernel_job import KernelJob, Written
from ..pipeline import Pipeline
from .blending import set_blending
from .capture import capture_job
from .compute import compute_job
from .context import Functions, create_context
from .frame import draw_frame
from .layered_screen import LayeredScreen
from .program import link
from .screen import Screen
from .state import set_state
from .vertices import MODES, bound_vertices


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

    def draw_frame(self, job: FrameJob) -> Sequence[FrameTexels]:
        """Link the job's programs and do its steps. Raises ``DriverError``."""
        self._context.clear_errors()  # of a job that broke off
        try:
            return draw_frame(self._context, self._functions, job)
        finally:
            self._nowhere.use()

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
        LayeredScreen(context, functions, pipeline, size)
        if layers
        else Screen(context, functions, pipeline, size)
    )
    try:
        screen.clear(draw.clear, draw.clear_depth)
        set_state(context, functions, pipeline)
        set_blending(functions, pipeline.targets, draw.blend_constant)
        if draw.indices:  # a buffer of no bytes cannot be made
            with bound_vertices(context, functions, program, pipeline, draw) as array:
                array.render(MODES[pipeline.primitive], instances=draw.instance_count)
        picture = Picture(draw.width, draw.height * (layers or 1), screen.read(pipeline))
    finally:
        screen.release()
    if (error := context.error) != "GL_NO_ERROR":
        raise DriverError(f"OpenGL reports {error}")
    return picture

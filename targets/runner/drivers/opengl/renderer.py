"""Executes frame jobs with OpenGL; the driver keeps one ``Renderer`` for all of them."""

from __future__ import annotations

from collections.abc import Sequence

from ..device import Device
from ..frame_job import Found, FrameJob
from .context import Functions, create_context
from .frame import draw_frame


class Renderer:
    """An OpenGL context that does one job after the other."""

    def __init__(self, wanted: str | None) -> None:
        """``wanted`` is the device, as ``create_context`` takes it."""
        self._context = create_context(wanted)
        self._functions = Functions()
        self._nowhere = self._context.simple_framebuffer((1, 1))
        """The framebuffer that is bound while vertices are captured: OpenGL wants one, although
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

    def most_groups(self) -> Sequence[int]:
        """The most work groups that may run at once, along x, y and z."""
        most: Sequence[int] = self._context.info["GL_MAX_COMPUTE_WORK_GROUP_COUNT"]
        return most

    def draw_frame(self, job: FrameJob) -> Found:
        """Link the job's programs and do its steps. Raises ``DriverError``."""
        self._context.clear_errors()  # of a job that broke off
        self._nowhere.use()
        try:
            return draw_frame(self._context, self._functions, job)
        finally:
            self._nowhere.use()

    def release(self) -> None:
        """Give the context up; nothing is done with it afterwards.

        All of its objects end with it. Python may drop some of them only later, when moderngl would
        delete what the next context has under their numbers: now it only notes them.
        """
        self._context.gc_mode = "context_gc"
        self._context.release()

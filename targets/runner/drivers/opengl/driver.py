"""The OpenGL driver, which uses moderngl.

The first request makes the context, and so does the first one after OpenGL has reported an error.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ....toolchain.tools import tool_named
from ..checks import check_groups, check_names
from ..device import Device, DriverError
from ..frame_job import Found, FrameJob

if TYPE_CHECKING:
    from .renderer import Renderer


class OpenGL:
    """Draws with a ``Renderer``; if moderngl is missing, an error says what to install."""

    def __init__(self, wanted: str | None = None) -> None:
        """``wanted`` is a part of a device's name, or its number; empty for the usual one, and
        ``None`` for Mesa's software."""
        self._wanted = wanted
        self._renderer: Renderer | None = None

    def device(self) -> Device:
        """The OpenGL driver's description of itself."""
        return self._start().device()

    def draw_frame(self, job: FrameJob) -> Found:
        """Do a frame job: returns what it reads back. Raises ``DriverError``."""
        check_names(job)
        renderer = self._start()
        check_groups(job, renderer.most_groups)
        from .frame import ContextError

        try:
            return renderer.draw_frame(job)
        except ContextError:
            self._renderer = None
            renderer.release()
            raise

    def _start(self) -> Renderer:
        if self._renderer is None:
            try:
                from .renderer import Renderer
            except ImportError as error:
                install = tool_named("moderngl").install
                raise DriverError(f"{error}; to install it: {install}") from None
            self._renderer = Renderer(self._wanted)
        return self._renderer

"""The OpenGL driver, which uses moderngl. The first request starts it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ....toolchain.tools import tool_named
from ..capture_job import Captured, CaptureJob
from ..checks import check, check_capture, check_kernel, check_names
from ..device import Device, DriverError
from ..draw_job import Job, Picture
from ..frame_job import FrameJob, FrameTexels
from ..kernel_job import KernelJob, Written

if TYPE_CHECKING:
    from .renderer import Renderer


class OpenGL:
    """Draws with a ``Renderer``; if moderngl is missing, an error says what to install."""

    def __init__(self) -> None:
        self._renderer: Renderer | None = None

    def device(self) -> Device:
        """The OpenGL driver's description of itself."""
        return self._start().device()

    def draw(self, job: Job) -> Sequence[Picture]:
        """A picture for each draw of the job. Raises ``DriverError``."""
        check(job)
        check_names(job.pipeline)
        return self._start().draw(job)

    def compute(self, job: KernelJob) -> Sequence[Written]:
        """What each dispatch of the job writes. Raises ``DriverError``."""
        check_kernel(job)
        return self._start().compute(job)

    def capture(self, job: CaptureJob) -> Sequence[Captured]:
        """The vertices that each draw of the job captures. Raises ``DriverError``."""
        check_capture(job)
        check_names(job.pipeline)
        return self._start().capture(job)

    def draw_frame(self, job: FrameJob) -> Sequence[FrameTexels]:
        """What a frame job reads back. Raises ``DriverError``."""
        return self._start().draw_frame(job)

    def _start(self) -> Renderer:
        if self._renderer is None:
            try:
                from .renderer import Renderer
            except ImportError as error:
                install = tool_named("moderngl").install
                raise DriverError(f"{error}; to install it: {install}") from None
            self._renderer = Renderer()
        return self._renderer

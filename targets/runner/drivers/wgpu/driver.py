"""The driver that ``serve`` runs. The first request opens the device."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ....toolchain.tools import tool_named
from ..by_frames import DrawsByFrames
from ..capture_job import Captured, CaptureJob
from ..checks import check_groups, check_names
from ..device import Device, DriverError
from ..draw_job import Job
from ..frame_job import Found, FrameJob
from ..kernel_job import KernelJob

if TYPE_CHECKING:
    from .device import Gpu


MOST_GROUPS = "max-compute-workgroups-per-dimension"


class Wgpu(DrawsByFrames):
    """Draws with one of the machine's devices."""

    def __init__(self, wanted: str = "") -> None:
        """``wanted`` is a part of the device's name, or its number; empty for the usual one."""
        self._wanted = wanted
        self._gpu: Gpu | None = None

    def device(self) -> Device:
        """The device's description of itself. Raises ``DriverError``."""
        return self._opened().description

    def accept_job(self, job: Job) -> None:
        """Raise ``DriverError`` if a name by which a job binds is not in its text."""
        check_names(job.pipeline)

    def accept_kernel(self, job: KernelJob) -> None:
        """Raise ``DriverError`` if the device does not run so many work groups at once."""
        check_groups(job, [int(self._opened().device.limits[MOST_GROUPS])] * 3)

    def draw_frame(self, job: FrameJob) -> Found:
        """Do a frame job: returns what it reads back. Raises ``DriverError``."""
        gpu = self._opened()
        from .frame import draw_frame

        return draw_frame(gpu, job)

    def capture(self, job: CaptureJob) -> Sequence[Captured]:
        """Raise ``DriverError``: WebGPU has no stream output, and kernels capture there."""
        del job
        raise DriverError("WebGPU has no stream output")

    def _opened(self) -> Gpu:
        if self._gpu is None:
            try:
                from .device import open_gpu
            except (ImportError, OSError) as error:
                install = tool_named("wgpu").install
                raise DriverError(f"{error}; to install it: {install}") from None
            self._gpu = open_gpu(self._wanted)
        return self._gpu

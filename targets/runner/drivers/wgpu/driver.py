"""The driver that ``serve`` runs. The first request opens the device."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ....toolchain.tools import tool_named
from ..capture_job import Captured, CaptureJob
from ..checks import check, check_kernel, check_names
from ..device import Device, DriverError
from ..draw_job import Job, Picture
from ..kernel_job import KernelJob, Written

if TYPE_CHECKING:
    from .device import Gpu


class Wgpu:
    """Draws with one of the machine's devices."""

    def __init__(self, wanted: str = "") -> None:
        """``wanted`` is a part of the device's name, or its number; empty for the usual one."""
        self._wanted = wanted
        self._gpu: Gpu | None = None

    def device(self) -> Device:
        """The device's description of itself. Raises ``DriverError``."""
        return self._opened().description

    def draw(self, job: Job) -> Sequence[Picture]:
        """A picture for each draw of the job. Raises ``DriverError``."""
        check(job)
        check_names(job.pipeline)
        gpu = self._opened()
        from .drawing import draw_job

        return draw_job(gpu, job)

    def compute(self, job: KernelJob) -> Sequence[Written]:
        """What each dispatch of the job writes. Raises ``DriverError``."""
        check_kernel(job)
        gpu = self._opened()
        from .compute import compute_job

        return compute_job(gpu, job)

    def capture(self, _job: CaptureJob) -> Sequence[Captured]:
        """WebGPU has no stream output: kernels capture there. Raises ``DriverError``."""
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

"""The Vulkan driver that ``serve`` runs.

The first request opens the device, and so does the first one after the device was lost.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from ....closing import Closing
from ..capture_job import Captured, CaptureJob
from ..device import Device, DriverError
from ..draw_job import Job, Picture
from ..frame_job import FrameJob, FrameTexels
from ..kernel_job import KernelJob, Written

if TYPE_CHECKING:
    from .device import Gpu


class VulkanDriver(Closing):
    """Draws with the driver that a file announces, or with any of the machine's; a context manager.

    Vulkan's loader chooses the driver by the environment of the process: ``VK_DRIVER_FILES`` must
    name ``icd`` before the first request, if that is not empty.
    """

    def __init__(self, icd: str, seconds: float, device: str = "") -> None:
        """``seconds`` is how long one draw may take; the process ends if one takes longer.

        ``device`` is a part of the device's name, or its number; empty for the usual one.
        """
        self._icd = icd
        self._seconds = seconds
        self._device = device
        self._owned = ExitStack()
        self._gpu: Gpu | None = None

    def close(self) -> None:
        """Destroy everything; raises ``DriverError`` if the validation layer objects."""
        gpu, self._gpu = self._gpu, None
        self._owned.close()
        if gpu is not None:
            gpu.messages.check()

    def device(self) -> Device:
        """The device with which it draws. Raises ``DriverError`` if it cannot draw."""
        gpu = self._opened()
        from .device import describe

        return describe(gpu)

    def draw(self, job: Job) -> Sequence[Picture]:
        """A picture for each draw. Raises ``DriverError``, also for any message of the validation
        layer."""
        gpu = self._opened()
        from . import errors
        from .job import draw_job

        try:
            with errors.explained(gpu.messages):
                return draw_job(gpu, job)
        except errors.DeviceLostError:
            self.close()
            raise

    def compute(self, job: KernelJob) -> Sequence[Written]:
        """What each dispatch writes. Raises ``DriverError`` as ``draw`` does."""
        gpu = self._opened()
        from . import errors
        from .compute import compute_job

        try:
            with errors.explained(gpu.messages):
                return compute_job(gpu, job)
        except errors.DeviceLostError:
            self.close()
            raise

    def capture(self, job: CaptureJob) -> Sequence[Captured]:
        """The vertices that each draw captures. Raises ``DriverError`` as ``draw`` does."""
        gpu = self._opened()
        from . import errors
        from .capture import capture_job

        try:
            with errors.explained(gpu.messages):
                return capture_job(gpu, job)
        except errors.DeviceLostError:
            self.close()
            raise

    def draw_frame(self, job: FrameJob) -> Sequence[FrameTexels]:
        """What a frame job keeps. Raises ``DriverError`` as ``draw`` does."""
        gpu = self._opened()
        from . import errors
        from .frame import draw_frame

        try:
            with errors.explained(gpu.messages):
                return draw_frame(gpu, job)
        except errors.DeviceLostError:
            self.close()
            raise

    def _opened(self) -> Gpu:
        if self._gpu is None:
            if self._icd and not Path(self._icd).is_file():
                raise DriverError(f"there is no Vulkan driver at {self._icd}")
            try:
                from .device import open_gpu
            except (ImportError, OSError) as error:
                raise DriverError(f"Vulkan cannot be used: {error}") from error
            with ExitStack() as owned:
                self._gpu = open_gpu(owned, self._seconds, self._device)
                self._owned = owned.pop_all()
        return self._gpu

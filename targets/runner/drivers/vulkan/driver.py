"""The Vulkan driver that ``serve`` runs.

The first request opens the device, and so does the first one after the device was lost.
"""

from __future__ import annotations

from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ....closing import Closing
from ..device import Device, DriverError
from ..frame_job import Found, FrameJob

if TYPE_CHECKING:
    from .device import Gpu

REFUSED = "Vulkan refuses a part of the job:"
"""The line before what the validation layer says of a job."""


class VulkanDriver(Closing):
    """Draws with the driver that a file announces, or with any of the machine's; a context manager.

    Vulkan's loader chooses the driver by the environment of the process: ``VK_DRIVER_FILES`` must
    name ``icd`` before the first request, if that is not empty.
    """

    def __init__(self, icd: str, seconds: float, device: str = "") -> None:
        """``seconds`` is the time for all work up to a read-back: one draw, or a whole frame.

        The process ends if that takes longer. ``device`` is a part of the device's name, or its
        number; empty for the usual one.
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

    def draw_frame(self, job: FrameJob) -> Found:
        """Do a frame job: returns what it reads back.

        Raises ``DriverError``, also for any message of the validation layer.
        """
        gpu = self._opened()
        from . import errors
        from .frame import draw_frame
        from .limits import check_limits

        check_limits(gpu, job)
        try:
            with errors.explained(gpu.messages, REFUSED):
                return draw_frame(gpu, job)
        except errors.DeviceLostError:
            # A layer may object to how a lost device is closed, which is not what has happened.
            with suppress(DriverError):
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

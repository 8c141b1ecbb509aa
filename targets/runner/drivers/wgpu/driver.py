"""The driver that ``serve`` runs.

The first request opens the device, and so does the first one after the device was lost.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ....toolchain.tools import tool_named
from ..checks import check_groups, check_names
from ..device import Device, DriverError
from ..frame_job import Found, FrameJob

if TYPE_CHECKING:
    from .device import Gpu


MOST_GROUPS = "max-compute-workgroups-per-dimension"


class Wgpu:
    """Draws with one of the machine's devices."""

    def __init__(self, wanted: str = "") -> None:
        """``wanted`` is a part of the device's name, or its number; empty for the usual one."""
        self._wanted = wanted
        self._gpu: Gpu | None = None

    def device(self) -> Device:
        """The device's description of itself. Raises ``DriverError``."""
        return self._opened().description

    def draw_frame(self, job: FrameJob) -> Found:
        """Do a frame job: returns what it reads back. Raises ``DriverError``."""
        check_names(job)
        gpu = self._opened()
        check_groups(job, lambda: [int(gpu.device.limits[MOST_GROUPS])] * 3)
        from .device import DeviceLostError
        from .frame import draw_frame

        try:
            return draw_frame(gpu, job)
        except DeviceLostError:
            self._gpu = None
            raise

    def _opened(self) -> Gpu:
        if self._gpu is None:
            try:
                from .device import open_gpu
            except (ImportError, OSError) as error:
                install = tool_named("wgpu").install
                raise DriverError(f"{error}; to install it: {install}") from None
            self._gpu = open_gpu(self._wanted)
        return self._gpu

"""The driver's side of the pipe: answers the packets that ``runner.py`` sends.

Each driver's ``__main__`` calls ``serve``. A driver may crash or hang, so it runs in a process of
its own. Bytes of jobs and of results follow the JSON of packets, see ``wire.py``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any, Protocol, runtime_checkable

from ...toolchain import pipe
from ...toolchain.pipe import Packet
from .device import Device, DriverError
from .frame_checks import check_frame
from .frame_job import Found, FrameJob, FrameTexels
from .wire import joined, split, to_json

ORPHAN_LIMIT = 900.0
"""The seconds after which a request ends the process: far more than callers wait for."""


class Driver(Protocol):
    """The interface of a driver."""

    def device(self) -> Device:
        """The device with which it draws."""

    def draw_frame(self, job: FrameJob) -> Found:
        """Do a frame job: returns what it reads back. Raises ``DriverError``."""


@runtime_checkable
class PackageDriver(Protocol):
    """A driver that draws packages of frames."""

    def draw_package(self, request: Mapping[str, Any]) -> Sequence[FrameTexels]:
        """Draw frames of a package: returns the texels of each output that the request names.

        They come frame after frame. Raises ``DriverError``.
        """


def serve(driver: Driver) -> None:
    """Answer requests until the input ends."""
    pipe.serve(partial(_answer, driver), ORPHAN_LIMIT)


def _answer(driver: Driver, request: Packet) -> Packet:
    """The answer to ``{"frame": …}`` has ``found``, that to ``{"package": …}`` has ``texels``, and
    that to ``{}`` has ``device``; or it has ``error``."""
    content = request.content
    try:
        if "frame" in content:
            frame = joined(FrameJob, content["frame"], request.data)
            check_frame(frame)
            return _packet("found", driver.draw_frame(frame))
        if "package" in content:
            if not isinstance(driver, PackageDriver):
                return Packet({"error": "this driver draws no packages of frames"})
            return _packet("texels", Found(tuple(driver.draw_package(content["package"]))))
        return Packet({"device": to_json(driver.device())})
    except DriverError as error:
        return Packet({"error": str(error)})


def _packet(name: str, record: Found) -> Packet:
    content, data = split(record)
    return Packet({name: content}, data)

"""The driver's side of the pipe: reads a JSON request per line and writes a JSON answer per line.

Each driver's ``__main__`` calls ``serve``. A driver may crash or hang, so it runs in a process of
its own.
"""

from __future__ import annotations

import faulthandler
import json
import os
import sys
from collections.abc import Mapping, Sequence
from typing import Any, Protocol, runtime_checkable

from .device import Device, DriverError
from .frame_checks import check_frame
from .frame_job import Found, FrameJob, FrameTexels
from .wire import from_json, to_json

ORPHAN_LIMIT = 900.0
"""The seconds after which a request ends the process. The sender waits for less time; so this
happens only if the sender has died, which a driver that hangs does not notice."""


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
    """Answer requests until the input ends. Whatever libraries print goes to standard error."""
    with os.fdopen(os.dup(1), "w") as answers:
        os.dup2(2, 1)
        for line in sys.stdin:
            faulthandler.dump_traceback_later(ORPHAN_LIMIT, exit=True)
            answers.write(json.dumps(_answer(driver, json.loads(line))) + "\n")
            answers.flush()
            faulthandler.cancel_dump_traceback_later()


def _answer(driver: Driver, request: dict[str, Any]) -> dict[str, Any]:
    """The answer to ``{"frame": …}`` has ``found``, that to ``{"package": …}`` has ``texels``, and
    that to ``{}`` has ``device``; or it has ``error``."""
    try:
        if "frame" in request:
            frame = from_json(FrameJob, request["frame"])
            check_frame(frame)
            return {"found": to_json(driver.draw_frame(frame))}
        if "package" in request:
            if not isinstance(driver, PackageDriver):
                return {"error": "this driver draws no packages of frames"}
            return {"texels": to_json(tuple(driver.draw_package(request["package"])))}
        return {"device": to_json(driver.device())}
    except DriverError as error:
        return {"error": str(error)}

"""The driver's side of the pipe: a JSON request a line in, a JSON answer a line out.

A driver may crash or hang, and a worker process is what it may take with it.
"""

from __future__ import annotations

import faulthandler
import json
import os
import sys
from collections.abc import Sequence
from typing import Any, Protocol

from .draw import Device, DriverError, Job, Picture
from .wire import from_json, to_json

ORPHAN_LIMIT = 900.0
"""Seconds after which a request ends the process. Who asked has a shorter patience, unless it has
died, and a driver that hangs does not see that."""


class Driver(Protocol):
    """What draws."""

    def device(self) -> Device:
        """What it draws with."""

    def draw(self, job: Job) -> Sequence[Picture]:
        """A picture for each draw of the job. Raises ``DriverError``."""


def serve(driver: Driver) -> None:
    """Answers requests until the input ends. What libraries print goes to standard error."""
    with os.fdopen(os.dup(1), "w") as answers:
        os.dup2(2, 1)
        for line in sys.stdin:
            faulthandler.dump_traceback_later(ORPHAN_LIMIT, exit=True)
            answers.write(json.dumps(_answer(driver, json.loads(line))) + "\n")
            answers.flush()
            faulthandler.cancel_dump_traceback_later()


def _answer(driver: Driver, request: dict[str, Any]) -> dict[str, Any]:
    """``{"job": …}`` is answered by ``pictures``, ``{}`` by ``device``; or either by ``error``."""
    try:
        if "job" not in request:
            return {"device": to_json(driver.device())}
        return {"pictures": to_json(tuple(driver.draw(from_json(Job, request["job"]))))}
    except DriverError as error:
        return {"error": str(error)}

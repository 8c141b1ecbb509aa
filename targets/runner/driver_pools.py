"""The worker processes of all drivers, and how another process asks them.

A ``Runner`` sends its jobs to ``DriverPools``. The runner of a process that judges for ``burnish
conform`` has ``LentDrivers`` instead: Burnish's main process lends it the drivers, so that there
are no more of them than without such processes.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from ..closing import Closing
from ..toolchain.pipe import Ask, Packet
from ..toolchain.tools import ToolState
from ..toolchain.workers import Answer, Pool, Worker
from .routes import EVERY_DRIVER, DriverRow

_DRIVER = "driver"
"""The key of a packet that asks a driver, with the driver's name."""


class Drivers(Protocol):
    """The processes of drivers, which wait to be asked."""

    def ask(self, driver: str, request: Packet, time_limit: float) -> Answer:
        """Send a request to a process of a driver, which has some seconds for it."""

    def close(self) -> None:
        """End all processes."""


class DriverPools(Closing):
    """A few processes of each driver, which start when they are first asked."""

    def __init__(self, states: Mapping[str, ToolState], device: str, count: int) -> None:
        """``states`` are those of the tools that drivers need, and ``device`` is that of drivers
        that can draw with any. ``count`` processes of each driver draw at once."""
        self._states, self._device = states, device
        self._pools = {row.name: self._pool(row, count) for row in EVERY_DRIVER.values()}

    def close(self) -> None:
        """End all processes."""
        for pool in self._pools.values():
            pool.close()

    def ask(self, driver: str, request: Packet, time_limit: float) -> Answer:
        """Send a request to a process of a driver; waits until one is free."""
        with self._pools[driver].borrow() as worker:
            return worker.ask(request.content, time_limit, request.data)

    def _pool(self, row: DriverRow, count: int) -> Pool:
        return Pool(
            1 if row.one_worker else count,
            lambda: Worker(
                lambda: row.command(self._states, self._device), row.limits, tells_command=False
            ),
        )


class LentDrivers:
    """The drivers of the process that has started this one."""

    def __init__(self, ask: Ask) -> None:
        self._ask = ask

    def ask(self, driver: str, request: Packet, time_limit: float) -> Answer:
        """Have that process send a request; one is sent after the other."""
        question = {_DRIVER: driver, "request": request.content, "limit": time_limit}
        content, data = self._ask(Packet(question, request.data))
        return Answer(content["ending"], content["reply"], content["log"], data)

    def close(self) -> None:
        """Do nothing: the drivers are not this process's own."""


def asks_driver(reply: Mapping[str, Any]) -> bool:
    """True if a process that judges has not answered yet, but asks a driver."""
    return _DRIVER in reply


def asked_for(drivers: Drivers, answer: Answer) -> Packet:
    """Ask a driver as a process that judges wants; returns what is to be sent to it."""
    reply = answer.reply
    found = drivers.ask(reply[_DRIVER], Packet(reply["request"], answer.data), reply["limit"])
    said = {"ending": found.ending, "reply": found.reply, "log": found.log}
    return Packet(said, found.data)

"""Sends jobs to the drivers' worker processes, and keeps their results in a store.

``render`` and ``conform`` draw through one ``Runner``.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from itertools import chain
from pathlib import Path
from threading import Lock

from ...compiler.documents.writing import to_json as document_json
from ..closing import Closing
from ..toolchain.pipe import Packet
from ..toolchain.tools import ToolState
from ..web_host.serving.modules import host_modules
from ..web_host.serving.packages import Package
from .driver_pools import DriverPools, Drivers
from .drivers.device import Device, DriverError, EndedError
from .drivers.frame_job import Found, FrameJob, FrameTexels
from .drivers.wire import from_json, joined, packed, split, unpacked
from .job_sizes import check_job
from .routes import EVERY_DRIVER, Route, inspect_tools, problem, versions
from .store import Store, digest, digest_of_sources

STORE = "pictures"
"""The name of the store that keeps the results of jobs."""

TIME_LIMIT = 120.0
"""The seconds that one job may take, including the start of its driver."""
MOST_DEATHS = 3
"""The number of processes that may end without an answer when they are asked for their device.

Then no further one is started. One may have been killed from outside, and the next would draw.
"""


class Runner(Closing):
    """Owns the drivers' workers. Use it as a context manager, for many jobs and threads."""

    def __init__(
        self,
        routes: Iterable[Route],
        *,
        time_limit: float = TIME_LIMIT,
        parallel: int | None = None,
        reuse: bool = True,
        device: str = "",
        drivers: Drivers | None = None,
        states: Mapping[str, ToolState] | None = None,
    ) -> None:
        """``routes`` are those that will draw.

        ``parallel`` workers of each driver draw at once, by default one per core. Without ``reuse``
        nothing is taken from the store. ``device`` names the device of drivers that can draw with
        any: a part of its name, or its number; empty for the usual one. ``drivers`` are asked
        instead of processes that this runner starts. ``states`` are those of the routes' tools, if
        these were looked for before.
        """
        self._time_limit = time_limit
        self.states = inspect_tools(routes) if states is None else states
        """The states of the tools that the routes need, by name."""
        self._store = Store(STORE) if reuse else None
        count = parallel or os.cpu_count() or 1
        self.drivers = drivers or DriverPools(self.states, device, count)
        self._devices: dict[str, Device | DriverError] = {}
        self._deaths = dict.fromkeys(EVERY_DRIVER, 0)
        self._locks = {name: Lock() for name in EVERY_DRIVER}

    def close(self) -> None:
        """End all workers."""
        self.drivers.close()

    def problem(self, route: Route) -> str | None:
        """The reasons why a route cannot draw on this machine, tool by tool; ``None`` if it can."""
        return problem(route, self.states)

    def versions(self, route: Route) -> dict[str, str]:
        """The versions of a route's tools, as far as they are known."""
        return versions(route, self.states)

    def device(self, route: Route) -> Device:
        """The device that a route draws with. Raises ``DriverError``.

        It is asked only once, or again where a process has ended without an answer.
        """
        name = route.driver
        with self._locks[name]:
            found = self._devices.get(name)
            if found is None:
                found = self._asked_device(name)
        if isinstance(found, DriverError):
            raise found
        return found

    def _asked_device(self, driver: str) -> Device | DriverError:
        """The device, or the reason why there is none; kept unless the next try may differ."""
        try:
            answer = self._ask(driver, Packet({}))
        except EndedError as error:
            self._deaths[driver] += 1
            if self._deaths[driver] < MOST_DEATHS:
                return error
            found: Device | DriverError = error
        except DriverError as error:
            found = error
        else:
            found = from_json(Device, answer.content["device"])
        self._devices[driver] = found
        return found

    def draw_frame(self, route: Route, job: FrameJob, *, keep: bool = True) -> Found:
        """Do a frame job: returns what it reads back, from the store if it was done before.

        Without ``keep``, the store has no part in it. Raises ``DriverError``, and ``BudgetError``
        for a job that sends or reads back too much.
        """
        check_job(job)
        request = frame_request(job)
        if self._store is None or not keep:
            return self._found(route, request)
        name = self._digest(route, request)
        kept = self._store.read(name)
        if kept is not None:
            return unpacked(Found, kept)
        found = self._found(route, request)
        self._store.write(name, packed(found))
        return found

    def draw_package(
        self, route: Route, package: Package, outputs: Sequence[str], count: int
    ) -> tuple[FrameTexels, ...]:
        """Draw a frame ``count`` times in a web page: returns the texels of some of its outputs.

        Raises ``DriverError``.
        """
        request = {"whole": document_json(package), "outputs": list(outputs), "count": count}
        answer = self._ask(route.driver, Packet({"package": request}))
        return joined(Found, answer.content["texels"], answer.data).texels

    def _found(self, route: Route, request: Packet) -> Found:
        answer = self._ask(route.driver, request)
        return joined(Found, answer.content["found"], answer.data)

    def _ask(self, driver: str, request: Packet) -> Packet:
        answer = self.drivers.ask(driver, request, self._time_limit)
        if answer.ending != "ended":
            kind = EndedError if answer.ending == "crashed" else DriverError
            raise kind(f"{driver} {answer.ending}: {answer.log.strip()}")
        if "error" in answer.reply:
            raise DriverError(answer.reply["error"])
        return Packet(answer.reply, answer.data)

    def _digest(self, route: Route, request: Packet) -> str:
        device = self.device(route)
        about = (route.driver, device.name, device.version, *map(str, self.versions(route).items()))
        return digest(_runner_digest(), *about, json.dumps(request.content), request.data)


def frame_request(job: FrameJob) -> Packet:
    """The packet that asks a driver's process to do a job."""
    content, data = split(job)
    return Packet({"frame": content}, data)


@cache
def _runner_digest() -> str:
    """A digest of the code that draws: of this package, and of the modules of the host for web
    pages, with which browsers draw."""
    host = chain.from_iterable(host_modules().items())
    return digest(digest_of_sources(Path(__file__).parent), *host)

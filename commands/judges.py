"""Several processes that compile files and judge subjects for ``burnish conform``.

Python computes in one thread of a process at a time, so whole subjects go to processes: with all
that is computed for them, from the compiler to the comparison of pictures. Only the drivers stay
with the main process, which asks them for its helpers. A process that ends for any reason costs
only time: the main process does its work.
"""

from __future__ import annotations

import os
import pickle
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from ..compiler.budget import current
from ..targets.closing import Closing
from ..targets.runner.driver_pools import Drivers, asked_for, asks_driver
from ..targets.runner.drivers.device import DriverError
from ..targets.toolchain.limits import WORKERS
from ..targets.toolchain.surroundings import python_worker
from ..targets.toolchain.workers import Pool, Worker
from .compared import ConformRequest
from .judge import Contents, Judge, Unit

if TYPE_CHECKING:
    from ..targets.conformance.rows import Row

T = TypeVar("T")

_PROCESS = f"{__package__}.judging_process"
TIME_LIMIT = 600.0
"""The seconds after which a process is given up that neither answers nor asks a driver."""


class Judges(Closing):
    """A few processes; several threads may ask them at once."""

    def __init__(self, request: ConformRequest, size: int, here: Judge, drivers: Drivers) -> None:
        """``here`` does the work of processes that fail, and ``drivers`` draw for all of them."""
        self._about = os.getcwd(), request, current()  # noqa: PTH109 - Processes start elsewhere.
        self._here, self._drivers = here, drivers
        self._pool = Pool(size, lambda: Worker(lambda: python_worker(_PROCESS), WORKERS))
        self._closed = False

    def close(self) -> None:
        """End all processes; whoever waits for one of them gets a ``DriverError``."""
        self._closed = True
        self._pool.close()

    def contents(self, file: Path) -> Contents:
        """The contents of a file."""
        return self._asked(self._here.contents, file)

    def rows(self, unit: Unit) -> Sequence[Row]:
        """The rows of a subject. Raises ``CompileError``, ``DriverError`` and ``MemoryError``."""
        return self._asked(self._here.rows, unit)

    def _asked(self, work: Callable[[Any], T], about: Path | Unit) -> T:
        """Have a process do what a method of ``Judge`` does here."""
        question = pickle.dumps((*self._about, work.__name__, about))
        with self._pool.borrow() as worker:
            answer = worker.ask({}, TIME_LIMIT, question)
            while asks_driver(answer.reply) and not self._closed:
                given = asked_for(self._drivers, answer)
                answer = worker.ask(given.content, TIME_LIMIT, given.data)
        if self._closed:
            raise DriverError("the run has ended")
        if "lacks_memory" in answer.reply:
            raise MemoryError
        if not answer.data:
            return work(about)
        found: T = pickle.loads(answer.data)
        return found

"""A process that compiles files and judges subjects, as ``judges.py`` asks it to."""

from __future__ import annotations

import os
import pickle
from collections.abc import Mapping
from pathlib import Path

from ..compiler.budget import raised
from ..targets.runner.driver_pools import LentDrivers
from ..targets.runner.routes import select
from ..targets.runner.runner import Runner
from ..targets.toolchain import Toolchain
from ..targets.toolchain.pipe import Ask, Packet, converse
from .compared import ConformRequest
from .judge import Judge, Unit
from .judges import TIME_LIMIT


class _Process:
    """The judge of this process, which stays the same for all that it is asked."""

    def __init__(self) -> None:
        self._judge: Judge | None = None

    def answer(self, question: Packet, ask: Ask) -> Packet:
        """Do what the main process wants; it may be asked for its drivers meanwhile."""
        here: str
        request: ConformRequest
        limits: Mapping[str, int]
        work: str
        about: Path | Unit
        here, request, limits, work, about = pickle.loads(question.data)
        os.chdir(here)  # Files are named as on the command line.
        if self._judge is None:
            routes = select([request.routes])
            runner = Runner(routes, drivers=LentDrivers(ask))
            self._judge = Judge(request, routes, runner, Toolchain(parallel=1))
        try:
            with raised(limits):
                return Packet({}, pickle.dumps(getattr(self._judge, work)(about)))
        except MemoryError:
            return Packet({"lacks_memory": True})


if __name__ == "__main__":
    converse(_Process().answer, 1.5 * TIME_LIMIT)

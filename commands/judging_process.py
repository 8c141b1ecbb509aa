"""A process that compiles files and judges subjects, as ``judges.py`` asks it to."""

from __future__ import annotations

import os
import pickle
import tempfile

from ..compiler.budget import raised
from ..targets.runner.driver_pools import LentDrivers
from ..targets.runner.routes import select
from ..targets.runner.runner import Runner
from ..targets.toolchain import Toolchain
from ..targets.toolchain.pipe import Ask, Packet, converse
from .helping import LentHelpers
from .judge import Judge, PartOf
from .judges import TIME_LIMIT, Asked, Setting


class _Process:
    """The judge of this process, which stays the same for all that it is asked."""

    def __init__(self) -> None:
        self._judge: Judge | None = None

    def answer(self, question: Packet, ask: Ask) -> Packet:
        """Do what the main process wants, which may be asked for drivers and for help meanwhile."""
        setting: Setting
        work: str
        about: Asked | PartOf
        setting, work, about = pickle.loads(question.data)
        if self._judge is None:
            self._judge = _judge_in(setting, ask)
        try:
            with raised(setting.limits):
                return Packet({}, pickle.dumps(getattr(self._judge, work)(about)))
        except MemoryError:
            return Packet({"lacks_memory": True})


def _judge_in(setting: Setting, ask: Ask) -> Judge:
    """A judge that works as the main process's own one does."""
    os.chdir(setting.folder)  # Files are named as on the command line.
    os.environ["TMPDIR"] = tempfile.tempdir = setting.temporary
    routes = select([setting.request.routes])
    runner = Runner(routes, drivers=LentDrivers(ask), states=setting.states)
    toolchain = Toolchain(parallel=1, states=setting.states)
    return Judge(setting.request, routes, runner, toolchain, LentHelpers(ask))


if __name__ == "__main__":
    converse(_Process().answer, 1.5 * TIME_LIMIT)

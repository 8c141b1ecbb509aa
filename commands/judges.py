"""Several processes that compile files and judge subjects for ``burnish conform``.

Python computes in one thread of a process at a time, so whole subjects go to processes: with all
that is computed for them, from the compiler to the comparison of pictures. Only the drivers stay
with the main process, which asks them for its helpers. A process that crashes, hangs or lacks
memory costs only time: the main process does its work.
"""

from __future__ import annotations

import os
import pickle
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from ..compiler.budget import current
from ..targets.closing import Closing
from ..targets.runner.driver_pools import asked_for, asks_driver
from ..targets.runner.drivers.device import DriverError
from ..targets.runner.runner import Runner
from ..targets.toolchain.limits import WORKERS
from ..targets.toolchain.pipe import Packet
from ..targets.toolchain.surroundings import python_worker
from ..targets.toolchain.tools import ToolState
from ..targets.toolchain.workers import Answer, Pool, Worker
from .compared import ConformRequest
from .helping import Offers, Part, asks_help
from .judge import Contents, GoldenOf, Judge, PartOf, Unit

if TYPE_CHECKING:
    from ..targets.conformance.gathering import Work
    from ..targets.conformance.golden.writing import GoldenPart
    from ..targets.conformance.rows import Row

T = TypeVar("T")

Asked = Path | Unit | GoldenOf
"""What a process is asked about."""

_PROCESS = f"{__package__}.judging_process"
TIME_LIMIT = 600.0
"""The seconds after which a process is given up that neither answers nor asks a driver."""
TRIES = 2
"""The number of processes that may lack memory for the same work."""


class Setting(NamedTuple):
    """All that a process has to know of the main process to judge as that would."""

    request: ConformRequest
    folder: str
    """The folder from which files are named."""
    temporary: str
    """The folder for temporary files, which are deleted even if the process is killed."""
    limits: Mapping[str, int]
    """The limits of the command's budget."""
    states: Mapping[str, ToolState]
    """The states of the routes' tools. A process that looked for these itself might not find one,
    if the machine is so busy that a program does not say its version in time."""


class Judges(Closing):
    """A few processes, and a thread for each that waits for it."""

    def __init__(
        self, request: ConformRequest, size: int, here: Judge, runner: Runner, folder: str = ""
    ) -> None:
        """``here`` does the work of processes that fail, and the runner's drivers draw for all of
        them. Files are named from ``folder``, by default the current one."""
        self._here, self._drivers = here, runner.drivers
        self._temporary = TemporaryDirectory(prefix="burnish-conform-", ignore_cleanup_errors=True)
        self._setting = Setting(
            request, folder or os.getcwd(), self._temporary.name, current(),  # noqa: PTH109
            runner.states,
        )  # fmt: skip
        self._pool = Pool(size, lambda: Worker(lambda: python_worker(_PROCESS), WORKERS))
        self._threads = ThreadPoolExecutor(size)
        """Each of them waits for a process."""
        self._closed = False

    def close(self) -> None:
        """End all processes; whoever waits for one of them gets a ``DriverError``.

        Threads end with the processes for which they wait: nobody waits for the threads.
        """
        self._threads.shutdown(wait=False, cancel_futures=True)
        self._closed = True
        self._pool.close()
        self._temporary.cleanup()

    def contents(self, files: Iterable[Path]) -> Iterator[Contents]:
        """The contents of some files. Raises ``DriverError`` and ``MemoryError``."""
        return self._threads.map(partial(self._asked, self._here.contents), files)

    def begin(self, unit: Unit) -> Work:
        """Have a process judge a subject, behind all with which others were asked to begin."""
        return self._threads.submit(self._rows, unit)

    def begin_golden(self, about: GoldenOf) -> Future[GoldenPart | str]:
        """Have a process compute the bounds of a subject, likewise."""
        return self._threads.submit(self._asked, self._here.golden, about)

    def _rows(self, unit: Unit) -> Sequence[Row]:
        """The rows of a subject. Raises ``DriverError``."""
        from ..targets.conformance.rows import LACKS_MEMORY

        try:
            return self._asked(self._here.rows, unit)
        except MemoryError:
            return self._here.failed(unit, LACKS_MEMORY)

    def _part(self, about: Asked, common: bytes, number: int) -> Part:
        """A part of the work of another process; ``None`` if this one has failed, too.

        Raises ``DriverError``.
        """
        assert isinstance(about, Unit), "only pictures have parts"
        question = self._question(self._here.part, PartOf(about, common, number))
        with self._pool.borrow() as worker, _restarted_if_left(worker):
            answer = self._reply(worker, question)
            assert not (asks_driver(answer.reply) or asks_help(answer.reply)), "a part asks nothing"
        found: Part = pickle.loads(answer.data) if answer.data else None
        return found

    def _asked(self, work: Callable[[Any], T], about: Asked) -> T:
        """Have a process do what a method of ``Judge`` does here."""
        question = self._question(work, about)
        with self._pool.borrow() as worker:
            for _ in range(TRIES):
                answer = self._answer(worker, question, about)
                if "lacks_memory" not in answer.reply:
                    break
                worker.restart()  # Earlier work may have left much in its memory.
        if not answer.data:
            return work(about)
        found: T = pickle.loads(answer.data)
        return found

    def _question(self, work: Callable[[Any], object], about: Asked | PartOf) -> Packet:
        return Packet({}, pickle.dumps((self._setting, work.__name__, about)))

    def _answer(self, worker: Worker, question: Packet, about: Asked) -> Answer:
        """The answer of a process, whose own questions are answered meanwhile."""
        offers = Offers(self._threads, partial(self._part, about))
        try:
            with _restarted_if_left(worker):
                answer = self._reply(worker, question)
                while True:
                    if asks_driver(answer.reply):
                        packet = asked_for(self._drivers, answer)
                    elif asks_help(answer.reply):
                        packet = offers.answer(answer.reply, answer.data)
                    else:
                        return answer
                    answer = self._reply(worker, packet)
        finally:
            offers.withdraw()

    def _reply(self, worker: Worker, packet: Packet) -> Answer:
        """The reply of a process to a packet. Raises ``DriverError`` once the run has ended."""
        wanted = not self._closed  # An ended process would be started anew.
        answer = worker.ask(packet.content, TIME_LIMIT, packet.data) if wanted else None
        if answer is None or self._closed:
            raise DriverError("the run has ended")
        return answer


@contextmanager
def _restarted_if_left(worker: Worker) -> Iterator[None]:
    """Ends a process whose conversation is left in the middle: it would answer the next question
    with what it was asked before."""
    try:
        yield
    except BaseException:
        worker.restart()
        raise

"""Compiles and draws all that ``burnish conform`` compares, in several processes if that pays."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

import click

from ..targets.conformance.conform import conform
from ..targets.conformance.gathering import Stop, Told, Work, gathered
from ..targets.conformance.scheduling import begun
from ..targets.runner.runner import Runner
from ..targets.toolchain import Toolchain
from .compared import ConformRequest, Subjects, tell
from .judge import Judge, Unit
from .judges import Judges
from .progress import Progress
from .stopping import Stopping

if TYPE_CHECKING:
    from ..targets.conformance.rows import Row
    from ..targets.runner.routes import Route

SEVERAL = 4
"""The number of files, or of subjects, from which on processes pay, which take a while to start."""


class Run:
    """The comparison of all subjects with the reference, as far as it has come."""

    def __init__(
        self,
        request: ConformRequest,
        routes: Sequence[Route],
        stopping: Stopping,
        told: Told | None = None,
    ) -> None:
        """``told`` gets each row as soon as it and all rows before it are known."""
        self._request, self._routes = request, routes
        self._stopping, self._told = stopping, told
        self.subjects: Subjects = []
        """The subjects as they are meant, if this process judges them: then rows lack reasons."""
        self.total: int | None = None
        """The number of rows, once it is known."""
        self.rows: list[Row] = []
        """The rows; those of a material follow each other."""

    def draw(self) -> None:
        """Compile and draw everything, or as much as there is time for until a signal comes."""
        request, routes = self._request, self._routes
        size = os.cpu_count() or 1
        with (
            Runner(routes, device=request.device) as runner,
            Toolchain() as toolchain,
            Progress("comparing") as progress,
        ):
            if request.device:
                _check_named_device(runner, routes)
            judge = Judge(request, routes, runner, toolchain)
            with Judges(request, size, judge, runner.drivers) as judges, _threads(size) as threads:
                units = self._compiled(judge, judges, threads)
                self.total = len(units) * len(routes)
                if request.explain is None and len(units) >= SEVERAL:
                    self._judge(units, judges, threads, progress)
                    return
            self._judge_here(judge, runner, toolchain, progress)

    def _compiled(
        self, judge: Judge, judges: Judges, threads: ThreadPoolExecutor
    ) -> Sequence[Unit]:
        """All subjects. Raises ``CompileError`` with the errors of all files."""
        files = self._request.files
        pays = self._request.explain is None and len(files) >= SEVERAL
        contents = threads.map(judges.contents, files) if pays else map(judge.contents, files)
        found = list(contents)
        tell([each.said for each in found])
        return [unit for each in found for unit in each.units]

    def _judge(
        self,
        units: Sequence[Unit],
        judges: Judges,
        threads: ThreadPoolExecutor,
        progress: Progress,
    ) -> None:
        """Have processes judge subjects, one process a whole subject."""
        works: dict[int, Work] = {}
        for number in begun([unit.cost for unit in units], os.cpu_count() or 1):
            works[number] = threads.submit(judges.rows, units[number])
        in_order = [works[number] for number in sorted(works)]
        stop = Stop()
        with self._stopping.by(stop.ask):
            self.rows = gathered(
                in_order, len(units) * len(self._routes), stop=stop,
                done=partial(_tell_share, progress), told=self._above(progress),
            )  # fmt: skip

    def _judge_here(
        self, judge: Judge, runner: Runner, toolchain: Toolchain, progress: Progress
    ) -> None:
        """Judge the few subjects that there are in threads of this process."""
        found = [judge.subjects(file) for file in self._request.files]
        self.subjects = [pair for file in found for pair in file.meant]
        _check_pixel(self._request, self.subjects)
        stop = Stop()
        with self._stopping.by(stop.ask):
            self.rows = conform(
                [pair for file in found for pair in file.drawn], self._routes, runner, toolchain,
                seed=self._request.seed, meant=dict(self.subjects), stop=stop,
                done=partial(_tell_share, progress), told=self._above(progress),
            )  # fmt: skip

    def _above(self, progress: Progress) -> Told | None:
        """Tells rows so that they stand above the bar of progress."""
        told = self._told
        return None if told is None else lambda row: progress.aside(partial(told, row))


def _tell_share(progress: Progress, done: int, total: int) -> None:
    progress.tell(done / total)


@contextmanager
def _threads(count: int) -> Iterator[ThreadPoolExecutor]:
    """Threads that wait for processes, and end with these: nobody waits for the threads."""
    threads = ThreadPoolExecutor(count)
    try:
        yield threads
    finally:
        threads.shutdown(wait=False, cancel_futures=True)


def _check_pixel(request: ConformRequest, subjects: Subjects) -> None:
    """Raise ``BadParameter`` for a pixel that no picture has, before long drawing.

    Pictures of frames may be larger: their size is known when they are drawn.
    """
    from ..targets.conformance.explaining import check_pixel
    from ..targets.conformance.seen import PixelError
    from ..targets.runner.frames.subjects import is_shader

    if request.explain is not None and all(is_shader(subject) for _, subject in subjects):
        try:
            check_pixel(request.explain)
        except PixelError as error:
            raise click.BadParameter(str(error), param_hint="--explain") from error


def _check_named_device(runner: Runner, routes: Sequence[Route]) -> None:
    """Raise ``DriverError`` if there is no such device, instead of once for each material."""
    for route in routes:
        if runner.problem(route) is None:
            runner.device(route)

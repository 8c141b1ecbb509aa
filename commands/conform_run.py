"""Compiles and draws all that ``burnish conform`` compares, in several processes if that pays."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import click

from ..targets.conformance.conform import conform
from ..targets.conformance.costs import START
from ..targets.conformance.gathering import Gathering, NextRow, Work
from ..targets.conformance.scheduling import begun, saved
from ..targets.runner.routes import ALL
from ..targets.runner.runner import Runner
from ..targets.toolchain import Toolchain
from .compared import ConformRequest, Subjects, show_said
from .console import remark
from .judge import Contents, Forms, Judge, Unit, contents_of
from .judges import Judges
from .progress import Progress
from .stopping import Stopping

if TYPE_CHECKING:
    from ..targets.conformance.rows import Row
    from ..targets.runner.routes import Route
    from .farming.farm import Farm

SEVERAL = 4
"""The number of files, or of subjects, from which on processes pay, however short they are. Fewer
subjects have to be long, as processes take a while to start."""


class Run:
    """The comparison of all subjects with the reference, as far as it has come."""

    def __init__(
        self,
        request: ConformRequest,
        routes: Sequence[Route],
        stopping: Stopping,
        next_row: NextRow | None = None,
    ) -> None:
        """``next_row`` gets each row as soon as it and all rows before it are known."""
        self._request, self._routes, self._stopping = request, routes, stopping
        self._progress = Progress("comparing")
        self._gathering = Gathering(
            lambda done, total: self._progress.tell(done / total),
            next_row and (lambda row: self._progress.aside(partial(next_row, row))),
        )
        self._with_reasons: list[Row] | None = None
        self.subjects: Subjects = []
        """The subjects as they are meant, if this process judges them."""
        self.total: int | None = None
        """The number of rows, once it is known."""

    @property
    def rows(self) -> list[Row]:
        """The rows that are known, whatever has become of the run.

        Those of a material follow each other.
        """
        return self._gathering.rows if self._with_reasons is None else self._with_reasons

    def draw(self) -> None:
        """Compile and draw everything, or as much as there is time for until a signal comes."""
        request, routes = self._request, self._routes
        if request.scheduler is not None:
            self._draw_on_farm(request.scheduler)
            return
        size = os.cpu_count() or 1
        with (
            Runner(routes, device=request.device) as runner,
            Toolchain(states=runner.states) as toolchain,
            self._progress,
        ):
            if request.device:
                _check_named_device(runner, routes)
            judge = Judge(request, routes, runner, toolchain)
            with (
                self._stopping.later(),
                Judges(request, size, judge, runner) as judges,
                self._stopping.at_once(),
            ):
                if request.explain is None and len(request.files) >= SEVERAL:
                    self._judge(units_of(judges.contents(request.files)), judges, size)
                    return
                forms = [judge.forms(file) for file in request.files]
                units = units_of(map(contents_of, request.files, forms))
                if request.explain is None and (len(units) >= SEVERAL or pays(units, size)):
                    self._judge(units, judges, size)
                else:
                    self._judge_here(forms, runner, toolchain)

    def _draw_on_farm(self, address: str) -> None:
        """Have the workers of a farm compile and draw everything."""
        from .farming.farm import Farm
        from .farming.sending import for_farm

        request = for_farm(self._request)
        named = request.routes != ALL
        with (
            self._progress,
            self._stopping.later(),
            Farm(address, request, self._routes, self._told_of_worker, named=named) as farm,
            self._stopping.at_once(),
        ):
            self._judge(units_of(farm.contents(request.files)), farm, farm.size)

    def _told_of_worker(self, sentence: str) -> None:
        self._progress.aside(partial(remark, "warning", sentence))

    def _judge(self, units: Sequence[Unit], judges: Judges | Farm, size: int) -> None:
        """Have ``size`` processes judge subjects: each a whole one, or parts of a frame as a
        helper."""
        self.total = len(units) * len(self._routes)
        works: dict[int, Work] = {}
        for number in begun([unit.cost for unit in units], size):
            works[number] = judges.begin(units[number])
        with self._stopping.by(self._gathering.end):
            self._gathering.wait_for([works[number] for number in sorted(works)], self.total)

    def _judge_here(self, forms: Sequence[Forms], runner: Runner, toolchain: Toolchain) -> None:
        """Judge the few subjects that there are in threads of this process."""
        self.subjects = [pair for file in forms for pair in file.meant]
        self.total = len(self.subjects) * len(self._routes)
        _check_pixel(self._request, self.subjects)
        with self._stopping.by(self._gathering.end):
            rows = conform(
                [pair for file in forms for pair in file.drawn], self._routes, runner, toolchain,
                seed=self._request.seed, meant=dict(self.subjects), gathering=self._gathering,
                versions={k: each for file in forms for k, each in file.versions.items()},
            )  # fmt: skip
        explains = self._request.explain is None and not self._request.values
        if explains and len(rows) == self.total:
            self._with_reasons = _with_reasons(self.subjects, rows, self._request.seed)


def units_of(contents: Iterable[Contents]) -> Sequence[Unit]:
    """All subjects of all files. Raises ``CompileError`` with the errors in all of them."""
    found = list(contents)
    show_said([each.said for each in found])
    return [unit for each in found for unit in each.units]


def pays(units: Sequence[Unit], processes: int) -> bool:
    """True if processes are worth while for a few subjects."""
    costs = [(unit.cost, unit.shared) for unit in units]
    return saved(costs, processes) > START


def _with_reasons(subjects: Subjects, rows: Sequence[Row], seed: int) -> list[Row]:
    """The rows, with reasons in the source if they differ or prove little."""
    from ..targets.conformance.explaining import with_reasons
    from ..targets.conformance.summary import by_material

    materials = dict(subjects)
    groups = by_material(rows).items()
    return [row for label, own in groups for row in with_reasons(materials[label], own, seed)]


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

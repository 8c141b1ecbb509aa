"""``burnish conform --golden``: writes a folder by which others judge their own pictures."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..targets.conformance.compare import FEW, PROVEN_SHARE
from ..targets.conformance.golden.document import NAME, GoldenCase
from ..targets.conformance.golden.names import folder_names
from ..targets.conformance.golden.writing import GoldenPart, subject_names, whole
from ..targets.conformance.scheduling import begun
from ..targets.runner.runner import Runner
from ..targets.toolchain import Toolchain
from .compared import ConformRequest
from .conform_run import SEVERAL, pays, units_of
from .console import remark, say
from .judge import GoldenOf, Judge, Unit, contents_of
from .judges import Judges
from .output import write_tree
from .progress import Progress
from .stopping import Stopping
from .terminal import FAILED

if TYPE_CHECKING:
    from ..targets.runner.routes import Route


def write_golden(
    request: ConformRequest, routes: Sequence[Route], folder: Path, stopping: Stopping
) -> None:
    """Write the bounds and inputs of all subjects of a request, or nothing at all.

    Ends the command with 1 if a subject has none. Raises ``CompileError``, also if the folder
    cannot be written.
    """
    named = request._replace(routes=",".join(route.name for route in routes))
    with Progress("bounding") as progress:
        found = _parts(named, routes, stopping, progress)
    problems = [part for part in found if isinstance(part, str)]
    for problem in problems:
        remark("error", problem)
    if problems:
        click.get_current_context().exit(FAILED)
    parts = [part for part in found if isinstance(part, GoldenPart)]
    write_tree(folder, whole(parts, routes, request.seed))
    _tell([case for part in parts for case in part.cases])
    say(f"golden: {folder / NAME}")


def _parts(
    request: ConformRequest, routes: Sequence[Route], stopping: Stopping, progress: Progress
) -> list[GoldenPart | str]:
    """The parts of all subjects: each by a process of its own, if that pays, or by this one."""
    size = os.cpu_count() or 1
    # Nothing is drawn, so no tool is looked for.
    with Runner(routes, states={}) as runner, Toolchain(states={}) as toolchain:
        judge = Judge(request, routes, runner, toolchain)
        with (
            stopping.later(),
            Judges(request, size, judge, runner) as judges,
            stopping.at_once(),
        ):
            if len(request.files) >= SEVERAL:
                units = units_of(judges.contents(request.files))
            else:
                forms = [judge.forms(file) for file in request.files]
                units = units_of(map(contents_of, request.files, forms))
            if len(units) >= SEVERAL or pays(units, size):
                return _by_processes(units, judges, progress, size)
            return list(_here(units, judge, progress))


def _by_processes(
    units: Sequence[Unit], judges: Judges, progress: Progress, size: int
) -> list[GoldenPart | str]:
    """The parts of many subjects; those that take longest are begun first."""
    abouts = _named(units)
    order = list(begun([unit.cost for unit in units], size))
    works = {number: judges.begin_golden(abouts[number]) for number in order}
    for done, number in enumerate(order, 1):
        works[number].result()
        progress.tell(done / len(units))
    return [works[number].result() for number in range(len(units))]


def _here(units: Sequence[Unit], judge: Judge, progress: Progress) -> Iterator[GoldenPart | str]:
    """The parts of a few subjects, one after the other."""
    for number, about in enumerate(_named(units)):

        def told(share: float, done: int = number) -> None:
            progress.tell((done + share) / len(units))

        yield judge.golden(about, told)


def _named(units: Sequence[Unit]) -> list[GoldenOf]:
    """The subjects with their names, of which no two are the same."""
    names = subject_names([(unit.name, unit.variant) for unit in units])
    return list(map(GoldenOf, units, folder_names(names)))


def _tell(cases: Sequence[GoldenCase]) -> None:
    """Print a line for each case, and warn of those that prove little."""
    for case in cases:
        outputs = ", ".join(row.name for row in case.outputs)
        size = f"{case.width} x {case.height}"
        say(f"{case.folder}: {outputs}, {size} pixels, {case.undecided} undecided")
    for case in cases:
        if case.undecided == case.width * case.height:
            remark("warning", f"{case.folder}: nothing is compared, as all pixels are undecided")
        elif case.undecided + case.wide > max(FEW, (1 - PROVEN_SHARE) * case.covered):
            remark("warning", (
                f"{case.folder}: proves little: of {case.covered} pixels of the object, "
                f"{case.wide} may have nearly any value, and {case.undecided} are undecided"
            ))  # fmt: skip

"""Draws materials by every route and holds each picture against the reference's."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ...compiler.reference.picture import Expected, RasterRules
from ...frozen import changed
from ..runner.codes import CodeError, compile_one
from ..runner.draw import Device, DriverError, Job, Picture
from ..runner.pipeline import pipeline
from ..runner.reference import remembered
from ..runner.routes import Route
from ..runner.runner import Runner
from ..runner.subject import Subject
from ..toolchain import Toolchain
from .cases import Series, series_of
from .compare import Comparison, compare
from .formats import as_stored, format_steps
from .tolerances import DRIVERS, DriverRow

Floats = NDArray[np.float64]

Status = Literal["agrees", "differs", "failed", "not run"]
STATUSES: tuple[Status, ...] = ("agrees", "differs", "failed", "not run")
"""``failed``: a compiler or driver on the route refused. ``not run``: the route lacks its tools."""

Done = Callable[[int, int], None]
"""Is told how many rows are done, and of how many."""


@dataclass(frozen=True, eq=False, slots=True)
class Result:
    """One case by one route."""

    case: str
    comparison: Comparison
    got: tuple[Floats, ...]
    """Targets, (height, width, 4)."""
    expected: Expected


@dataclass(frozen=True, eq=False, slots=True)
class Row:
    """One material by one route."""

    material: str
    route: Route
    status: Status
    problem: str = ""
    """Why it failed or was not run."""
    device: Device | None = None
    versions: Mapping[str, str] = field(default_factory=dict)
    """Of the tools on the route."""
    results: tuple[Result, ...] = ()

    @property
    def max_difference(self) -> float:
        """The largest distance of a decided pixel from the reference, over all cases."""
        return max((result.comparison.max_difference for result in self.results), default=0.0)

    @property
    def undecided(self) -> int:
        """Pixels that were not compared."""
        return sum(result.comparison.undecided for result in self.results)

    @property
    def covered(self) -> int:
        """Pixels that the reference covers."""
        return sum(result.comparison.covered for result in self.results)


def conform(
    subjects: Sequence[tuple[str, Subject]],
    routes: Sequence[Route],
    runner: Runner,
    toolchain: Toolchain,
    *,
    seed: int = 0,
    done: Done | None = None,
) -> list[Row]:
    """A row for each material (with the name it goes by) and route, in this order."""
    plans = [
        (label, subject, list(series_of(subject.reflection, seed))) for label, subject in subjects
    ]
    rows: dict[tuple[int, int], Row] = {}
    with ThreadPoolExecutor(os.cpu_count() or 1) as threads:
        pending = {
            threads.submit(_row, label, subject, series, route, runner, toolchain): (i, j)
            for i, (label, subject, series) in enumerate(plans)
            for j, route in enumerate(routes)
        }
        try:
            for number, future in enumerate(as_completed(pending), 1):
                rows[pending[future]] = future.result()
                if done is not None:
                    done(number, len(pending))
        except BaseException:
            threads.shutdown(cancel_futures=True)
            raise
    return [rows[place] for place in sorted(rows)]


def _row(
    label: str,
    subject: Subject,
    series: Sequence[Series],
    route: Route,
    runner: Runner,
    toolchain: Toolchain,
) -> Row:
    problem = runner.problem(route)
    if problem is not None:
        return Row(label, route, "not run", problem)
    made = partial(Row, label, route, versions=runner.versions(route))
    try:
        device = runner.device(route)
        codes = compile_one(route, subject.files, toolchain)
        results: list[Result] = []
        for each in series:
            shader_pipeline = pipeline(subject.reflection, route, codes, exact=each.exact)
            job = Job(shader_pipeline, tuple(case.shot.draw() for case in each.cases))
            pictures = runner.draw(route, job)
            results += _compared(subject, each, route, device, pictures)
    except (CodeError, DriverError) as error:
        return made(status="failed", problem=str(error))
    agrees = all(result.comparison.agrees for result in results)
    return made(status="agrees" if agrees else "differs", device=device, results=tuple(results))


def _compared(
    subject: Subject, series: Series, route: Route, device: Device, pictures: Sequence[Picture]
) -> Iterator[Result]:
    driver = DRIVERS[route.driver]
    shader = subject.shader
    if series.exact:
        plain = tuple(changed(target, blend="none") for target in shader.targets)
        shader = replace(shader, targets=plain)
    formats = [row["format"] for row in subject.reflection["targets"]]
    for case, picture in zip(series.cases, pictures, strict=True):
        shot = case.shot
        rules = RasterRules(
            shot.width, shot.height, device.subpixel_bits,
            interpolates_snapped=driver.interpolates_snapped,
            clips_sides=driver.clips_sides,
            subtexel_bits=device.subtexel_bits or driver.subtexel_bits,
            mip_bits=device.mip_bits or driver.mip_bits,
        )  # fmt: skip
        wanted = remembered(shader, shot, rules)
        got = tuple(
            np.frombuffer(data, "<f4").reshape(picture.height, picture.width, 4).astype(float)
            for data in picture.targets
        )
        if series.exact:
            yield _result(case.name, got, wanted, driver, [0.0] * len(got))
        else:
            stored = replace(wanted, targets=as_stored(wanted.targets, formats))
            shown = as_stored(got, formats)
            yield _result(f"{case.name}, blended", shown, stored, driver, format_steps(formats))


def _result(
    case: str,
    got: tuple[Floats, ...],
    expected: Expected,
    tolerance: DriverRow,
    steps: Sequence[float],
) -> Result:
    comparison = compare(
        got, expected.targets, expected.radius, expected.covered, expected.undecided,
        tolerance, steps,
    )  # fmt: skip
    return Result(case, comparison, got, expected)

"""Runs conformance tests: draws materials by every route, and compares with the reference.

``burnish conform`` and the tests call it.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from threading import Event

from ...support.frozen import EMPTY
from ..runner.frames.helped import Helpers
from ..runner.frames.subjects import FrameSubject, is_frame, is_shader
from ..runner.job_sizes import check_work
from ..runner.reference import STORE
from ..runner.routes import Route
from ..runner.runner import Runner
from ..runner.store import Store
from ..runner.subject import Subject
from ..toolchain import Toolchain
from .cases import SIZE, Size
from .compare import Comparison, proves_little
from .contents import content_of
from .frames import FrameTrial
from .gathering import Gathering
from .refusals import REFUSALS
from .rows import LACKS_MEMORY, CaseResult, Row, Status
from .trials import ShaderTrial, Trial, Version

Tried = Trial | tuple[str, str]
"""The trial of a subject; or its label, and the reason why nothing can draw it."""


def conform(
    subjects: Sequence[tuple[str, Subject | FrameSubject]],
    routes: Sequence[Route],
    runner: Runner,
    toolchain: Toolchain,
    *,
    seed: int = 0,
    gathering: Gathering | None = None,
    size: Size = SIZE,
    keep: bool = True,
    brief: bool = False,
    meant: Mapping[str, Subject | FrameSubject] = EMPTY,
    versions: Mapping[str, Version] = EMPTY,
) -> list[Row]:
    """A row for each labelled material, kernel or frame and each route, in this order.

    Arguments are those of ``trials_of`` and of ``rows_of``.
    """
    trials = trials_of(subjects, seed=seed, size=size, keep=keep, meant=meant, versions=versions)
    return rows_of(trials, routes, runner, toolchain, gathering=gathering, brief=brief)


def trials_of(
    subjects: Sequence[tuple[str, Subject | FrameSubject]],
    *,
    seed: int = 0,
    size: Size = SIZE,
    keep: bool = True,
    meant: Mapping[str, Subject | FrameSubject] = EMPTY,
    versions: Mapping[str, Version] = EMPTY,
    helpers: Helpers | None = None,
) -> list[Tried]:
    """The trial of each labelled material, kernel or frame.

    ``meant`` has, by the label, the form of a material that the reference draws, where this is not
    the one that routes draw, and ``versions`` what it is a version of. Without ``keep``, what the
    reference draws is not kept: random programs are drawn only once. ``helpers`` may draw parts of
    frames.
    """
    store = Store(STORE) if keep else None
    return [
        _trial(label, subject, seed, store, size, meant.get(label), versions.get(label), helpers)
        for label, subject in subjects
    ]


def rows_of(
    trials: Sequence[Tried],
    routes: Sequence[Route],
    runner: Runner,
    toolchain: Toolchain,
    *,
    gathering: Gathering | None = None,
    brief: bool = False,
    threads: int | None = None,
) -> list[Row]:
    """A row for each trial and each route, in this order; fewer if the ``gathering`` is ended.

    Trials keep the reference's pictures for further routes. Rows that are ``brief`` end with the
    first picture that differs. ``threads`` work at once, by default more than there are processors.
    """
    gathering = gathering or Gathering()
    interrupted = Event()

    def judged(trial: Tried, route: Route) -> Sequence[Row]:
        return (_row(trial, route, runner, toolchain, interrupted, brief=brief),)

    # Threads mostly wait for the processes of compilers and drivers, or for the pictures of the
    # reference, which the routes of a trial share: the first of them draws.
    pool = ThreadPoolExecutor(threads or 2 * (os.cpu_count() or 1))
    try:
        works = [pool.submit(judged, trial, route) for trial in trials for route in routes]
        gathering.wait_for(works, len(works))
    finally:
        # After Ctrl-C, threads end with the processes for which they wait, which whoever has opened
        # the runner and the toolchain closes; those that compute, when they see that it has come.
        interrupted.set()
        pool.shutdown(wait=False, cancel_futures=True)
    return gathering.rows


def _trial(
    label: str,
    subject: Subject | FrameSubject,
    seed: int,
    store: Store | None,
    size: Size,
    meant: Subject | FrameSubject | None,
    version: Version | None,
    helpers: Helpers | None,
) -> Tried:
    if is_frame(subject):
        return FrameTrial(label, subject, size, store, helpers)
    assert is_shader(subject)
    assert meant is None or is_shader(meant)
    content = content_of(subject.reflection, store or Store(STORE, limit=0))
    try:
        return ShaderTrial(label, subject, content, seed, size, meant, version)
    except ValueError as error:
        return label, str(error)


def _row(
    trial: Tried,
    route: Route,
    runner: Runner,
    toolchain: Toolchain,
    interrupted: Event,
    *,
    brief: bool,
) -> Row:
    """The row of a material and a route; it ends early, and is of no use, once ``interrupted``."""
    if isinstance(trial, tuple):
        label, reason = trial
        return Row(label, route, "failed", reason)
    problem = runner.problem(route) or trial.lacking(route)
    if problem is not None:
        return Row(trial.label, route, "not run", problem)
    made = partial(Row, trial.label, route, versions=runner.versions(route))
    try:
        device = runner.device(route)
        for shader in trial.shaders:
            check_work(shader.shader)
        results: list[CaseResult] = []
        for result in trial.results(route, device, runner, toolchain):
            results.append(result)
            if interrupted.is_set() or (brief and _differs(result.comparison)):
                break
    except REFUSALS as error:
        return made(status="failed", problem=str(error))
    except MemoryError:
        return made(status="failed", problem=LACKS_MEMORY)
    return made(status=_status(results), device=device, results=tuple(results))


def _status(results: Sequence[CaseResult]) -> Status:
    comparisons = [result.comparison for result in results]
    if any(map(_differs, comparisons)):
        return "differs"
    if any(comparison.overflowing for comparison in comparisons):
        return "overflows"
    return "proves little" if proves_little(comparisons) else "agrees"


def _differs(comparison: Comparison) -> bool:
    return bool(comparison.wrong or comparison.changed)

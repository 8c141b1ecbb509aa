"""Draws correct pictures and pictures with planted errors, and asks every rule about each.

A *test* is a material on a route, with all pictures of its cases, as a test of an image
suite would have them. What ``conform`` draws without a change is correct: it comes from a text that
nobody changed, by a driver whose authors test that it conforms. So a rule that refuses it gives a
false alarm, bounds included. A test with a planted error is found by a rule that refuses one of its
pictures.
"""

from __future__ import annotations

import copy
import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from operator import or_

import numpy as np
from numpy.typing import NDArray

from burnish.api.entry_points import CompiledMaterial
from burnish.targets.conformance.conform import rows_of, trials_of
from burnish.targets.conformance.rows import CaseResult, Row
from burnish.targets.conformance.trials import Trial
from burnish.targets.runner.drivers.frame_job import Found, FrameJob
from burnish.targets.runner.routes import ROUTES, Route
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain

from ..mutants.texts import Changed, changes_of, chosen
from ..suite.processes import at_once
from .errors import HOST_ERRORS, TEXT_ERRORS, Change, HostError
from .hulls import Hull, hulls_of
from .larger import larger_tests
from .rules import RULES, Shown
from .verdicts import CLEAR, KEPT_ROUTE, Measured, Pictures, measured

Floats = NDArray[np.float64]

GUARANTEED = "bounds: what any device may draw by this route"
MEASURED = "bounds: what this driver was found to draw"
TOGETHER = "bounds: what any device may draw by any of the routes"
BOUNDS = (GUARANTEED, MEASURED, TOGETHER)
"""The names of bounds, which stand in tables as rules do."""
NAMES = (*BOUNDS, *(rule.name for rule in RULES))

AT_ONCE = 4
"""The number of tests that are drawn at once."""


class MisledRunner(Runner):
    """A runner that tells drivers something else than it is told."""

    change: Change | None = None

    def draw_frame(self, route: Route, job: FrameJob, *, keep: bool = True) -> Found:
        """Do the changed job."""
        told = job if self.change is None else self.change(job)
        return super().draw_frame(route, told, keep=keep)

    def misled(self, change: Change) -> MisledRunner:
        """The same runner, with the same workers, and an error."""
        found = copy.copy(self)
        found.change = change
        return found


@dataclass(frozen=True, slots=True)
class Correct:
    """A test without an error."""

    subject: str
    route: str
    status: str
    pictures: int
    beyond: Mapping[str, int]
    """The number of cases that leave each of ``BOUNDS``."""
    beside_reference: Measured
    beside_kept: Measured | None
    """Likewise, beside pictures of ``KEPT_ROUTE``; nothing for this route itself."""


@dataclass(frozen=True, slots=True)
class Planted:
    """A test with an error that changes a picture."""

    subject: str
    route: str
    kind: str
    what: str
    found: tuple[str, ...]
    """The rules and bounds that refuse one of its pictures."""
    worst: Mapping[str, float]
    """The largest value of each of ``MEASURES``, beside the reference."""
    apart: float
    """The largest change of a lane by the error, in codes of 8 bits, where pixels are decided."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """All that was found of some subjects."""

    correct: tuple[Correct, ...]
    planted: tuple[Planted, ...]
    refused: int
    """The number of planted errors that a compiler or a driver refused."""
    unseen: int
    """The number of planted errors that change no picture."""
    larger: tuple[Measured, ...]
    """Tests without an error in larger pictures, beside those of ``KEPT_ROUTE``."""
    failed: tuple[str, ...] = ()
    """Tests without an error that were not drawn, with the reason."""


def outcome_of(
    label: str,
    material: CompiledMaterial,
    routes: Sequence[Route],
    runner: MisledRunner,
    toolchain: Toolchain,
    *,
    count: int,
    hosts: Sequence[HostError] = HOST_ERRORS,
) -> Outcome:
    """Draw a material by some routes, without errors and with them: ``count`` in texts, and one of
    each of ``hosts`` in what drivers are told. Each error is planted in one route.
    """
    (trial,) = trials_of([(label, material)])
    assert isinstance(trial, Trial), trial
    rows = rows_of([trial], routes, runner, toolchain)
    drawn = {row.route.name: row for row in rows if row.results}
    failed = tuple(f"{label}, {row.route.name}: {row.problem}" for row in rows if row.problem)
    hulls = hulls_of(trial, [row.route for row in drawn.values()], runner, toolchain)
    correct = tuple(_correct(row, drawn.get(KEPT_ROUTE), hulls) for row in drawn.values())
    errors = _errors(trial, material, [*drawn], count, hosts)
    calls = [partial(_with_error, each, runner, toolchain) for each in errors]
    pairs = [*zip(errors, _few_at_once(calls), strict=True)]
    found = [_planted(error, row, drawn[error.route], hulls) for error, row in pairs if row.results]
    seen = tuple(each for each in found if each is not None)
    larger = tuple(larger_tests(material, routes, runner, toolchain))
    return Outcome(correct, seen, len(pairs) - len(found), len(found) - len(seen), larger, failed)


# --- errors --------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Error:
    """A planted error, and how it is drawn."""

    route: str
    kind: str
    what: str
    trial: Trial
    change: Change | None = None


def _errors(
    trial: Trial,
    material: CompiledMaterial,
    routes: Sequence[str],
    count: int,
    hosts: Sequence[HostError],
) -> list[_Error]:
    """The errors to plant in a material: the same in each run."""
    chance = random.Random(trial.label)
    found = [each for name in routes for each in changes_of(material, name, TEXT_ERRORS)]
    picked = chosen(found, count, chance)
    told = [
        _Error(chance.choice(routes), each.name, each.name, trial, each.change) for each in hosts
    ]
    return [*map(partial(_in_text, trial), picked), *told]


def _in_text(trial: Trial, each: Changed) -> _Error:
    """The trial with other texts: what the reference has drawn stays."""
    other = copy.copy(trial)
    other.shaders = [each.subject()]
    file = each.material.files[each.file]
    what = f"{file.name}:{each.change.told(file.text)}"
    return _Error(each.route, each.change.kind, what, other)


def _few_at_once(calls: Sequence[Callable[[], Row]]) -> Iterator[Row]:
    """The results of all calls, which mostly wait for compilers and drivers."""
    for start in range(0, len(calls), AT_ONCE):
        yield from at_once(calls[start : start + AT_ONCE])


def _with_error(error: _Error, runner: MisledRunner, toolchain: Toolchain) -> Row:
    told = runner if error.change is None else runner.misled(error.change)
    (row,) = rows_of([error.trial], [ROUTES[error.route]], told, toolchain, threads=1)
    return row


# --- verdicts ------------------------------------------------------------------------------------


def _correct(row: Row, kept: Row | None, hulls: Mapping[str, Hull]) -> Correct:
    drawn = _pictures(row, _got)
    beside = None if kept is None or kept is row else measured(drawn, _pictures(kept, _got))
    return Correct(
        row.material, row.route.name, row.status, sum(map(len, drawn.values())),
        _beyond_bounds(row, hulls), measured(drawn, _pictures(row, _expected)), beside,
    )  # fmt: skip


def _planted(error: _Error, row: Row, unchanged: Row, hulls: Mapping[str, Hull]) -> Planted | None:
    """The verdicts about a test with an error; ``None`` if it changes nothing."""
    pairs = [*zip(row.results, unchanged.results, strict=True)]
    if all(np.array_equal(one.got, other.got, equal_nan=True) for one, other in pairs):
        return None
    found = measured(_pictures(row, _got), _pictures(unchanged, _expected))
    refused = {**_beyond_bounds(row, hulls), **found.refused}
    return Planted(
        row.material, error.route, error.kind, error.what,
        tuple(name for name in NAMES if refused[name]), found.worst,
        max(_apart(one, other) for one, other in pairs),
    )  # fmt: skip


def _beyond_bounds(row: Row, hulls: Mapping[str, Hull]) -> dict[str, int]:
    """The number of cases that leave each of the bounds."""
    said = [result.comparison for result in row.results]
    wrong = [bool(each.wrong or each.changed) for each in said]
    beyond = [each.beyond is not None for each in said]
    outside = [hulls[result.case].leaves(result.got) for result in row.results]
    return {
        GUARANTEED: sum(wrong), MEASURED: sum(map(or_, wrong, beyond)), TOGETHER: sum(outside)
    }  # fmt: skip


def _apart(one: CaseResult, other: CaseResult) -> float:
    """The largest change of a code where pixels are decided."""
    decided = ~other.expected.undecided
    shown = [(Shown(a, CLEAR), Shown(b, CLEAR)) for a, b in zip(one.got, other.got, strict=True)]
    return max(float(np.abs(a.codes - b.codes)[decided].max(initial=0.0)) for a, b in shown)


def _pictures(row: Row, targets: Callable[[CaseResult], Sequence[Floats]]) -> Pictures:
    return {
        result.case: [Shown(target, CLEAR) for target in targets(result)] for result in row.results
    }


def _got(result: CaseResult) -> Sequence[Floats]:
    return result.got


def _expected(result: CaseResult) -> Sequence[Floats]:
    return result.expected.targets

"""Judges the results of kernels: every lane has to lie within the reference's bounds.

A run of a kernel is compared as a picture of one row: each element is a pixel, and each written
part of it is a target.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ...compiler.ir.shader import Shader, Store
from ...compiler.ir.storage import LANE, byte_size, stored_element
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.kernel import Lane, computed
from ...compiler.reference.picture import Expected, RasterRules, formats
from ..runner.binding import pipeline
from ..runner.codes import Codes
from ..runner.drivers.device import Device
from ..runner.drivers.kernel_job import Dispatch, Written
from ..runner.instances.instance import Instance
from ..runner.kernels import dispatch_of, elements_of, job_of
from ..runner.reference import Program, texels_of, values_for
from ..runner.reference_kernels import place_of
from ..runner.routes import Route
from ..runner.runner import Runner
from ..runner.subject import Subject
from .compare import compare
from .once import Known
from .plan import FLOATS, bounds_of, precise, summed_up
from .rows import CaseResult
from .sample import sample_buffers, sample_textures, sample_values

Floats = NDArray[np.float64]

MANY = (64, 70, 200)
ANY = (0, 1, *MANY)
CASES = {"first": ANY, "second": MANY, "third": ANY}
"""The numbers of elements that storage buffers may get: a whole work group, and parts of one; none
or one, but not in all cases."""


@dataclass(frozen=True, slots=True)
class Run:
    """One dispatch, and the values with which it was made."""

    name: str
    instance: Instance
    dispatch: Dispatch

    @property
    def width(self) -> int:
        """The elements of the longest buffer, as a picture's pixels."""
        return max(1, *self.instance.result_counts().values())

    @property
    def count(self) -> int:
        """The number of elements that are computed."""
        return self.dispatch.extent[0]

    @property
    def height(self) -> int:
        """One: an element is a pixel of a single row."""
        return 1


class KernelPlan:
    """The runs of one kernel, which all routes share."""

    def __init__(self, label: str, subject: Subject, seed: int) -> None:
        self.label = label
        self.subject = subject
        self._runs = [_run(name, subject, seed + turn) for turn, name in enumerate(CASES)]
        self._source = Program.of(subject.shader)
        self._programs: Known[Program] = Known()
        self._lanes: Known[Sequence[Lane]] = Known()

    def results(
        self, route: Route, device: Device, codes: Codes, runner: Runner
    ) -> Iterator[CaseResult]:
        """A result for each run by a route. Raises ``DriverError``."""
        bound = pipeline(self.subject.reflection, route, codes)
        dispatches = [run.dispatch for run in self._runs]
        job = job_of(self.subject.reflection, bound, dispatches)
        program = self._programs.value(
            route.profile, lambda: Program.of(self.subject.emitted(route.profile))
        )
        for run, written in zip(self._runs, runner.compute(route, job), strict=True):
            yield self._judged(run, written, program, route, device)

    def _judged(
        self, run: Run, written: Written, program: Program, route: Route, device: Device
    ) -> CaseResult:
        found = []
        data = elements_of(run.instance, written)
        for bounds in bounds_of(run, route, device):
            low_high = self._computed(program, run, bounds.rules, bounds.errors)
            # The text no longer has the promises, nor the marks of `unguarded` operations.
            meant = self._computed(self._source, run, precise(bounds.rules), None)
            got = _got(low_high, data, run.width)
            expected = _expected(low_high, run.width)
            expected = replace(expected, undecided=_undecided(meant, run.width))
            targets = [_target([lane.value for lane in part], run.width) for part in _parts(meant)]
            steps = [formats.step(FLOATS, values) for values in targets]
            comparison = compare(got, expected, targets, steps, bounds.level, None)
            if comparison.changed:
                # In float64, too, numbers that cancel may tip a decision.
                tipped = self._computed(self._source, run, bounds.rules, bounds.errors)
                possible = _expected(tipped, run.width)
                comparison = compare(got, expected, targets, steps, bounds.level, possible)
            found.append((comparison, expected))
            if not comparison.wrong:
                break
        summary = summed_up([comparison for comparison, _ in found])
        return CaseResult(run.name, summary, tuple(got), found[-1][1])

    def _computed(
        self, program: Program, run: Run, rules: RasterRules, errors: Errors | None
    ) -> Sequence[Lane]:
        """The reference's values, computed once for all routes whose texts are the same graph."""
        # No kernel compares neighbouring pixels, so it does not matter which rows make a quad.
        rules = replace(rules, bottom_up=False)
        key = program.text, run.name, rules, errors
        return self._lanes.value(key, lambda: _lanes(program.shader, run, rules, errors))


def _run(name: str, subject: Subject, seed: int) -> Run:
    instance = Instance(subject.reflection)
    sample_values(instance, seed)
    sample_textures(instance, seed)
    sample_buffers(instance, seed, CASES[name])
    return Run(name, instance, dispatch_of(instance))


def _lanes(shader: Shader, run: Run, rules: RasterRules, errors: Errors | None) -> Sequence[Lane]:
    values, texels = values_for(shader, run.instance), texels_of(run.instance)
    return computed(shader, values, texels, run.count, run.instance.result_counts(), errors, rules)


def _parts(lanes: Sequence[Lane]) -> list[list[Lane]]:
    """The lanes of each part that is written."""
    found: dict[Store, list[Lane]] = {}
    for lane in lanes:
        found.setdefault(lane.store, []).append(lane)
    return list(found.values())


def _target(lanes: Sequence[NDArray[np.generic]], width: int) -> Floats:
    """Lanes of all elements as a picture of one row; missing elements are zero."""
    whole = np.zeros((1, width, 4))
    for number, lane in enumerate(lanes):
        whole[0, : len(lane), number] = lane
    return whole


def _expected(lanes: Sequence[Lane], width: int) -> Expected:
    parts = _parts(lanes)
    values, lows, highs = (
        tuple(_target([getattr(lane, end) for lane in part], width) for part in parts)
        for end in ("value", "low", "high")
    )
    everywhere = np.ones((1, width), np.bool_)
    return Expected(values, everywhere, ~everywhere, lows, highs, everywhere.astype(np.int64))


def _undecided(lanes: Sequence[Lane], width: int) -> NDArray[np.bool_]:
    """The elements for which no written value is defined."""
    found = np.zeros((1, width), np.bool_)
    for lane in lanes:
        found[0, : len(lane.undecided)] |= lane.undecided
    return found


def _got(lanes: Sequence[Lane], data: Mapping[str, bytes], width: int) -> list[Floats]:
    """The values that a driver has written to each part of an element."""
    found = []
    for part in _parts(lanes):
        store = part[0].store
        size = byte_size(stored_element(store.buffer.type.element))
        words = np.frombuffer(data[store.buffer.name], np.uint8).reshape(-1, size * store.stride)
        columns = [
            np.ascontiguousarray(words[:, start : start + LANE]).view(kind)[:, 0]
            for start, kind in map(place_of, part)
        ]
        found.append(_target(columns, width))
    return found

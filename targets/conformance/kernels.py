"""Judges what kernels write: every lane has to lie within the reference's bounds.

A run of a kernel is compared as a picture of one row is: each element is a pixel, and what is
written to each part of it is a target.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...compiler.ir.shader import Shader, Store
from ...compiler.ir.storage import byte_size, place_in, stored_element
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.kernel import Lane, computed
from ...compiler.reference.picture import Expected, RasterRules, formats
from ..runner.binding import pipeline
from ..runner.codes import Codes
from ..runner.drivers.draw import Device, Dispatch, KernelJob, Written
from ..runner.instances.instance import Instance
from ..runner.kernels import dispatch_of
from ..runner.reference import texels_of, values_for
from ..runner.routes import Route
from ..runner.runner import Runner
from ..runner.subject import Subject
from .compare import compare
from .plan import bounds_of, summed_up
from .rows import CaseResult
from .sample import sample_buffers, sample_textures, sample_values

Floats = NDArray[np.float64]

FLOATS = "rgba32f"
"""The format that holds every value that is compared."""

BUFFER_SIZES = (0, 1, 64, 70, 200)
"""How many elements storage buffers get: none, one, a whole work group, and parts of one."""

CASES = ("first", "second", "third")


@dataclass(frozen=True, slots=True)
class Run:
    """One dispatch, and the values that it is made of."""

    name: str
    instance: Instance
    dispatch: Dispatch

    @property
    def width(self) -> int:
        """The elements, as a picture's pixels."""
        return max(self.dispatch.count, 1)

    @property
    def height(self) -> int:
        """There is one row."""
        return 1


class KernelPlan:
    """The runs of one kernel, which all routes share."""

    def __init__(self, label: str, subject: Subject, seed: int) -> None:
        self.label = label
        self.subject = subject
        self._runs = [_run(name, subject, seed + turn) for turn, name in enumerate(CASES)]

    def results(
        self, route: Route, device: Device, codes: Codes, runner: Runner
    ) -> Iterator[CaseResult]:
        """A result for each run by a route. Raises ``DriverError``."""
        bound = pipeline(self.subject.reflection, route, codes)
        job = KernelJob(bound, tuple(run.dispatch for run in self._runs))
        program = self.subject.emitted(route.profile)
        for run, written in zip(self._runs, runner.compute(route, job), strict=True):
            yield self._judged(run, written, program, route, device)

    def _judged(
        self, run: Run, written: Written, program: Shader, route: Route, device: Device
    ) -> CaseResult:
        found = []
        for bounds in bounds_of(run, route, device):
            low_high = _lanes(program, run, bounds.rules, bounds.errors)
            meant = _lanes(self.subject.shader, run, bounds.rules, bounds.errors)
            got = _got(low_high, written, self.subject.reflection["results"])
            expected = _expected(low_high, run.width)
            targets = [_target([lane.value for lane in part]) for part in _parts(meant)]
            steps = [formats.step(FLOATS, values) for values in targets]
            comparison = compare(got, expected, targets, steps, bounds.level, None)
            found.append((comparison, expected))
            if not comparison.wrong:
                break
        summary = summed_up([comparison for comparison, _ in found])
        return CaseResult(run.name, summary, tuple(got), found[-1][1])


def _run(name: str, subject: Subject, seed: int) -> Run:
    instance = Instance(subject.reflection)
    sample_values(instance, seed)
    sample_textures(instance, seed)
    sample_buffers(instance, seed, BUFFER_SIZES)
    return Run(name, instance, dispatch_of(instance))


def _lanes(shader: Shader, run: Run, rules: RasterRules, errors: Errors) -> Sequence[Lane]:
    values, texels = values_for(shader, run.instance), texels_of(run.instance)
    return computed(shader, values, texels, run.dispatch.count, errors, rules)


def _parts(lanes: Sequence[Lane]) -> list[list[Lane]]:
    """The lanes of each part that is written."""
    found: dict[Store, list[Lane]] = {}
    for lane in lanes:
        found.setdefault(lane.store, []).append(lane)
    return list(found.values())


def _target(lanes: Sequence[NDArray[np.generic]]) -> Floats:
    """Lanes of all elements as a picture of one row; what is missing is zero."""
    whole = np.zeros((1, max(len(lanes[0]), 1), 4))
    for number, lane in enumerate(lanes):
        whole[0, : len(lane), number] = lane
    return whole


def _expected(lanes: Sequence[Lane], width: int) -> Expected:
    parts = _parts(lanes)
    values, lows, highs = (
        tuple(_target([getattr(lane, end) for lane in part]) for part in parts)
        for end in ("value", "low", "high")
    )
    everywhere = np.ones((1, width), np.bool_)
    return Expected(values, everywhere, ~everywhere, lows, highs, everywhere.astype(np.int64))


def _got(
    lanes: Sequence[Lane], written: Written, rows: Sequence[Mapping[str, object]]
) -> list[Floats]:
    """What was written to each part."""
    data = {str(row["name"]): each for row, each in zip(rows, written.buffers, strict=True)}
    found = []
    for part in _parts(lanes):
        store = part[0].store
        type_, offset = place_in(store.buffer.type.element, store.path)
        size = byte_size(stored_element(store.buffer.type.element))
        words = np.frombuffer(data[store.buffer.name], np.uint8).reshape(-1, size * store.stride)
        start = store.offset * size + offset
        kind = {"float": "<f4", "int": "<i4", "uint": "<u4"}[type_]
        columns = [
            np.ascontiguousarray(words[:, start + 4 * n : start + 4 * n + 4]).view(kind)[:, 0]
            for n in range(len(part))
        ]
        found.append(_target(columns))
    return found

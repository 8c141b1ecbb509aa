"""Judges captured vertices: each value of each vertex has to lie within the reference's bounds.

The vertices of a draw are compared as a picture of one row: each vertex is a pixel, and each value
of it is a target. Rounding may decide which vertices are captured; then those before the first and
behind the last such vertex are compared, and their number has to be possible.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...compiler.documents.reflection import Reflection
from ...compiler.ir.shader import Shader
from ...compiler.ir.stages import CAPTURED, CAPTURED_EXPANDED, COMPUTED
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.capture import Listed, captured, captured_by_kernel
from ...compiler.reference.picture import Expected, RasterRules, formats
from ..runner.binding import pipeline
from ..runner.capturing import Vertices, captured_by, give_elements
from ..runner.codes import Codes
from ..runner.drivers.device import Device
from ..runner.kernels import UndrawableError
from ..runner.reference import geometry_for, texels_of, values_for
from ..runner.routes import Route
from ..runner.runner import Runner
from ..runner.scene_state import SceneState
from ..runner.subject import Subject
from .cases import Case, Size, series_of
from .compare import Comparison, compare
from .plan import FLOATS, bounds_of, summed_up
from .rows import CaseResult

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


LISTED = (CAPTURED, CAPTURED_EXPANDED, COMPUTED)
"""The stages whose captured vertices the reference can list."""


class CapturePlan:
    """The cases of one material under a pass that captures, which all routes share."""

    def __init__(
        self, label: str, subject: Subject, seed: int, size: Size, meant: Subject | None = None
    ) -> None:
        """``meant`` is the form of the material that the reference captures instead of stages that
        divide patches. Raises ``UndrawableError`` if it is needed and missing.
        """
        form = subject if subject.shader.chain in LISTED else meant
        if form is None:
            raise UndrawableError(subject.name, "capture")
        self.label = label
        self.subject = subject
        self._form = form
        self._cases, self._meant = (
            _cases(each.reflection, seed, size, form.reflection) for each in (subject, form)
        )

    def results(
        self, route: Route, device: Device, codes: Codes, runner: Runner
    ) -> Iterator[CaseResult]:
        """A result for each case by a route. Raises ``DriverError``."""
        states = [case.state for case in self._cases]
        bound = pipeline(self.subject.reflection, route, codes)
        program = self._form.emitted(route.profile)
        found = captured_by(route, bound, states, runner)
        for case, got in zip(self._meant, found, strict=True):
            yield self._judged(case, got, program, route, device)

    def _judged(
        self, case: Case, got: Vertices, program: Shader, route: Route, device: Device
    ) -> CaseResult:
        found = []
        for bounds in bounds_of(case.state, route, device):
            allowed = _listed(program, case.state, bounds.rules, bounds.errors)
            meant = _listed(self._form.shader, case.state, bounds.rules, bounds.errors)
            compared = _Compared.of(allowed, got)
            targets = [_row(lanes, "value", compared.kept) for lanes in meant.values]
            steps = [formats.step(FLOATS, values) for values in targets]
            expected = compared.expected(allowed)
            # In float64, too, numbers that cancel may tip a decision.
            possible = compared.expected(meant)
            comparison = compare(compared.got, expected, targets, steps, bounds.level, possible)
            found.append((comparison, expected, compared.got))
            if not comparison.wrong:
                break
        comparisons: list[Comparison] = [comparison for comparison, *_ in found]
        return CaseResult(case.name, summed_up(comparisons), tuple(found[-1][2]), found[-1][1])


@dataclass(frozen=True, eq=False, slots=True)
class _Compared:
    """The vertices that are compared, with the captured values of them."""

    kept: Bools
    """The listed vertices that are compared: those whose offsets in the buffer are known."""
    got: list[Floats]
    """For each member, a picture of one row; NaN if a wrong number of vertices was captured."""

    @classmethod
    def of(cls, listed: Listed, got: Vertices) -> _Compared:
        """The part of a list that can be compared with the captured vertices."""
        tipping = np.flatnonzero(listed.possible & ~listed.certain)
        place = np.arange(len(listed.certain))
        first, last = (tipping[0], tipping[-1]) if len(tipping) else (len(place), len(place))
        before, behind = listed.certain & (place < first), listed.certain & (place > last)
        is_right = listed.certain.sum() <= got.count <= listed.possible.sum()
        head, tail = int(before.sum()), int(behind.sum())
        rows = np.r_[np.arange(head), np.arange(got.count - tail, got.count)]
        return cls(
            before | behind,
            [
                _padded(values[rows] if is_right else np.full((len(rows), values.shape[1]), np.nan))
                for values in got.members.values()
            ],
        )

    def expected(self, listed: Listed) -> Expected:
        """The bounds of the vertices that are compared."""
        values, lows, highs = (
            tuple(_row(lanes, end, self.kept) for lanes in listed.values)
            for end in ("value", "low", "high")
        )
        everywhere = np.ones(values[0].shape[:2], np.bool_)
        layers = everywhere.astype(np.int64)
        return Expected(values, everywhere, ~everywhere, lows, highs, layers)


def _cases(reflection: Reflection, seed: int, size: Size, like: Reflection) -> list[Case]:
    """The cases of one form of the material, with the meshes of the form that is ``like``."""
    every = series_of(reflection, seed, size, like)
    return [case for series in every if series.exact for case in series.cases]


def _listed(shader: Shader, state: SceneState, rules: RasterRules, errors: Errors) -> Listed:
    is_kernel = shader.chain == COMPUTED
    if is_kernel:
        give_elements(state)
    values, texels = values_for(shader, state.instance), texels_of(state.instance)
    if is_kernel:
        count = state.instance.extent()
        return captured_by_kernel(shader, values, texels, count, errors, rules)
    geometry = geometry_for(shader, state.geometry())
    return captured(shader, values, texels, geometry, errors, rules)


def _row(lanes: tuple[object, ...], end: str, kept: Bools) -> Floats:
    """One end of a member's lanes as a picture of one row."""
    columns = [np.asarray(getattr(lane, end))[kept] for lane in lanes]
    return _padded(np.stack(columns, axis=-1))


def _padded(values: NDArray[np.generic]) -> Floats:
    """Lanes of vertices as a picture of one row with four lanes; zeros if there are none."""
    whole = np.zeros((1, max(len(values), 1), 4))
    whole[0, : len(values), : values.shape[1]] = values
    return whole

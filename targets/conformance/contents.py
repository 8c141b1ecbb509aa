"""The contents that single shaders leave, and that are compared: pixels, elements or vertices.

``trials.py`` runs the cases of a shader by a route, and compares the answers with what the
reference says. For that it has a row for each content: how a route makes it, how the reference
computes it, and how both become pictures.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.documents.reflection import Reflection
from ...compiler.ir.shader import Result, Shader, Store
from ...compiler.ir.stages import COMPUTED
from ...compiler.ir.storage import LANE, byte_size, stored_element
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.capture import Listed, captured, captured_by_kernel
from ...compiler.reference.kernel import Lane, computed
from ...compiler.reference.picture import Expected, RasterRules
from ...support.frozen import changed
from ..runner.binding import FORMATS
from ..runner.capturing import Vertices, captured_by, give_elements
from ..runner.drivers.pipeline import Pipeline
from ..runner.frames.states import Outcome, draw_states
from ..runner.instances.shapes import stored_as
from ..runner.kernels import drawable, is_drawn, is_over_buffers, pictures_of
from ..runner.reference import Program, geometry_for, remembered, texels_of, values_for
from ..runner.reference_kernels import place_of
from ..runner.routes import Route
from ..runner.runner import Runner
from ..runner.scene_state import SceneState
from ..runner.store import Store as Pictures
from ..runner.subject import Subject
from .judging import (
    FLOATS,
    Bools,
    CasePictures,
    Compared,
    Floats,
    Shown,
    Stored,
    all_covered,
    row_of,
)


@dataclass(frozen=True, slots=True)
class Said:
    """The reference's result of a case within the bounds of a device; it is computed when asked
    for."""

    state: SceneState
    source: Program
    allowed: Callable[[], Any]
    """Computes the bounds by the emitted program."""
    meant: Callable[[], Any]
    """Computes the result by the source, on a device that rounds nothing."""
    possible: Callable[[], Any]
    """Computes the bounds by the source."""


Finds = Callable[[Program, SceneState, RasterRules, Errors | None], Any]


@dataclass(frozen=True, slots=True)
class Content:
    """The results of shaders, as far as they are compared."""

    answers: Callable[[Subject, Sequence[SceneState], Route, Pipeline, Runner], Sequence[Any]]
    """Has a route do all cases of a series: an answer for each. Raises ``BudgetError``,
    ``DriverError`` and ``PlanError``."""
    evaluated: Callable[[Shader], Shader]
    """Makes the shader that the reference evaluates."""
    found: Finds
    """Computes a case by the reference; without errors, as it is meant."""
    compared: Callable[[Any, Said], Compared]
    """Makes pictures of an answer and of what the reference says."""
    pictures: Callable[[Any, Reflection, int], CasePictures]
    """Makes pictures of what the reference has found for a reflection, of this width."""
    has_bounds: bool = False
    """True if the reference computes nothing of it without bounds."""


def content_of(reflection: Reflection, store: Pictures) -> Content:
    """The content that a shader leaves; ``store`` keeps the reference's pictures of it."""
    if not is_drawn(reflection):
        return ELEMENTS if is_over_buffers(reflection) else VERTICES

    def found(
        program: Program, state: SceneState, rules: RasterRules, errors: Errors | None
    ) -> Expected:
        return remembered(program, state, rules, store, errors)

    return Content(draw_states, as_drawn, found, _compared_pixels, _targets)


def _as_it_is(shader: Shader) -> Shader:
    return shader


# --- pixels of render targets, and of the images that kernels write ------------------------------


def _compared_pixels(got: Outcome, said: Said) -> Compared:
    # Without targets, the picture is that of the depths.
    formats = [result.state.format for result in said.source.shader.results if result.state]
    formats = formats or [form for _, form in pictures_of(said.state.instance.reflection)]
    return Compared.of(got.pictures, said.allowed(), said.meant(), formats, said.possible)


def _targets(found: Expected, reflection: Reflection, _width: int) -> CasePictures:
    names, stored = zip(*pictures_of(reflection), strict=True)
    return CasePictures.of_formats(names, stored, found)


def as_drawn(shader: Shader) -> Shader:
    """The shader as the reference draws what is compared: with the formats that drivers draw to."""
    drawn = drawable(shader)
    return changed(drawn, results=tuple(map(_as_drawn, drawn.results)))


def _as_drawn(result: Result) -> Result:
    state = result.state
    if state is None:
        return result
    drawn = FORMATS[state.format]
    name = next(name for name, other in FORMATS.items() if other == drawn)
    return changed(result, state=changed(state, format=name))


# --- elements of buffers: pixels of one row, each written part of which is a target ---------------


def _lanes(
    program: Program, state: SceneState, rules: RasterRules, errors: Errors | None
) -> Sequence[Lane]:
    shader, instance = program.shader, state.instance
    values, texels = values_for(shader, instance), texels_of(instance)
    counts = instance.result_counts()
    return computed(shader, values, texels, instance.extent(), counts, errors, rules)


def _compared_elements(got: Outcome, said: Said) -> Compared:
    lanes, width = said.allowed(), said.state.width
    meant = _pictures(said.meant(), width)
    return Compared.of(
        _written(lanes, got.elements, width),
        _pictures(lanes, width),
        meant,
        [FLOATS] * len(meant.targets),
        lambda: _pictures(said.possible(), width),
    )


def _parts(lanes: Sequence[Lane]) -> list[list[Lane]]:
    """The lanes of each part that is written."""
    found: dict[Store, list[Lane]] = {}
    for lane in lanes:
        found.setdefault(lane.store, []).append(lane)
    return list(found.values())


def _pictures(lanes: Sequence[Lane], width: int) -> Expected:
    values, low, high = (
        [row_of([getattr(lane, end) for lane in part], width) for part in _parts(lanes)]
        for end in ("value", "low", "high")
    )
    undecided = np.zeros((1, width), np.bool_)
    for lane in lanes:
        undecided[0, : len(lane.undecided)] |= lane.undecided
    return all_covered(values, low, high, undecided)


def _written(lanes: Sequence[Lane], data: Mapping[str, bytes], width: int) -> list[Floats]:
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
        found.append(row_of(columns, width))
    return found


def _elements(lanes: Sequence[Lane], reflection: Reflection, width: int) -> CasePictures:
    strides = {row.name: row.stride for row in reflection.results}
    shown = []
    for part in _parts(lanes):
        store, (offset, kind) = part[0].store, place_of(part[0])
        columns = (store.offset,) if store.stride > 1 else ()
        name = ".".join(map(str, (store.buffer.name, *store.path, *columns)))
        stored = Stored(store.buffer.name, offset, strides[store.buffer.name], kind)
        shown.append(Shown(name, len(part), stored))
    return CasePictures(shown, _pictures(lanes, width))


ELEMENTS = Content(draw_states, _as_it_is, _lanes, _compared_elements, _elements)


# --- captured vertices: pixels of one row, whose targets are the values ---------------------------


def _listed(
    program: Program, state: SceneState, rules: RasterRules, errors: Errors | None
) -> Listed:
    assert errors is not None, "the meaning is not asked for"
    shader, instance = program.shader, state.instance
    is_kernel = shader.chain == COMPUTED
    if is_kernel:
        give_elements(state)
    values, texels = values_for(shader, instance), texels_of(instance)
    if is_kernel:
        return captured_by_kernel(shader, values, texels, instance.extent(), errors, rules)
    geometry = geometry_for(shader, state.geometry())
    return captured(shader, values, texels, geometry, errors, rules)


def _compared_vertices(got: Vertices, said: Said) -> Compared:
    allowed = said.allowed()
    part = _Part.of(allowed, got)
    meant = part.expected(said.possible())
    formats = [FLOATS] * len(meant.targets)
    return Compared.of(part.got, part.expected(allowed), meant, formats, lambda: meant)


@dataclass(frozen=True, eq=False, slots=True)
class _Part:
    """The vertices that are compared, with the captured values of them.

    Rounding may decide which vertices are captured; then those before the first and behind the last
    such vertex are compared, and their number has to be possible.
    """

    kept: Bools
    """The listed vertices that are compared: those whose offsets in the buffer are known."""
    got: list[Floats]
    """For each member, a picture of one row; NaN if a wrong number of vertices was captured."""

    @classmethod
    def of(cls, listed: Listed, got: Vertices) -> _Part:
        """The part of a list that can be compared with the captured vertices."""
        tipping = np.flatnonzero(listed.possible & ~listed.certain)
        place = np.arange(len(listed.certain))
        first, last = (tipping[0], tipping[-1]) if len(tipping) else (len(place), len(place))
        before, behind = listed.certain & (place < first), listed.certain & (place > last)
        is_right = listed.certain.sum() <= got.count <= listed.possible.sum()
        head, tail = int(before.sum()), int(behind.sum())
        rows = np.r_[np.arange(head), np.arange(got.count - tail, got.count)]
        values = (
            each[rows] if is_right else np.full((len(rows), each.shape[1]), np.nan)
            for each in got.members.values()
        )
        return cls(before | behind, [_row(list(each.T), len(rows)) for each in values])

    def expected(self, listed: Listed) -> Expected:
        """The bounds of the vertices that are compared."""
        values, low, high = (
            [self._end(lanes, end) for lanes in listed.values] for end in ("value", "low", "high")
        )
        return all_covered(values, low, high)

    def _end(self, lanes: Sequence[object], end: str) -> Floats:
        """One end of a member's lanes."""
        columns = [np.asarray(getattr(lane, end))[self.kept] for lane in lanes]
        return _row(columns, int(self.kept.sum()))


def _row(lanes: Sequence[NDArray[Any]], count: int) -> Floats:
    """A picture of one row that is never empty."""
    return row_of(lanes, max(count, 1))


def _certain_vertices(listed: Listed, reflection: Reflection, _width: int) -> CasePictures:
    """The vertices before the first one of which rounding decides if it is captured."""
    capture = reflection.capture
    assert capture is not None, "vertices are captured"
    tipping = np.flatnonzero(listed.possible & ~listed.certain)
    end = tipping[0] if len(tipping) else len(listed.certain)
    part = _Part(listed.certain & (np.arange(len(listed.certain)) < end), [])
    places = (
        Stored(capture.buffer or "", row.offset, capture.stride, stored_as(row.representation))
        for row in capture.members
    )
    shown = [
        Shown(row.name, len(lanes), place)
        for row, lanes, place in zip(capture.members, listed.values, places, strict=True)
    ]
    expected = part.expected(listed)
    nothing = np.full_like(expected.undecided, not part.kept.any())
    return CasePictures(shown, replace(expected, undecided=nothing))


VERTICES = Content(
    captured_by, _as_it_is, _listed, _compared_vertices, _certain_vertices, has_bounds=True
)

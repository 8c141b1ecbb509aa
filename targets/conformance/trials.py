"""Tries a material or a kernel on routes: its cases, which all routes share.

``conform.py`` makes a trial of each subject, and asks it for the results of each route. All trials
answer alike; ``frames.py`` has that of a frame, and this module that of a single shader.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from ...compiler.ir.stages import CAPTURED, CAPTURED_EXPANDED, COMPUTED
from ...compiler.reference.attribution import Explanation, UncoveredError
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.picture import Expected, RasterRules
from ..runner.binding import pipeline
from ..runner.codes import compile_one
from ..runner.drivers.device import Device
from ..runner.exact import Exact
from ..runner.explanation import explained
from ..runner.frames.pixel_origins import Origin
from ..runner.instances.values import ParameterError
from ..runner.kernels import UndrawableError, drawable, is_drawn
from ..runner.reference import Program
from ..runner.routes import Route
from ..runner.runner import Runner
from ..runner.scene import set_by_scene
from ..runner.scene_state import SceneState, SettledState
from ..runner.subject import Subject, lacking
from ..toolchain import Toolchain
from .bounds import Bounds, bounds_of, precise, promised
from .cases import Series, Size, series_of
from .compare import Level
from .contents import Content, Said
from .judging import Answer, CasePictures, Compared
from .known_values import Known
from .rows import CaseResult

LISTED = (CAPTURED, CAPTURED_EXPANDED, COMPUTED)
"""The stages whose captured vertices, or elements, the reference can compute."""


@dataclass(frozen=True, slots=True)
class Version:
    """The material of which another one, which serves some values only, is a version."""

    source: Subject
    """The material for all values, which is drawn with some of those that the version serves."""
    narrowed: frozenset[str]
    """The names of parameters of which the version serves some values only."""
    fixed: frozenset[str]
    """The names of narrowed parameters that have one value: their default."""


class Trial(ABC):
    """The cases of one subject. Several threads use it."""

    def __init__(self, label: str, shaders: Sequence[Subject]) -> None:
        self.label = label
        self.shaders = shaders
        """Everything that routes draw or run."""

    def lacking(self, route: Route) -> str | None:
        """The reason why a route has nothing to draw, or nothing to be compared with."""
        return lacking(self.shaders, route)

    @abstractmethod
    def answers(
        self, route: Route, device: Device, runner: Runner, toolchain: Toolchain
    ) -> Iterator[Answer]:
        """An answer of a route for each case.

        Raises ``BudgetError``, ``CodeError``, ``DriverError``, ``MissingValuesError``,
        ``PlanError`` and ``UndrawableError``.
        """

    @abstractmethod
    def cases(self) -> Collection[str]:
        """The names of the cases."""

    @abstractmethod
    def made(
        self, case: str, route: Route, device: Device, level: Level, pixel: tuple[int, int]
    ) -> Explanation | Origin | None:
        """The origin of a pixel of a case, by the bounds of this level; ``None`` if nothing is
        drawn there."""

    @abstractmethod
    def promised(self, case: str, route: Route) -> Iterator[Bounds]:
        """The bounds of a case for all devices that keep the promises of a route's API."""

    @abstractmethod
    def text_of(self, case: str, profile: str | None) -> Hashable:
        """What is computed for a case: equal for profiles whose texts are the same graph. ``None``
        stands for the source."""

    @abstractmethod
    def bounded(self, case: str, profile: str | None, bounds: Bounds) -> CasePictures:
        """The pictures of a case within some bounds, by the text of a profile or by the source."""

    @abstractmethod
    def meant(self, case: str, bounds: Bounds) -> CasePictures:
        """The pictures of a case as the source means them, if a device covers the same pixels."""

    def results(
        self, route: Route, device: Device, runner: Runner, toolchain: Toolchain
    ) -> Iterator[CaseResult]:
        """A result for each case by a route. Raises what ``answers`` raises."""
        return (each.judged() for each in self.answers(route, device, runner, toolchain))


class ShaderTrial(Trial):
    """The cases of a single shader: of a material with a pass, or of a kernel."""

    def __init__(
        self,
        label: str,
        subject: Subject,
        content: Content,
        seed: int,
        size: Size,
        meant: Subject | None = None,
        version: Version | None = None,
    ) -> None:
        """``content`` is what the shader leaves, and ``size`` that of all pictures.

        ``meant`` is the form of the material that the reference computes, if that is another: one
        without stages that only some profiles have. ``version`` tells what the material is a
        version of, whose meaning the text has to have. Raises ``UndrawableError`` if such a form is
        needed and missing, and the errors of ``Instance`` and ``set_up``, although a case should
        lack no value.
        """
        super().__init__(label, [subject])
        self._content = content
        self._meant = form = _computed(subject, meant)
        if version is not None:
            _check_scenes(version)
        self._source = form if version is None else version.source
        kept = () if version is None else version.fixed
        like = self._source.reflection
        made: dict[int, tuple[Series, ...]] = {}  # Mostly all three forms are the same.
        for each in (form, subject, self._source):
            if id(each) not in made:
                found = series_of(each.reflection, seed, size, like=like, kept=kept)
                made[id(each)] = tuple(found)
        own, drawn, source = (made[id(each)] for each in (form, subject, self._source))
        self._work = [
            (
                series,
                [SettledState.of(case.state) for case in run.cases],
                [case.state for case in first.cases],
            )
            for series, run, first in zip(own, drawn, source, strict=True)
        ]
        """Each series as the reference computes it, with the states of its cases for drivers, and
        for the material of which this is a version."""
        self._programs: Known[Program] = Known()
        self._known: Known[Any] = Known()

    def lacking(self, route: Route) -> str | None:
        """The reason why a route has nothing to draw, or nothing to be compared with."""
        return lacking([*self.shaders, self._meant], route)

    def answers(
        self, route: Route, device: Device, runner: Runner, toolchain: Toolchain
    ) -> Iterator[Answer]:
        """An answer of a route for each case; it does a series when the first one is asked for."""
        (subject,) = self.shaders
        codes = compile_one(route, subject.files, toolchain)
        for series, states, sources in self._work:
            form = _form(subject, series)
            bound = pipeline(form.reflection, route, codes)
            made = self._content.answers(form, states, route, bound, runner)
            program, source = (self._program(series, each) for each in (route.profile, None))
            for case, first, got in zip(series.cases, sources, made, strict=True):
                yield Answer(
                    case.name,
                    bounds_of(case.state, route, device),
                    partial(self._compared, got, (program, case.state), (source, first)),
                )

    def cases(self) -> Mapping[str, SceneState]:
        """The states of the cases, by name."""
        return {case.name: case.state for series, *_states in self._work for case in series.cases}

    def made(
        self, case: str, route: Route, device: Device, level: Level, pixel: tuple[int, int]
    ) -> Explanation | None:
        """The operations that make a pixel of a picture inexact."""
        state, shader = self.cases()[case], drawable(self._meant.shader)
        bounds = next(one for one in bounds_of(state, route, device) if one.level == level)
        try:
            return explained(shader, state, bounds.rules, bounds.errors, *pixel)
        except UncoveredError:
            return None

    def promised(self, case: str, route: Route) -> Iterator[Bounds]:
        """The bounds of a case for all devices that keep the promises of a route's API."""
        return promised(self.cases()[case], route)

    def text_of(self, case: str, profile: str | None) -> Hashable:
        """The program of a profile as a text, or that of the source."""
        return self._program(self.series_with(case), profile).text

    def bounded(self, case: str, profile: str | None, bounds: Bounds) -> CasePictures:
        """The pictures of a case within some bounds."""
        return self._pictures(case, profile, bounds.rules, bounds.errors)

    def meant(self, case: str, bounds: Bounds) -> CasePictures:
        """The pictures of a case as the source means them."""
        if self._content.has_bounds:
            return self.bounded(case, None, bounds)
        return self._pictures(case, None, precise(bounds.rules), None)

    def series_with(self, case: str) -> Series:
        """The series with a case of this name."""
        return next(
            series
            for series, *_states in self._work
            if any(each.name == case for each in series.cases)
        )

    def form(self, case: str) -> Subject:
        """The shader as it is drawn for a case: with targets that keep everything, or its own."""
        return _form(self._meant, self.series_with(case))

    def _pictures(
        self, case: str, profile: str | None, rules: RasterRules, errors: Errors | None
    ) -> CasePictures:
        series = self.series_with(case)
        states = self.cases() if profile is not None else self._cases_of_source()
        state, program = states[case], self._program(series, profile)
        found = self._found(program, state, rules, errors)
        return self._content.pictures(found, self.form(case).reflection, state.width)

    def _cases_of_source(self) -> Mapping[str, SceneState]:
        """The states of the cases for the material of which this is a version, by name."""
        return {
            case.name: state
            for series, _drawn, states in self._work
            for case, state in zip(series.cases, states, strict=True)
        }

    def _compared(
        self,
        got: Any,
        text: tuple[Program, SceneState],
        source: tuple[Program, SceneState],
        bounds: Bounds,
    ) -> Compared:
        rules, errors = bounds.rules, bounds.errors
        said = Said(
            text[1],
            source[0],
            partial(self._found, *text, rules, errors),
            partial(self._found, *source, precise(rules), None),
            partial(self._found, *source, rules, errors),
        )
        return self._content.compared(got, said)

    def _found(
        self, program: Program, state: SceneState, rules: RasterRules, errors: Errors | None
    ) -> Any:
        """The reference's result of a case, computed once for all routes whose texts are the same
        graph."""
        # The rules for some drivers differ in rare rules only, on which only pictures depend.
        asked = program.text, id(state), errors
        return self._known.shared(
            (*asked, rules.common),
            (*asked, rules),
            lambda: self._content.found(program, state, rules, errors),
            lambda found: not isinstance(found, Expected) or rules.agree_with(found.counted),
        )

    def _program(self, series: Series, profile: str | None) -> Program:
        """The program as emitted for a profile, or that of the source."""

        def made() -> Program:
            form = _form(self._source if profile is None else self._meant, series)
            shader = form.shader if profile is None else form.emitted(profile)
            return Program.of(self._content.evaluated(shader))

        return self._programs.value((profile, series.exact), made)


def _check_scenes(version: Version) -> None:
    """Raise ``ParameterError`` if a version serves only some values of what scenes decide about."""
    reflection = version.source.reflection
    lamps = {light.count for light in reflection.lights if light.count}
    elements = {buffer.count for buffer in reflection.buffers}
    for name in sorted(version.narrowed & (set_by_scene(reflection) | lamps | elements)):
        raise ParameterError(name, f"the scenes that are compared set `{name}`, to any value")


def _form(subject: Subject, series: Series) -> Subject:
    """The form of a subject whose targets are those of a series."""
    return Exact.of(subject) if series.exact else subject


def _computed(subject: Subject, meant: Subject | None) -> Subject:
    """The form of a subject that the reference computes. Raises ``UndrawableError``."""
    if is_drawn(subject.reflection):
        return meant or subject
    form = subject if subject.shader.chain in LISTED else meant
    if form is None:
        raise UndrawableError(subject.name, "capture")
    return form

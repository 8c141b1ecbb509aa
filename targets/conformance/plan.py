"""Plans the draws of one material with the expected pictures, which all routes share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ...compiler.ir.blending import REPLACES
from ...compiler.ir.shader import Result, Shader
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.picture import Expected, RasterRules, formats
from ...frozen import changed
from ...stdlib.builtins.accuracy import Platform
from ..runner.binding import FORMATS, pipeline
from ..runner.codes import Codes
from ..runner.drivers.device import Device
from ..runner.drivers.draw_job import Picture
from ..runner.drivers.readback import arrays
from ..runner.kernels import drawable, pictures_of
from ..runner.reference import Draw, Program, remembered
from ..runner.reference import expected as drawn_here
from ..runner.routes import Route
from ..runner.runner import Runner
from ..runner.scene_state import SceneState
from ..runner.store import Store
from ..runner.subject import Subject
from .cases import Series, Size, series_of
from .compare import Comparison, Level, compare
from .drivers import DRIVERS, Driver, Hardware
from .measured import ENVELOPES
from .once import Known
from .rows import CaseResult

Floats = NDArray[np.float64]

_ANY: tuple[Platform, ...] = ("vulkan",)
"""The platform for errors of functions. Errors that were not measured follow from those that were,
on any platform. So all routes to a driver share one picture."""
FLOATS = "rgba32f"
"""The format that holds every float that is compared, in series that show what shaders write."""


@dataclass(frozen=True, slots=True)
class Bounds:
    """The tolerance for a device: its rasterisation rules, and the errors of its functions."""

    level: Level
    rules: RasterRules
    errors: Errors


class Plan:
    """The cases of one material. Several threads use it."""

    def __init__(
        self,
        label: str,
        subject: Subject,
        seed: int,
        store: Store,
        size: Size,
        draw: Draw = drawn_here,
        meant: Subject | None = None,
    ) -> None:
        """``draw`` draws with the reference, and ``store`` keeps its pictures.

        ``size`` is that of all pictures. ``meant`` is the form of the material that the reference
        draws, if that is another: one without stages that only some profiles have. Raises the
        errors of ``Instance`` and ``set_up``, although a case should lack no value.
        """
        self.label = label
        self.subject = subject
        self.meant = meant or subject
        self._work = [
            (series, tuple(case.state.draw() for case in drawn.cases))
            for series, drawn in zip(
                series_of(self.meant.reflection, seed, size),
                series_of(subject.reflection, seed, size, like=self.meant.reflection),
                strict=True,
            )
        ]
        """Each series with its draws."""
        self._expected: Known[Expected] = Known()
        self._programs: Known[Program] = Known()
        self._store = store
        self._draw = draw

    def results(
        self, route: Route, device: Device, codes: Codes, runner: Runner
    ) -> Iterator[CaseResult]:
        """A result for each case by a route, which draws a series when its first one is asked for.

        Raises ``DriverError``, and ``UndrawableError``.
        """
        reflection = self.subject.reflection
        for series, draws in self._work:
            bound = pipeline(reflection, route, codes, exact=series.exact)
            pictures = pictures_of(route, runner, reflection, bound, draws)
            yield from self._compared(series, route, device, pictures)

    def _compared(
        self, series: Series, route: Route, device: Device, pictures: Sequence[Picture]
    ) -> Iterator[CaseResult]:
        """A result for each case of a series, from the pictures that a route has drawn."""
        for case, picture in zip(series.cases, pictures, strict=True):
            questions = bounds_of(case.state, route, device)
            got = arrays(picture)
            found = [(c, e) for c, e in self._answers(case.state, got, route, questions, series)]
            yield CaseResult(case.name, summed_up([c for c, _ in found]), got, found[-1][1])

    def _answers(
        self,
        state: SceneState,
        got: Sequence[Floats],
        route: Route,
        questions: Sequence[Bounds],
        series: Series,
    ) -> Iterator[tuple[Comparison, Expected]]:
        """The comparisons with the first bounds, and with the next ones if these are left."""
        program, source = (
            self._program(profile, exact=series.exact) for profile in (route.profile, None)
        )
        for bounds in questions:
            expected = self._wanted(program, state, bounds.rules, bounds.errors)
            meant = self._wanted(source, state, precise(bounds.rules), None)
            # The text has no promises any more, nor what was written as `unguarded`: the material
            # knows where nothing is defined.
            expected = replace(expected, undecided=expected.undecided | meant.undecided)
            comparison = _compared(got, expected, source, meant, bounds)
            if comparison.changed:
                # In float64, too, numbers that cancel may tip a decision.
                possible = self._wanted(source, state, bounds.rules, bounds.errors)
                comparison = _compared(got, expected, source, meant, bounds, possible)
            yield comparison, expected
            if not comparison.wrong:
                return

    def _program(self, profile: str | None, *, exact: bool) -> Program:
        """The program as emitted for a profile, or that of the source."""

        def made() -> Program:
            emitted = self.meant.shader if profile is None else self.meant.emitted(profile)
            return Program.of(to_targets(drawable(emitted), exact=exact))

        return self._programs.value((profile, exact), made)

    def _wanted(
        self, program: Program, state: SceneState, rules: RasterRules, errors: Errors | None
    ) -> Expected:
        # The rules for some drivers differ in rare rules only.
        asked = program.text, id(state), errors
        return self._expected.shared(
            (*asked, rules.common),
            (*asked, rules),
            lambda: remembered(program, state, rules, self._store, errors, self._draw),
            lambda picture: rules.agree_with(picture.counted),
        )


def _compared(
    got: Sequence[Floats],
    expected: Expected,
    source: Program,
    meant: Expected,
    bounds: Bounds,
    possible: Expected | None = None,
) -> Comparison:
    """The result of ``compare`` for the formats to which the source draws."""
    targets = [result.state.format for result in source.shader.results if result.state]
    pairs = list(zip(targets, meant.targets, strict=True))
    return compare(
        got,
        expected,
        [formats.clamped(name, values) for name, values in pairs],
        [formats.step(name, values) for name, values in pairs],
        bounds.level,
        possible,
    )


def summed_up(found: Sequence[Comparison]) -> Comparison:
    """The last comparison, with the tightness of the first one."""
    first, last = found[0], found[-1]
    if first is last:
        return first
    # Pixels that left the first bounds are proven by the last ones only.
    proven = max(last.proven, first.proven - first.wrong)
    return replace(
        last, proven=proven, wide=first.wide + first.proven - proven, bite=first.bite,
        beyond=None if last.wrong else first.worst,
    )  # fmt: skip


class Sized2d(Protocol):
    """Anything with a width and a height in pixels."""

    @property
    def width(self) -> int:
        """Pixels in a row."""

    @property
    def height(self) -> int:
        """Rows."""


def bounds_of(state: Sized2d, route: Route, device: Device) -> tuple[Bounds, ...]:
    """The bounds of a picture: those that were measured of the driver, then the guaranteed ones."""
    driver = DRIVERS[route.driver]
    ruled = partial(rules_of, state, device, driver, bottom_up=route.bottom_up)
    guaranteed = Bounds(
        "guaranteed",
        ruled(_guaranteed(driver.assumed, device)),
        Errors(route.platforms),
    )
    if driver.measured is None:
        return (guaranteed,)
    functions = ENVELOPES[route.driver].allowed()
    measured = Bounds(
        "measured",
        ruled(driver.measured),
        Errors(_ANY, tuple(sorted(functions.items()))),
    )
    return measured, guaranteed


def _guaranteed(assumed: Hardware, device: Device) -> Hardware:
    """The properties that a device reports, and the assumed ones for the rest."""
    return replace(
        assumed,
        subtexel_bits=device.subtexel_bits or assumed.subtexel_bits,
        mip_bits=device.mip_bits or assumed.mip_bits,
    )


def rules_of(
    state: Sized2d, device: Device, driver: Driver, hardware: Hardware, *, bottom_up: bool
) -> RasterRules:
    """The rules by which a device rasterises a state; ``bottom_up``: if a quad's first pixel is the
    lower left one, which matters for levels and derivatives."""
    return RasterRules(
        state.width,
        state.height,
        device.subpixel_bits,
        interpolates_snapped=driver.interpolates_snapped,
        clips_sides=driver.clips_sides,
        owns_bottom=driver.owns_bottom,
        edge_slack=driver.edge_slack,
        subtexel_bits=hardware.subtexel_bits,
        varying_bits=hardware.varying_bits,
        frag_coord_bits=hardware.frag_coord_bits,
        mip_bits=hardware.mip_bits,
        mixing_bits=hardware.mixing_bits,
        derivatives=hardware.derivatives,
        euclidean_steps=hardware.euclidean_steps,
        corner_bits=hardware.corner_bits,
        lines=hardware.lines,
        snaps_line_ends=driver.snaps_line_ends,
        level_power=driver.level_power,
        bottom_up=bottom_up,
        projects_cubes=driver.projects_cubes,
        mirrors_sample_depths=driver.mirrors_sample_depths,
    )


def precise(rules: RasterRules) -> RasterRules:
    """The rules of a device that covers the same pixels, but rounds nothing.

    Of this device, nothing is known about an operation without a guard that leaves its domain.
    """
    return replace(
        rules,
        subtexel_bits=None,
        varying_bits=None,
        frag_coord_bits=None,
        mip_bits=None,
        mixing_bits=None,
        unguarded_is_nan=True,
    )


def to_targets(shader: Shader, *, exact: bool) -> Shader:
    """The shader with the targets that a series draws to; ``exact`` ones hold every float, and have
    one sample for each pixel."""
    state = changed(shader.render_state, samples=1) if exact else shader.render_state
    results = tuple(_to_target(one, exact=exact) for one in shader.results)
    return changed(shader, results=results, render_state=state)


def _to_target(result: Result, *, exact: bool) -> Result:
    state = result.state
    if state is None:
        return result
    if exact:
        return changed(result, state=changed(state, format=FLOATS, blend=REPLACES, mask="rgba"))
    drawn = FORMATS[state.format]
    name = next(name for name, other in FORMATS.items() if other == drawn)
    return changed(result, state=changed(state, format=name))

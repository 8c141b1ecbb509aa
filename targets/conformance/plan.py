"""Plans the draws of one material with the expected pictures, which all routes share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from threading import Lock

import numpy as np
from numpy.typing import NDArray

from ...compiler.ir import shader as ir
from ...compiler.reference.picture import Expected, RasterRules
from ...frozen import changed
from ..runner.drivers.draw import Device, Picture
from ..runner.drivers.readback import arrays
from ..runner.reference import remembered
from ..runner.routes import Route
from ..runner.scene_state import SceneState
from ..runner.store import Store
from ..runner.subject import Subject
from .cases import Series, series_of
from .compare import compare
from .formats import as_stored, format_steps
from .rows import CaseResult
from .tolerances import DRIVERS, Tolerance

Floats = NDArray[np.float64]


class Plan:
    """The cases of one material. Several threads use it."""

    def __init__(self, label: str, subject: Subject, seed: int, store: Store) -> None:
        """``store`` keeps what the reference has drawn.

        Raises what ``Instance`` and ``set_up`` raise, although a case should lack no value.
        """
        self.label = label
        self.subject = subject
        self.work = [
            (series, tuple(case.state.draw() for case in series.cases))
            for series in series_of(subject.reflection, seed)
        ]
        """Each series with its draws."""
        self._expected: dict[tuple[int, RasterRules], Expected] = {}
        self._lock = Lock()
        self._store = store
        self._unblended = changed(
            subject.shader, results=tuple(map(_unblended, subject.shader.results))
        )
        self._formats = [row["format"] for row in subject.reflection["targets"]]

    def compared(
        self, series: Series, route: Route, device: Device, pictures: Sequence[Picture]
    ) -> Iterator[CaseResult]:
        """A result for each case of a series, from the pictures that a route has drawn."""
        driver = DRIVERS[route.driver]
        for case, picture in zip(series.cases, pictures, strict=True):
            expected = self._wanted(case.state, rules_of(case.state, device, driver), series.exact)
            got = arrays(picture)
            steps: Sequence[Floats | float] = [0.0] * len(got)
            if not series.exact:
                stored = as_stored(expected.targets, self._formats)
                expected, got = replace(expected, targets=stored), as_stored(got, self._formats)
                steps = format_steps(stored, self._formats)
            comparison = compare(got, expected, driver, steps)
            yield CaseResult(case.name, comparison, got, expected)

    def _wanted(self, state: SceneState, rules: RasterRules, exact: bool) -> Expected:
        key = id(state), rules
        with self._lock:
            if key not in self._expected:
                shader = self._unblended if exact else self.subject.shader
                self._expected[key] = remembered(shader, state, rules, self._store)
            return self._expected[key]


def rules_of(state: SceneState, device: Device, driver: Tolerance) -> RasterRules:
    """The rules by which a device rasterises a state."""
    return RasterRules(
        state.width,
        state.height,
        device.subpixel_bits,
        interpolates_snapped=driver.interpolates_snapped,
        clips_sides=driver.clips_sides,
        edge_slack=driver.edge_slack,
        subtexel_bits=device.subtexel_bits or driver.subtexel_bits,
        functions=tuple(sorted(driver.functions.items())),
        rounding_bits=driver.rounding_bits,
        varying_bits=driver.varying_bits,
        mip_bits=device.mip_bits or driver.mip_bits,
        mixing_bits=driver.mixing_bits,
        level_power=driver.level_power,
        bottom_up=driver.bottom_up,
        projects_cubes=driver.projects_cubes,
    )


def _unblended(result: ir.Result) -> ir.Result:
    """The same result, written over what is there."""
    return changed(result, state=result.state and changed(result.state, blend="none"))

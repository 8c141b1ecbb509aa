"""Every overload of every builtin, over its whole domain, on every route.

Each result of 16384 samples has to be within the bounds of the builtin's definition. Functions also
have to be as accurate as they were found to be on the driver.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache

import numpy as np
import pytest

from burnish.stdlib.builtins.accuracy import Platform
from burnish.stdlib.builtins.overloads import COMPUTING, Overload, overloads
from burnish.targets.conformance.driver_accuracy import MARGIN
from burnish.targets.conformance.measured import ENVELOPES
from burnish.targets.runner.routes import DRIVERS, ROUTES, Route

from ..builtins.bounded import operands_at, results
from ..builtins.measure import FUNCTIONS, measure
from ..builtins.on_devices import compiled, returned
from ..builtins.overloads import Program, programs
from ..builtins.samples import Floats
from .kit import Studio

PROGRAMS = programs([overload for row in COMPUTING for overload in overloads(row)])
DECIDED = 0.4
"""The part of the samples of an overload whose results have to be known."""

_ON_SWIFTSHADER = ("swiftshader", "webgpu", "webgl2")
DEFECTS: Mapping[str, tuple[str, ...]] = dict.fromkeys(("exp", "degrees"), _ON_SWIFTSHADER)
"""The drivers on which a builtin leaves its bounds; docs/drivers.md lists these bugs."""

PARTS = ("ulp", "ulp_by_operand", "absolute", "absolute_by_operand")


@pytest.mark.parametrize("driver", DRIVERS)
def test_no_function_has_left_its_envelope(studio: Studio, driver: str) -> None:
    """A function that has become worse is found even where a specification promises little."""
    routes = [route for route in ROUTES.values() if route.driver == driver]
    found = measure(routes, studio.runner, studio.toolchain)
    kept = ENVELOPES[driver]
    worse = [
        f"{name}: {found[name]}, measured on {kept.device}: {kept.errors[name]}"
        for name in FUNCTIONS
        for part in PARTS
        if getattr(found[name], part) > MARGIN * getattr(kept.errors[name], part)
    ]
    assert not worse, "\n".join(worse)


def test_every_driver_was_measured() -> None:
    assert ENVELOPES.keys() == DRIVERS.keys()
    assert all(envelope.errors.keys() == FUNCTIONS.keys() for envelope in ENVELOPES.values())


@pytest.mark.parametrize("program", PROGRAMS, ids=str)
def test_results_are_within_the_bounds(studio: Studio, program: Program) -> None:
    material = compiled(program)
    bounds = lru_cache(maxsize=None)(results)
    wrong: list[str] = []
    defects = {
        (driver, name)
        for name in {lane.overload.row.name for lane in program.lanes}
        for driver in DEFECTS.get(name, ())
    }
    seen = set()
    for route in ROUTES.values():
        lanes = returned(material, route, studio.runner, studio.toolchain)
        for name, text in _outside(program, route, lanes, bounds):
            seen.add((route.driver, name))
            if (route.driver, name) not in defects:
                wrong.append(f"{route.name}: {text}")
    assert not wrong, "\n".join(wrong)
    assert not defects - seen, "a defect is gone: take it off the list"


Bounds = Callable[[Overload, tuple[Platform, ...]], list[tuple[Floats, Floats]]]


def _outside(
    program: Program, route: Route, lanes: list[Floats], bounds: Bounds
) -> Iterator[tuple[str, str]]:
    """The builtins of which a route returns wrong results, with one of them for each lane."""
    for place, got in zip(program.lanes, lanes, strict=False):
        overload = place.overload
        low, high = bounds(overload, route.platforms)[place.lane]
        known = np.isfinite(low) & np.isfinite(high)
        assert known.mean() >= DECIDED, f"{overload}: little is known of the results"
        wrong = known & ~((got >= low) & (got <= high))
        if wrong.any():
            row, column = np.argwhere(wrong)[0]
            at = int(row), int(column)
            yield (
                overload.row.name,
                (
                    f"{overload} of {operands_at(overload, at)} is {got[at]!r}, not in "
                    f"{low[at]!r} .. {high[at]!r}; {wrong.sum()} of {wrong.size} results"
                ),
            )

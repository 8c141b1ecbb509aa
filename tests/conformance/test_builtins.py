"""Every overload of every builtin, over its whole domain, on every route.

Each result of 16384 samples has to be within the bounds of the builtin's definition. Functions also
have to be as accurate as they were found to be on the driver.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np
import pytest

from burnish.targets.conformance.envelope import MARGIN
from burnish.targets.conformance.measured import ENVELOPES
from burnish.targets.runner.routes import DRIVERS, ROUTES

from ..builtins.bounded import operands_at, results
from ..builtins.drawn import compiled, returned
from ..builtins.measure import FUNCTIONS, measure
from ..builtins.overloads import COMPUTING, Overload, Program, overloads, programs
from ..builtins.samples import Floats
from .kit import Studio

PROGRAMS = programs([overload for row in COMPUTING for overload in overloads(row)])
DECIDED = 0.4
"""The part of the samples of an overload whose results have to be known."""

DEFECTS = {
    ("swiftshader", "exp"): 1.05,
    ("webgpu", "exp"): 1.05,
    ("webgl2", "exp"): 1.05,
}
"""Functions that leave their bounds, as docs/conformance.md lists: by how much of the bound."""

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


@cache
def bounds(overload: Overload, platforms: tuple[Platform, ...]) -> list[tuple[Floats, Floats]]:
    """Routes with the same platforms share them."""
    return results(overload, platforms)


@pytest.mark.parametrize("program", PROGRAMS, ids=str)
@pytest.mark.parametrize("route", ROUTES)
def test_results_are_within_the_bounds(studio: Studio, program: Program, route: str) -> None:
    lanes = returned(compiled(program), ROUTES[route], studio.runner, studio.toolchain)
    wrong = [*_outside(program, route, lanes)]
    assert not wrong, "\n".join(wrong)

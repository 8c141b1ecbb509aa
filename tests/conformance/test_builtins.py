"""Functions of the drivers are as accurate as they were found to be."""

from __future__ import annotations

import pytest

from burnish.targets.conformance.envelope import MARGIN
from burnish.targets.conformance.measured import ENVELOPES
from burnish.targets.runner.routes import DRIVERS, ROUTES

from ..builtins.measure import FUNCTIONS, measure
from .kit import Studio

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

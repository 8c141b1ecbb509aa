"""The listed peculiarities of drivers are true: without an entry, its driver's results differ.

So a new version of a driver is noticed if it does as specified, or if it no longer has a defect
on the list of ``subjects.py``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import pytest

import burnish
from burnish.targets.conformance import bounds
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.drivers import DRIVERS
from burnish.targets.runner.routes import ROUTES

from .kit import Studio
from .subjects import row

NEIGHBOURS = """\
burnish 1
material Product : Surface {
    product = frag_coord.x * frag_coord.y
    color = rgb(ddx(product), ddy(product), 0)
}
"""
"""A material whose derivatives differ between the rows and the columns of a quad."""


@pytest.mark.parametrize(
    ("route", "without", "material"),
    [
        ("swiftshader:glsl", {"projects_cubes": True}, "kinds: Slopes"),
        ("swiftshader:glsl", {"interpolates_snapped": False}, "operations: Limits"),
        ("lavapipe:glsl", {"interpolates_snapped": True}, "operations: Limits"),
    ],
)
def test_it_differs_without(
    studio: Studio,
    route: str,
    without: Mapping[str, object],
    material: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    driver = ROUTES[route].driver
    changed = {**DRIVERS, driver: replace(DRIVERS[driver], **without)}  # type: ignore[arg-type]
    monkeypatch.setattr(bounds, "DRIVERS", changed)
    assert row(studio, material, route).status == "differs", "it does as specified: say so"


@pytest.mark.parametrize("route", ["lavapipe:glsl", "swiftshader:glsl", "chromium:webgl2"])
def test_derivatives_are_those_of_the_row_that_is_said(studio: Studio, route: str) -> None:
    (material,) = burnish.compile(NEIGHBOURS, [ROUTES[route].profile])
    (found,) = conform([("Product", material)], [ROUTES[route]], studio.runner, studio.toolchain)
    assert found.status == "agrees"
    assert all(result.comparison.beyond is None for result in found.results)

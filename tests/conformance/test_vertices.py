"""Every route draws the inputs of vertices and instances as the reference does."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES

from .kit import Studio

FILE = Path(__file__).with_name("vertices.burnish")


@pytest.mark.parametrize(
    ("route", "hoist"), [*((route, True) for route in ROUTES), ("lavapipe:glsl", False)]
)
def test_it_agrees(studio: Studio, route: str, hoist: bool) -> None:
    found = burnish.compile(FILE, (ROUTES[route].profile,), hoist=hoist).materials
    subjects = [(material.name, material) for material in found]
    rows = conform(subjects, [ROUTES[route]], studio.runner, studio.toolchain)
    assert {row.material: details(row) for row in rows if row.status != "agrees"} == {}
    assert len(rows) == len(found) == 5


def test_the_materials_use_all_locations() -> None:
    """More inputs than WebGPU has buffers, which is 8."""
    (loaded,) = burnish.compile(FILE, ("wgsl",), material="Loaded").materials
    rows = loaded.reflection.vertex_inputs
    assert max(row.location or 0 for row in rows) == 15
    assert {row.step for row in rows} == {"vertex", "instance"}

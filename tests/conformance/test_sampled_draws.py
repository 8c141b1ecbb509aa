"""Single pictures with four samples for each pixel: every driver draws what the reference draws."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

import burnish
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import Runner

from .kit import Studio

ON = ("lavapipe:glsl", "llvmpipe:gl330", "chromium:webgpu", "chromium:webgl2")
PROFILES = tuple(sorted({ROUTES[name].profile for name in ON}))
TEXT = """
import std.lights.{Directional}
import std.terms.{lambert}

material Grey { color = lambert(vec3(0.5)) }
rig Studio { sun : Directional }
pass Smooth : Forward { raster { samples = 4 } }
"""


def rows(studio: Studio) -> list[Row]:
    (grey,) = burnish.compile(TEXT, PROFILES, pass_="Smooth").materials
    return conform([("grey", grey)], [ROUTES[name] for name in ON], studio.runner, studio.toolchain)


def test_pictures_of_samples_are_those_of_the_reference(studio: Studio) -> None:
    for row in rows(studio):
        assert row.status == "agrees", "\n".join([row.route.name, row.problem, *details(row)])


def test_a_single_sample_is_found(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """A driver that ignores them differs at the edges of what it draws."""
    draw = Runner.draw

    def with_one(runner: Runner, route: Any, pipeline: Any, draws: Any) -> Any:
        return draw(runner, route, replace(pipeline, samples=1), draws)

    monkeypatch.setattr(Runner, "draw", with_one)
    assert {row.status for row in rows(studio)} == {"differs"}

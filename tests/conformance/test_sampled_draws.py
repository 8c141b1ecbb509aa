"""Single pictures with four samples for each pixel: every driver draws what the reference draws."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import pytest

import burnish
from burnish.support.frozen import changed
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.conformance.summary import details
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.pipeline import Pipeline
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.frames import states
from burnish.targets.runner.frames.states import states_job
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene_state import SceneState
from burnish.targets.runner.subject import Subject

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

    def with_one(subject: Subject, drawn: Sequence[SceneState], bound: Pipeline) -> FrameJob:
        state = changed(subject.reflection.render_state, samples=1)
        single = Exact(subject, changed(subject.reflection, render_state=state))
        return states_job(single, drawn, replace(bound, samples=1))

    monkeypatch.setattr(states, "states_job", with_one)
    assert {row.status for row in rows(studio)} == {"differs"}

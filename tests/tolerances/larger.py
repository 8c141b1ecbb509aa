"""Correct tests with larger pictures, in which edges are a smaller share of the pixels.

Bounds have no part in them, as the reference would take long: only how often rules refuse what
another driver has drawn.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from burnish.api.entry_points import CompiledMaterial
from burnish.targets.conformance.cases import Size, series_of
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.frames.states import draw_states
from burnish.targets.runner.routes import Route
from burnish.targets.runner.runner import Runner
from burnish.targets.runner.scene_state import SceneState
from burnish.targets.toolchain import Toolchain

from .rules import Shown
from .verdicts import CLEAR, KEPT_ROUTE, Measured, Pictures, measured

LARGER: Size = (288, 224)
"""Four times as wide and as high as those of ``conform``."""
EACH_DRIVER = (
    KEPT_ROUTE, "llvmpipe:gl450", "swiftshader:glsl", "chromium:webgpu", "chromium:webgl2",
)  # fmt: skip
"""A route to each driver."""


def larger_tests(
    material: CompiledMaterial, routes: Sequence[Route], runner: Runner, toolchain: Toolchain
) -> Iterator[Measured]:
    """A test for each of ``EACH_DRIVER`` that is among the routes, beside what one of them drew."""
    states = {
        case.name: case.state
        for series in series_of(material.reflection, size=LARGER)
        for case in series.cases
        if series.exact
    }
    wanted = [route for route in routes if route.name in EACH_DRIVER]
    drawn = {
        route.name: _drawn(material, states, route, runner, toolchain) for route in wanted
    }  # fmt: skip
    kept = drawn.pop(KEPT_ROUTE, None)
    if kept is not None:
        yield from (measured(pictures, kept) for pictures in drawn.values())


def _drawn(
    material: CompiledMaterial,
    states: dict[str, SceneState],
    route: Route,
    runner: Runner,
    toolchain: Toolchain,
) -> Pictures:
    exact = Exact.of(material)
    codes = compile_one(route, material.files, toolchain)
    made = pipeline(exact.reflection, route, codes)
    found = draw_states(exact, [*states.values()], route, made, runner)
    return {
        name: [Shown(target, CLEAR) for target in each.pictures]
        for name, each in zip(states, found, strict=True)
    }

"""Drivers interpolate as precisely as their rows say: random triangles, slivers among them.

Nothing is computed from the interpolated values, so that only interpolation can be inexact.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.api.entry_points import CompiledMaterial
from burnish.targets.conformance.bounds import bounds_of
from burnish.targets.conformance.compare import Comparison, compare
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.exact import Exact, exact_shader
from burnish.targets.runner.frames.states import draw_states
from burnish.targets.runner.reference import expected
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene_state import SceneState

from .kit import Studio, compiled

TEXT = """
burnish 1

material M {
    attribute place : vec4
    attribute shade : vec4
}

pass Interpolated {
    clip_position = material.place
    target shades : rgba32f = material.shade
    target places : rgba32f = frag_coord
}
"""
PICTURES = 12
CLEAR = ((-8.0,) * 4,) * 2
ONE_OF_EACH_DRIVER = (
    "lavapipe:glsl", "swiftshader:glsl", "llvmpipe:gl330", "chromium:webgpu", "chromium:webgl2",
)  # fmt: skip
SLIGHTLY = 1.0 + 2.0**-16
"""A change that is noticed."""

Floats = NDArray[np.float64]


@cache
def material() -> CompiledMaterial:
    return compiled(TEXT, pass_="Interpolated")


def states() -> Iterator[SceneState]:
    """Triangles of all sizes and shapes, nearer at one corner, in part beyond the edges."""
    chance = np.random.default_rng(5)
    for _ in range(PICTURES):
        count = int(chance.integers(1, 9))
        w = 2.0 ** chance.uniform(-2, 3, 3 * count)
        size = 2.0 ** chance.uniform(-3, 2)
        center = chance.uniform(-0.8, 0.8, (count, 1, 2))
        xy = (center + size * chance.uniform(-1, 1, (count, 3, 2))).reshape(-1, 2)
        depth = chance.uniform(0.1, 0.9, 3 * count)
        place = np.column_stack([xy * w[:, None], depth * w, w])
        shade = chance.uniform(-1, 1, (3 * count, 4)) * 2.0 ** chance.uniform(-3, 3, (1, 4))
        attributes = {"place": _single(place), "shade": _single(shade)}
        triangles = np.arange(3 * count).reshape(-1, 3)
        yield SceneState(72, 56, attributes, triangles, material().instance(), CLEAR)


def _single(numbers: Floats) -> Floats:
    """Numbers that float32 has."""
    return numbers.astype(np.float32).astype(np.float64)


def comparisons(name: str, studio: Studio, factor: float = 1.0) -> Iterator[Comparison]:
    """Each picture against the measured bounds of a driver, for values that are larger."""
    route = ROUTES[name]
    codes = compile_one(route, material().files, studio.toolchain)
    exact, drawn = Exact.of(material()), list(states())
    made = pipeline(exact.reflection, route, codes)
    found = draw_states(exact, drawn, route, made, studio.runner)
    program = exact_shader(material().emitted(route.profile))
    for state, outcome in zip(drawn, found, strict=True):
        bounds = bounds_of(state, route, studio.runner.device(route))[0]
        larger = {**state.attributes, "shade": _single(factor * state.attributes["shade"])}
        asked = replace(state, attributes=larger)
        wanted = expected(program, asked, bounds.rules, bounds.errors)
        steps = [np.ones_like(target) for target in wanted.targets]
        yield compare(outcome.pictures, wanted, wanted.targets, steps, bounds.level)


@pytest.mark.parametrize("route", ONE_OF_EACH_DRIVER)
def test_it_is_as_precise_as_was_measured(studio: Studio, route: str) -> None:
    found = list(comparisons(route, studio))
    assert [one.level for one in found] == ["measured"] * PICTURES
    assert all(one.agrees for one in found)
    assert sum(one.proven for one in found) > 3000


def test_a_small_error_would_show(studio: Studio) -> None:
    wrong = sum(one.wrong for one in comparisons("lavapipe:glsl", studio, SLIGHTLY))
    assert wrong > 1000

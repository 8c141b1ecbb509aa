"""The same material by four ways to SPIR-V: bindings as reflected, and the same pictures."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

import burnish
from burnish.targets.runner import meshes
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import Codes, compile_one
from burnish.targets.runner.drivers.vulkan.blocks import block_sizes
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.routes import ROUTES, Route
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import set_up

from .jobs_kit import draw_job
from .vulkan_kit import Asker, Floats, pixels, tools

EXAMPLES = Path(__file__).parents[2] / "examples"
PROFILES = ("glsl:vulkan", "hlsl", "wgsl")
SIZE = (64, 48)
AGREEMENT = 1e-4
"""The ways differ by rounding alone: the drivers are the same."""


@cache
def material(file: str) -> burnish.CompiledMaterial:
    """An example for all texts that become SPIR-V."""
    (compiled,) = burnish.compile(EXAMPLES / file, PROFILES).materials
    return compiled


def ways(driver: str) -> Sequence[Route]:
    """The routes to a driver."""
    return [route for route in ROUTES.values() if route.driver == driver]


@cache
def codes(file: str, route: str) -> Codes:
    """The codes that a route's compiler makes of an example."""
    return compile_one(ROUTES[route], material(file).files, tools())


def picture(vulkan: Asker, file: str, route: Route) -> Floats:
    """A sphere in the standard scene."""
    reflection = Exact.of(material(file)).reflection
    state = set_up(Instance(reflection), meshes.mesh("sphere"), Scene(), SIZE)
    job = draw_job(pipeline(reflection, route, codes(file, route.name)), (state.draw(),))
    (drawn,) = vulkan.draw(job)
    return pixels(drawn)


@pytest.mark.parametrize("file", ["lambert.burnish", "plastic.burnish"])
def test_all_ways_to_spirv_draw_the_same(vulkan: Asker, file: str) -> None:
    pictures = {route.name: picture(vulkan, file, route) for route in ways(vulkan.driver)}
    assert len(pictures) == 4
    for one, other in combinations(pictures.values(), 2):
        covered = one[:, :, 3] == 1.0
        assert 0.2 < covered.mean() < 0.8
        assert np.array_equal(covered, other[:, :, 3] == 1.0)
        assert np.ptp(one[covered][:, :3]) > 0.3
        assert np.abs(one - other).max() <= AGREEMENT


@pytest.mark.parametrize("way", [route.name for route in ways("lavapipe")])
def test_blocks_lie_where_the_reflection_says(way: str) -> None:
    """In both stages together all blocks are read, each within the bytes that it has."""
    reflection = material("plastic.burnish").reflection
    places = reflection.backends[ROUTES[way].profile].blocks
    stated = {
        (places[row.name].group, places[row.name].binding): row.size for row in reflection.blocks
    }
    made = codes("plastic.burnish", way)
    stages = [block_sizes(code.spirv) for code in made.stages.values()]
    assert {place for stage in stages for place in stage} == set(stated)
    for stage in stages:
        for place, size in stage.items():
            assert stated[place] - 16 < size <= stated[place]

"""Drivers draw with layouts of everything that is declared, whatever a shader reads of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import burnish
from burnish.compiler.documents.backends import EntryRow
from burnish.compiler.documents.reflection import Reflection
from burnish.targets.runner import meshes
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.drivers.pipeline import Pipeline
from burnish.targets.runner.drivers.slots import BlockSlot, Place
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import set_up

from .jobs_kit import draw_job
from .vulkan_kit import Asker, Floats, pixels, tools

SIZE = (48, 32)
UNREAD = bytes(16)
"""What a host binds where nothing is read: the smallest block."""
TEXT = """
import std.terms.{lambert}
import std.lights.{Directional, Spot}
rig Hall { key : Directional  torch : Spot { inner = 20deg, outer = 40deg } }
pass Timed : Forward { param time : float per frame = 0 }
material Dull { color = lambert(vec3(0.8)) }
material Flat { param tint : rgb = #b5651d  color = tint }
"""


def whole(
    reflection: Reflection, profile: str, made: Pipeline, draw: Draw
) -> tuple[Pipeline, Draw]:
    """A pipeline and a draw with all blocks that layouts list."""
    places = {(slot.place.group, slot.place.binding) for slot in made.blocks}
    entries: list[tuple[int, EntryRow]] = [
        (row.group, entry) for row in reflection.backends[profile].layouts for entry in row.entries
    ]
    unread = [(group, entry) for group, entry in entries if not entry.read]
    assert {entry.kind for _, entry in unread} == {"block"}
    added = [BlockSlot(Place(e.name, group, e.binding), len(UNREAD)) for group, e in unread]
    assert places.isdisjoint((slot.place.group, slot.place.binding) for slot in added)
    blocks = (*made.blocks, *added)
    assert {(slot.place.group, slot.place.binding) for slot in blocks} == {
        (group, entry.binding) for group, entry in entries if entry.kind == "block"
    }
    more = (UNREAD,) * len(added)
    return replace(made, blocks=blocks), replace(draw, blocks=(*draw.blocks, *more))


@pytest.mark.parametrize("way", ["glsl", "wgsl-naga"])
@pytest.mark.parametrize("name", ["Dull", "Flat"])
def test_a_layout_of_what_is_declared_draws_the_same(vulkan: Asker, way: str, name: str) -> None:
    route = ROUTES[f"{vulkan.driver}:{way}"]
    material = burnish.compile(TEXT, (route.profile,), pass_="Timed", rig="Hall")[name]
    reflection = Exact.of(material).reflection
    codes = compile_one(route, material.files, tools())
    state = set_up(Instance(reflection), meshes.mesh("sphere"), Scene(), SIZE)
    made, draw = pipeline(reflection, route, codes), state.draw()

    def drawn(made: Pipeline, draw: Draw) -> Floats:
        (found,) = vulkan.draw(draw_job(made, (draw,)))
        return pixels(found)

    expected = drawn(made, draw)
    assert np.ptp(expected[:, :, :3]) > 0.1
    assert np.array_equal(drawn(*whole(reflection, route.profile, made, draw)), expected)


def test_push_constants_and_combined_samplers_draw_the_same(vulkan: Asker) -> None:
    """Of a texture that is sampled, and of one of which texels are only loaded."""
    text = """
    material Worn {
        map albedo : texture2d
        map wear   : texture2d
        color = albedo(uv).rgb * (0.25 + uv.x + wear.load(ivec2(0), 0).rgb)
    }
    """
    route = ROUTES[f"{vulkan.driver}:glsl"]
    schemes: tuple[dict[str, object], ...] = (
        {},
        {"combined_samplers": True, "push_constants": "draw"},
    )
    found: list[Floats] = []
    for scheme in schemes:
        (material,) = burnish.compile(text, (route.profile,), bindings=scheme).materials
        reflection = Exact.of(material).reflection
        codes = compile_one(route, material.files, tools())
        state = set_up(Instance(reflection), meshes.mesh("sphere"), Scene(), SIZE)
        (drawn,) = vulkan.draw(draw_job(pipeline(reflection, route, codes), (state.draw(),)))
        found.append(pixels(drawn))
    assert np.ptp(found[0][:, :, 0]) > 0.1
    assert np.array_equal(found[0], found[1])

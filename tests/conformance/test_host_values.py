"""NaN and infinity that a host passes in are contained: nothing crashes, no other pixel changes.

They are outside of what a program means, so nothing is said about the pixels that they touch.
"""

from __future__ import annotations

import math
import struct
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from burnish.api.entry_points import CompiledMaterial
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.frames.states import states_job
from burnish.targets.runner.meshes import Mesh, plane
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import set_up
from burnish.targets.runner.textures.texture import Texture

from .kit import Floats, Studio, compiled, redrawn

SIDE = 16
POISON = (math.nan, math.inf, -math.inf)
PROGRAM = """burnish 1

material Poisoned {
    param gain : float = 0.5
    map albedo : texture2d
    texel = albedo.load(ivec2(frag_coord.xy), 0)
    place = ivec2(clamp(8 * texel.xy, 0, 15))
}

/// A loop and an index that depend on the poison.
fn summed(v: vec4) -> float = sum i in 0..4 : pow(v.x, float(i)) / (v.y - float(i))

pass Shown {
    clip_position = vec4(vertex_position, 1)
    target plain : rgba32f = texel
    target used  : rgba32f = vec4(normalize(texel.xyz), acos(texel.w))
    target read  : rgba32f = albedo.load(place, 0)
    target loops : rgba32f = vec4(summed(texel), float(int(texel.z)), texel[int(3 * texel.w)], 1)
    target gains : rgba32f = vec4(gain * frag_coord.x, sqrt(gain), 1, 2)
}
"""


@cache
def material() -> CompiledMaterial:
    """The program that looks at what the host passes in."""
    return compiled(PROGRAM, pass_="Shown")


def texels() -> Floats:
    """Ordinary texels."""
    return np.random.default_rng(1).uniform(0.1, 0.9, (SIDE, SIDE, 4))


COVER = plane(1)
GAIN = 0.53125
"""The value of the parameter; its bytes occur nowhere else in its block."""


def drawn(
    studio: Studio,
    where: str,
    array: Floats,
    *,
    gain: float = GAIN,
    mesh: Mesh = COVER,
    corner: float | None = None,
) -> tuple[Floats, ...]:
    """The targets with these values, which are put where a host of its own kind would put them:
    ``Instance`` and ``Mesh`` refuse such numbers. ``corner`` replaces the last vertex but one."""
    instance = material().instance()
    data = array.astype("<f4").tobytes()
    instance.set("albedo", Texture("rgba32float", SIDE, SIDE, (data,)))
    instance.set("gain", GAIN)
    state = set_up(instance, mesh, Scene(), (SIDE, SIDE))
    written, wanted = (struct.pack("<f", value) for value in (GAIN, gain))

    def changed(draw: Draw) -> Draw:
        draw = replace(draw, blocks=tuple(block.replace(written, wanted) for block in draw.blocks))
        if corner is None:
            return draw
        places = np.frombuffer(draw.vertices[0], "<f4").reshape(-1, 3).copy()
        places[-2] = corner
        return replace(draw, vertices=(places.tobytes(),))

    route, exact = ROUTES[where], Exact.of(material())
    made = pipeline(exact.reflection, route, compile_one(route, exact.files, studio.toolchain))
    job = redrawn(states_job(exact, [state], made), changed)
    (picture,) = studio.pictures(route, job, [state])
    return picture


@pytest.mark.parametrize("route", ROUTES)
def test_a_poisoned_texel_changes_no_other_pixel(studio: Studio, route: str) -> None:
    poisoned, places = texels(), [(2, 3), (7, 8), (11, 5)]
    clean = drawn(studio, route, poisoned)
    for place, value in zip(places, POISON, strict=True):
        poisoned[place] = value
    found = drawn(studio, route, poisoned)
    untouched = np.ones((SIDE, SIDE), bool)
    untouched[tuple(zip(*places, strict=True))] = False
    # The third target reads texels of other places, which may be poisoned ones.
    others = [0, 1, 3, 4]
    for target in others:
        assert np.array_equal(found[target][untouched], clean[target][untouched])


@pytest.mark.parametrize("route", ROUTES)
def test_a_poisoned_vertex_changes_no_other_primitive(studio: Studio, route: str) -> None:
    left = [[-1, 1, 0], [-1, -1, 0], [0, -1, 0], [0, 1, 0]]
    right = [[x + 1, y, z] for x, y, z in left]
    triangles = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
    mesh = Mesh({"position": np.array(left + right, float)}, triangles)
    clean = drawn(studio, route, texels(), mesh=mesh)
    for value in POISON:
        found = drawn(studio, route, texels(), mesh=mesh, corner=value)
        for target, expected in zip(found, clean, strict=True):
            assert np.array_equal(target[:, : SIDE // 2], expected[:, : SIDE // 2])


@pytest.mark.parametrize("route", ROUTES)
def test_a_poisoned_parameter_changes_only_what_uses_it(studio: Studio, route: str) -> None:
    clean = drawn(studio, route, texels())
    for value in POISON:
        *others, gains = drawn(studio, route, texels(), gain=value)
        assert all(np.array_equal(*pair) for pair in zip(others, clean[:-1], strict=True))
        assert np.array_equal(gains[..., 2:], clean[-1][..., 2:])
        assert not np.array_equal(gains[..., 0], clean[-1][..., 0], equal_nan=True)

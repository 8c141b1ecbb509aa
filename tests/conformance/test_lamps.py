"""Lights in storage buffers: any number of a rig's lamps, and lists of those that reach a box."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.reference.picture import RasterRules
from burnish.compiler.semantics.shading import rigs
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.meshes import mesh
from burnish.targets.runner.reference import expected
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import SceneState, set_up

from .kit import Floats, Studio

ON = ("lavapipe:glsl", "lavapipe:hlsl-dxc", "lavapipe:wgsl-naga", "llvmpipe:gl450")
PROFILES = ("glsl:vulkan", "hlsl:sm6", "wgsl:webgpu", "glsl:gl450")
EXAMPLES = Path(__file__).parents[2] / "examples"
SIZE = (40, 40)
BOXES, LOW, SIDE = 4, -1.5, 3.0

TEXT = """
import std.lights.{{Directional, Point}}
import std.terms.{{lambert, phong}}
rig R {{
    moon  : Directional {{ diffuse_color = 0.2 * inherited.diffuse_color }}
    lamps : Point{}
}}
material M {{ color = lambert(#a0b0c0) + phong(vec3(0.2), 12) }}
"""

Lamps = list[dict[str, Any]]


def lamps(count: int) -> Lamps:
    """Lamps around the mesh, no two alike."""
    turned = np.arange(count) * 2.4
    return [
        {
            "place": (1.4 * np.cos(a), 1.3 * np.sin(2 * a), 1.4 * np.sin(a)),
            "diffuse_color": (0.1 + 0.05 * (k % 5), 0.2, 0.3 - 0.04 * (k % 7)),
            "specular_color": (0.2, 0.05 * (k % 4), 0.1),
        }
        for k, a in enumerate(turned)
    ]


def lit(number: str) -> CompiledMaterial:
    (material,) = burnish.compile(TEXT.format(number), PROFILES).materials
    return material


def state_of(material: CompiledMaterial) -> SceneState:
    around = with_inputs(material.reflection, mesh("sphere"))
    return set_up(material.instance(), around, Scene(), SIZE)


def with_lamps(material: CompiledMaterial, given: Lamps) -> SceneState:
    state = state_of(material)
    # The scene's moon depends on how many other lights there are.
    state.instance.set("moon.direction", (0, -0.6, -0.8))
    for name in ("diffuse_color", "specular_color"):
        state.instance.set(f"moon.{name}", (0.5, 0.5, 0.6))
    state.instance.set("lamps", given)
    return state


def picture(material: CompiledMaterial, state: SceneState) -> Floats:
    (target,) = expected(material.shader, state, RasterRules(state.width, state.height)).targets
    return target


@pytest.mark.parametrize("count", [1, 3, 40])
def test_a_buffer_of_lamps_is_like_an_array(count: int) -> None:
    free, fixed = lit("[]"), lit(f"[{count}]")
    found = picture(free, with_lamps(free, lamps(count)))
    expected = picture(fixed, with_lamps(fixed, lamps(count)))
    assert np.allclose(found, expected, rtol=1e-12)
    assert found[..., 0].max() > 0.1


def test_without_lamps_the_others_shine() -> None:
    free, alone = lit("[]"), lit("[<= 1]")
    found = picture(free, with_lamps(free, []))
    assert np.allclose(found, picture(alone, with_lamps(alone, [])), rtol=1e-12)
    assert (found != picture(free, with_lamps(free, lamps(1)))).any()


@pytest.mark.parametrize("route", ON)
def test_drivers_draw_it(studio: Studio, route: str) -> None:
    material = lit("[]")
    state = with_lamps(material, lamps(17))
    (found,) = studio.draw(route, material, state)
    inside = picture(material, state)
    close = np.isclose(found, inside, atol=2e-3).all(axis=-1)
    assert close.mean() > 0.99  # At the outline, drivers may cover other pixels.


def test_a_host_sees_a_buffer() -> None:
    (row,) = lit("[]").reflection.buffers
    assert (row.name, row.count, row.group) == ("lamps", "lamps.count", "rig")
    assert [member.name for member in row.members] == [
        "diffuse_color", "specular_color", "place",
    ]  # fmt: skip


def test_more_than_a_loop_can_ask_are_left_out() -> None:
    text = lit("[]").text("glsl:vulkan", "fragment")
    assert "i < min(lamps_count, 4096)" in text


def test_lights_with_textures_are_in_no_buffer() -> None:
    text = """
        import std.lights.{Spot}
        light Projector : Spot { map slide : texture2d  falloff = slide(vec2(0)).r }
        rig R { all : Projector[] }
        material M { color = vec3(1) }
    """
    (found,) = burnish.check(text)
    assert (found.rule.code, found.span and found.span.text) == ("B0609", "all")


# --- lists of those that reach a box -------------------------------------------------------------


def hall() -> CompiledMaterial:
    return burnish.compile(EXAMPLES / "clusters.burnish", PROFILES, partial=True)["Hall"]


def fill(instance: Instance, *, listed: Callable[[Floats], Floats]) -> int:
    """Set lamps, and for each box the list of those that ``listed`` says reach it, by how far away
    they are from the box; returns how many numbers all lists have."""
    rng = np.random.default_rng(5)
    places = rng.uniform(LOW, LOW + SIDE, (60, 3))
    reach = rng.uniform(0.3, 0.9, 60)
    tints = rng.uniform(0.1, 1.0, (60, 3))
    length = SIDE / BOXES
    boxes: list[dict[str, int]] = []
    numbers: list[int] = []
    for z, y, x in np.ndindex(BOXES, BOXES, BOXES):
        corner = LOW + length * np.array([x, y, z])
        nearest = np.clip(places, corner, corner + length)
        away = np.linalg.norm(places - nearest, axis=1)
        own = np.flatnonzero(listed(away) <= reach)
        boxes.append({"first": len(numbers), "count": len(own)})
        numbers += own.tolist()
    instance.set("lamps", [
        {"place": tuple(p), "tint": tuple(t), "reach": r}
        for p, t, r in zip(places, tints, reach, strict=True)
    ])  # fmt: skip
    instance.set("listed", numbers)
    instance.set("grid", boxes)
    for name, value in (("boxes", BOXES), ("low", (LOW,) * 3), ("side", SIDE)):
        instance.set(name, value)
    return len(numbers)


def test_lists_leave_out_only_what_does_not_reach() -> None:
    material = hall()
    some, every = state_of(material), state_of(material)
    short = fill(some.instance, listed=lambda away: away)
    long = fill(every.instance, listed=lambda away: 0 * away)
    assert short < long / 4
    found, expected = picture(material, some), picture(material, every)
    assert np.allclose(found, expected, rtol=1e-9)
    assert found[..., :3].max() > 0.2


def test_a_list_that_is_too_short_is_seen() -> None:
    material = hall()
    some, few = state_of(material), state_of(material)
    fill(some.instance, listed=lambda away: away)
    fill(few.instance, listed=lambda away: 3 * away)
    assert not np.allclose(picture(material, some), picture(material, few), rtol=1e-3)


def test_wrong_bounds_are_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """The bounds are wrong as only two of the lamps are asked."""
    monkeypatch.setattr(rigs, "LONGEST", 2)
    free = lit("[]")
    monkeypatch.undo()
    fixed = lit("[9]")
    found = picture(free, with_lamps(free, lamps(9)))
    assert not np.allclose(found, picture(fixed, with_lamps(fixed, lamps(9))), rtol=1e-3)

"""Loops whose result is multiplied by zero for a whole draw are behind a branch, and not run."""

from __future__ import annotations

import pytest

import burnish

from .agreement import disagreements
from .kit import World, shader

MATERIAL = """
fn waves(x: float) -> float = sum i in 0..32 : sin(x * float(i))
material M {{
    param k     : float in 0..1 = 0
    param usual : float in 0..1 = 1
    param tint : rgb
    param free : float = 1
    map dirt : texture2d
    color = {color}
}}
"""
SKIPPED = {
    "product": "vec3(k * waves(uv.x))",
    "product of several": "tint * free * waves(uv.x) * k * sin(uv.y)",
    "mixture": "mix(tint, vec3(waves(uv.x)), k)",
    "implicit level": "tint + k * (sum i in 0..8 : dirt(uv * float(i)).rgb)",
    "derivative": "vec3(k * ddx(waves(uv.x)))",
}
KEPT = {
    "short loop": "vec3((1 - usual) * (sum i in 0..5 : uv.x * float(i)))",
    "weight that is hardly ever zero": "vec3(usual * waves(uv.x))",
    "no range": "vec3(free * waves(uv.x))",
    "no loop": "vec3(k * pow(saturate(normal.y), 40))",
    "weight of a pixel": "vec3(saturate(uv.x) * waves(uv.y))",
    "needed elsewhere": "vec3(k * w, w, 0)\n    w = waves(uv.x)",
}


def fragment(color: str, target: str = "glsl") -> str:
    (material,) = burnish.compile(MATERIAL.format(color=color), target)
    return material.text(target, "fragment")


@pytest.mark.parametrize("color", SKIPPED.values(), ids=SKIPPED.keys())
def test_a_loop_with_a_uniform_weight_is_behind_a_branch(color: str) -> None:
    for target in ("glsl", "hlsl", "wgsl"):
        text = fragment(color, target)
        assert 0 < text.index("if (") < text.index("for (")


@pytest.mark.parametrize("color", KEPT.values(), ids=KEPT.keys())
def test_other_values_are_computed_without_a_branch(color: str) -> None:
    assert "if (" not in fragment(color)


@pytest.mark.parametrize("color", SKIPPED.values(), ids=SKIPPED.keys())
def test_the_value_is_what_it_was(color: str) -> None:
    worlds = [World(seed, traps=seed == 0) for seed in range(4)]
    assert not disagreements(shader(MATERIAL.format(color=color)), worlds)


def test_of_several_weights_the_one_decides_that_is_likely_to_be_zero() -> None:
    text = fragment("vec3(usual * k * waves(uv.x))")
    assert "if (color_product != 0.0)" in text


def test_a_long_loop_is_skipped_however_unlikely_that_is() -> None:
    assert "if (usual != 0.0)" in fragment("vec3(usual * (sum i in 0..512 : sin(uv.x * float(i))))")


def test_the_condition_needs_no_block_of_its_own() -> None:
    text = fragment(SKIPPED["product"])
    assert "if (k != 0.0)" in text
    assert "Derived" not in text


def test_a_draw_with_weight_zero_is_what_the_loop_times_zero_is() -> None:
    source = MATERIAL.format(color=SKIPPED["mixture"]).replace("in 0..1 = 0", "in 0..0")
    assert not disagreements(shader(source), [World(seed) for seed in range(2)])

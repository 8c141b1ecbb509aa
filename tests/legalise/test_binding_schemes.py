"""Schemes of bindings, as every language writes them, and as mistakes in them are told."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

import burnish
from burnish.compiler.diagnostics.render import render_all
from burnish.targets.toolchain import Toolchain
from tests.examples.kit import jobs_of
from tests.suite.verdicts import refused

TEXT = """
import std.lights.{Point}
import std.terms.{lambert}
rig Hall { lamps : Point[] }
material M {
    param wind  : float per weather = 1
    param time  : float per frame = 0
    map albedo  : texture2d
    map around  : texture_cube per frame
    bent  = sin(time) * uv.x + sin(wind) * uv.y
    color = lambert(albedo(uv).rgb * bent) + around(normal).rgb
}
"""
PROFILES = ("glsl:vulkan", "hlsl:sm6", "wgsl:webgpu")
SCHEME: Mapping[str, Any] = {
    "sets": {"weather": 1, "rig": 0, "draw": 1},
    "first": {"frame": 4, "rig": 8, "draw": 3},
    "resources": {"frame": 0},
    "kinds": {"block": 5, "texture": 3},
}


def places(profile: str, **more: Any) -> dict[str, tuple[int | None, int | None]]:
    """Where blocks, buffers, textures and samplers are bound, by the reflection."""
    (material,) = burnish.compile(TEXT, (profile,), rig="Hall", **more).materials
    backend = material.reflection.backends[profile]
    kinds = (backend.blocks, backend.buffers, backend.textures)
    found = {name: (row.group, row.binding) for rows in kinds for name, row in rows.items()}
    samplers = {f"{name}'s": (row.group, row.binding) for name, row in backend.samplers.items()}
    return found | samplers


@pytest.mark.parametrize("profile", PROFILES)
def test_the_usual_scheme(profile: str) -> None:
    """What frames, views and rigs share has no number that anything else moves."""
    assert places(profile) == {
        "View": (0, 1), "Rig": (1, 0), "lamps": (1, 1), "DerivedFromFrame": (2, 2),
        "WeatherDerived": (2, 6), "around": (2, 7), "around's": (2, 8), "albedo": (2, 9),
        "albedo's": (2, 10), "Draw": (3, 0), "DrawDerived": (3, 1),
    }  # fmt: skip


@pytest.mark.parametrize("profile", PROFILES)
def test_a_scheme_moves_groups(profile: str) -> None:
    assert places(profile, bindings=SCHEME) == {
        "View": (0, 5), "Rig": (0, 8), "lamps": (0, 9), "around": (0, 10), "around's": (0, 11),
        "Draw": (1, 3), "DrawDerived": (1, 4), "WeatherDerived": (1, 6), "DerivedFromFrame": (2, 2),
        "albedo": (2, 5), "albedo's": (2, 6),
    }  # fmt: skip


def test_kinds_begin_where_the_scheme_says() -> None:
    found = places("glsl:gl450", bindings=SCHEME)
    assert {name: binding for name, (_, binding) in found.items()} == {
        "View": 6, "Rig": 7, "DerivedFromFrame": 10, "Draw": 13, "DrawDerived": 14,
        "WeatherDerived": 16, "lamps": 0, "around": 3, "albedo": 4,
    }  # fmt: skip


def test_texts_say_what_the_reflection_says_and_are_accepted() -> None:
    """Of each language: with sets, first numbers, combined samplers and push constants."""
    scheme = {**SCHEME, "combined_samplers": True, "push_constants": "draw"}
    profiles = (*PROFILES, "glsl:gl450", "msl")
    (material,) = burnish.compile(TEXT, profiles, rig="Hall", bindings=scheme).materials
    texts = {(file.profile, file.stage): file.text for file in material.files}
    assert "layout(push_constant, std140) uniform Draw {" in texts["vulkan", "vertex"]
    assert (
        "layout(set = 0, binding = 10) uniform samplerCube around;" in texts["vulkan", "fragment"]
    )
    assert "cbuffer Draw : register(b3, space1) {" in texts["sm6", "vertex"]
    assert "@group(1) @binding(3) var<uniform> draw: Draw;" in texts["webgpu", "vertex"]
    backend = material.reflection.backends["glsl:vulkan"]
    assert backend.push_constants is not None
    assert (backend.push_constants.block, backend.push_constants.size) == ("Draw", 64)
    assert (backend.blocks["Draw"].group, backend.blocks["Draw"].binding) == (None, None)
    assert backend.samplers == {}
    with Toolchain() as tools:
        assert not refused(list(jobs_of(material)), tools)


MISTAKES = """\
combined = 1
push_constants = 3
combined_samplers = "yes"
kinds = 4
[sets]
material = -1
"a b" = 2
[first]
draw = 1.5
"""


def told(**more: Any) -> str:
    with pytest.raises(burnish.CompileError) as failed:
        burnish.compile(TEXT, ("wgsl", "glsl:vulkan"), rig="Hall", **more)
    return render_all(failed.value.diagnostics)


def test_all_mistakes_of_a_file_are_told(tmp_path: Path) -> None:
    file = tmp_path / "engine.toml"
    file.write_text(MISTAKES, encoding="utf-8")
    found = [line for line in told(bindings=file).splitlines() if line.startswith("error")]
    assert [line.replace(f"{file}", "engine.toml") for line in found] == [
        "error[B0708]: engine.toml: there is no `combined`: did you mean `combined_samplers`?",
        "error[B0708]: engine.toml: `push_constants` is the name of a group, as in "
        '`push_constants = "draw"`',
        "error[B0708]: engine.toml: `combined_samplers` is true or false",
        "error[B0708]: engine.toml: `kinds` is a table of numbers, as in `kinds = { block = 1 }`",
        "error[B0708]: engine.toml: `sets.material` is a whole number from 0 to 65535",
        "error[B0708]: engine.toml: `sets` has no number for `a b`: this is no name of a group",
        "error[B0708]: engine.toml: `first.draw` is a whole number from 0 to 65535",
    ]


def test_what_is_no_scheme_is_told(tmp_path: Path) -> None:
    file = tmp_path / "engine.toml"
    assert told(bindings=file).startswith(f"error[B0001]: there is no file `{file}`")
    file.write_text("sets = [", encoding="utf-8")
    assert told(bindings=file).startswith(f"error[B0708]: {file}: this is no TOML: ")
    assert told(bindings={"kinds": {"frame": 1}}).startswith(
        "error[B0708]: <bindings>: `kinds` has no number for `frame`: the kinds are block, buffer, "
        "texture, sampler"
    )
    with pytest.raises(TypeError, match="`bindings` takes a path or a mapping"):
        burnish.compile(TEXT, ("wgsl",), bindings=3)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="`bindings` takes numbers, truth values and names"):
        burnish.compile(TEXT, ("wgsl",), bindings={"sets": Path()})


def test_numbers_that_nothing_can_have_are_told() -> None:
    assert told(bindings={"first": {"view": 3, "frame": 3}}).startswith(
        "error[B0709]: `Frame` and `View` both have binding 3 of group 0 for wgsl:webgpu"
    )
    assert told(bindings={"sets": {"draw": 4}}).startswith(
        "error[B0702]: 5 bind groups of M, but wgsl:webgpu has only 4"
    )
    assert told(bindings={"first": {"material": 1000}}).startswith(
        "error[B0702]: 1001 bindings in a group of M, but wgsl:webgpu has only 1000"
    )
    many = TEXT.replace("map albedo", "param tints : vec4[9] per draw  map albedo", 1)
    many = many.replace("color = ", "color = tints[int(8 * uv.x)].rgb + ")
    with pytest.raises(burnish.CompileError) as failed:
        burnish.compile(many, ("glsl:vulkan",), rig="Hall", bindings={"push_constants": "draw"})
    assert failed.value.diagnostics[0].message == (
        "208 bytes of push constants of M, but glsl:vulkan has only 128"
    )


def test_a_scheme_that_changes_gives_another_result(tmp_path: Path) -> None:
    """Results are remembered, but not those of another content of the file."""
    file = tmp_path / "engine.toml"
    for number in (2, 3):
        file.write_text(f"[first]\nview = {number}\n", encoding="utf-8")
        assert places("wgsl:webgpu", bindings=file)["View"] == (0, number)

"""Positions that all shaders compute alike: every text says so in its language's words."""

from __future__ import annotations

import re

import pytest

import burnish
from burnish.targets.toolchain import Toolchain

from ..examples.kit import jobs_of
from ..suite.verdicts import refused
from .kit import PROFILES, Selected

PASS = "pass P : Forward { raster { invariant = %s } }\n"
PLAIN = "material M { color = vec3(uv, 0) }\n"
FINS = """
material Fins {
    height : float = 0
    expand triangle {
        strip of 3 as i like corner[i] {}
        strip of 4 as i like corner[i / 2] {
            height   = float(i mod 2)
            position = inherited.position + height * inherited.normal
        }
    }
    color = vec3(height)
}
"""
BUMPS = """
material Bumps {
    param depth : float in 0..1 = 0.1
    tessellate triangle by 4 * length(end[0].position - end[1].position) {
        position = inherited.position - depth * uv.x * inherited.normal
    }
    color = vec3(uv, 0)
}
"""
WORDS = {
    "glsl": r"^invariant gl_Position;$",
    "hlsl": r"^    precise float4 clip_position : SV_Position;$",
    "wgsl": r"^    @builtin\(position\) @invariant clip_position: vec4f,$",
    "msl": r"^    float4 clip_position \[\[position, invariant\]\];$",
}
"""The line by which each language declares an invariant position."""
SAID = re.compile(r"\b(invariant|precise)\b")


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_every_profile_says_so_of_the_stage_that_places_vertices(selected: Selected) -> None:
    def said(asked: str) -> dict[str, list[str]]:
        text = PLAIN + PASS % asked
        (material,) = burnish.compile(text, (str(selected),), pass_="P")
        return {file.stage: saying(file.text) for file in material.files}

    found = said("true")
    (line,) = found.pop("vertex")
    assert re.fullmatch(WORDS[selected.language.name], line)
    assert found == {"fragment": []}
    assert said("false") == {"vertex": [], "fragment": []}


def test_a_text_of_all_stages_says_it_once() -> None:
    (material,) = burnish.compile(PLAIN + PASS % "true", ("wgsl",), pass_="P", single_file=True)
    assert material.text("wgsl", "all").count("@invariant") == 1


def native(text: str, profile: str) -> dict[str, list[str]]:
    """The lines about invariance in the texts of a profile's native stages, by stage."""
    made = burnish.compile(text + PASS % "true", (profile,), pass_="P", native_stages=True)
    return {file.stage: saying(file.text) for file in made.materials[0].files}


def saying(text: str) -> list[str]:
    """The lines of a text that speak of what has to be the same."""
    return [line for line in text.splitlines() if SAID.search(line)]


def test_what_a_later_stage_places_vertices_by_is_the_same_as_well() -> None:
    """``height`` is computed by the geometry stage for the fragments alone."""
    assert native(FINS, "glsl") == {
        "vertex": [
            "layout(location = 0) invariant out vec3 v_position;",
            "layout(location = 1) invariant out vec3 v_normal;",
        ],
        "geometry": ["invariant gl_Position;"],
        "fragment": [],
    }
    assert native(FINS, "hlsl") == {
        "vertex": [
            "    [[vk::location(0)]] precise float3 position : TEXCOORD0;",
            "    [[vk::location(1)]] precise float3 normal : TEXCOORD1;",
        ],
        "geometry": ["    precise float4 clip_position : SV_Position;"],
        "fragment": [],
    }


def test_older_versions_want_it_of_both_ends_of_what_crosses() -> None:
    assert native(FINS, "glsl:gl330")["geometry"] == [
        "invariant in vec3 v_position[];",
        "invariant in vec3 v_normal[];",
        "invariant gl_Position;",
    ]


def test_how_finely_a_patch_is_divided_is_the_same_and_what_goes_through_that_stage() -> None:
    assert native(BUMPS, "glsl:gl450") == {
        "vertex": [
            "layout(location = 0) invariant out vec3 v_object_position;",
            "layout(location = 1) invariant out vec3 v_object_normal;",
            "layout(location = 2) invariant out vec3 v_position;",
            "layout(location = 3) invariant out vec2 v_vertex_uv;",
        ],
        "control": [
            "layout(location = 0) invariant out vec3 p_object_position[];",
            "layout(location = 1) invariant out vec3 p_object_normal[];",
            "layout(location = 3) invariant out vec2 p_vertex_uv[];",
            "invariant gl_TessLevelOuter;",
            "invariant gl_TessLevelInner;",
        ],
        "evaluation": ["invariant gl_Position;"],
        "fragment": [],
    }
    said = native(BUMPS, "hlsl")
    assert said["control"][-2:] == [
        "    precise float edge_levels[3] : SV_TessFactor;",
        "    precise float inner_levels[1] : SV_InsideTessFactor;",
    ]
    assert said["evaluation"] == ["    precise float4 clip_position : SV_Position;"]


def test_where_no_stage_makes_vertices_the_one_that_is_there_says_so() -> None:
    for text in (FINS, BUMPS):
        (material,) = burnish.compile(text + PASS % "true", ("glsl:es300",), pass_="P")
        assert saying(material.text("glsl:es300", "vertex")) == ["invariant gl_Position;"]


@pytest.mark.parametrize("native_stages", [False, True])
def test_downstream_compilers_take_it(native_stages: bool) -> None:
    profiles = [str(selected) for selected in PROFILES]
    made = (
        burnish.compile(
            text + PASS % "true", profiles, pass_="P", native_stages=native_stages, partial=True
        ).materials[0]
        for text in (PLAIN, FINS, BUMPS)
    )
    with Toolchain() as toolchain:
        found = refused([job for material in made for job in jobs_of(material)], toolchain)
    assert not found, "\n".join(each.report() for each in found)


def test_the_reflection_tells_hosts() -> None:
    for asked in ("true", "false"):
        (material,) = burnish.compile(PLAIN + PASS % asked, ("wgsl",), pass_="P")
        assert material.reflection.invariant_position == (asked == "true")

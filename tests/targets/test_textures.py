"""The reads of textures in each profile, and the errors of profiles that cannot do them."""

from __future__ import annotations

import re

import pytest

import burnish
from burnish.compiler.diagnostics.render import render_all

MAPS = "map t : texture2d  map d : depth2d  map a : texture2d_array  map u : utexture2d"
BOTH = "vec3(d(uv, 0.5) * d.load(ivec2(0)))"
"""Compares with a texture and loads from it."""
LACKING = {
    "t.gather(uv, 0).rgb": "error[B0701]: glsl:es300 has no gathering of texels",
    "d.gather(uv, 0.5).rgb": "error[B0701]: glsl:es300 has no gathering of comparisons",
    "vec3(float(t.levels()))": "error[B0701]: glsl:es300 has no way to tell how many levels",
    "t.load(ivec2(0), 3).rgb": "error[B0701]: glsl:es300 has no way to tell how many levels",
    BOTH:
        "error[B0701]: glsl:es300 has no texture that is both compared and loaded",
}  # fmt: skip


def text(color: str, profile: str) -> str:
    source = f"material M {{ {MAPS} param n : int = 0  color = {color} }}"
    return burnish.compile(source, (profile,))["M"].text(profile, "fragment")


@pytest.mark.parametrize(("color", "told"), LACKING.items())
def test_what_a_profile_lacks_is_told_where_it_is_wanted(color: str, told: str) -> None:
    with pytest.raises(burnish.CompileError) as caught:
        text(color, "glsl:es300")
    shown = render_all(caught.value.diagnostics)
    assert shown.startswith(told)
    assert " ^^^" in shown and "help: " in shown
    assert text(color, "glsl:vulkan")


@pytest.mark.parametrize("profile", ["glsl:gl450", "glsl:es310"])
@pytest.mark.parametrize("color", LACKING)
def test_newer_profiles_lack_less(color: str, profile: str) -> None:
    counts_levels = ".levels()" in color or ".load(ivec2(0), 3)" in color
    if color == BOTH or (counts_levels and profile == "glsl:es310"):
        with pytest.raises(burnish.CompileError, match=f"{profile} has no"):
            text(color, profile)
    else:
        assert text(color, profile)


def test_a_profile_may_lack_what_is_not_wanted_of_it() -> None:
    assert "texelFetch(t, ivec2(0), 0)" in text("t.load(ivec2(0)).rgb", "glsl:es300")
    assert "texelFetch(d, ivec2(0), 0).x" in text("vec3(d.load(ivec2(0)))", "glsl:gl330")


def test_places_in_doubt_are_kept_inside() -> None:
    kept = text("t.load(ivec2(n)).rgb", "wgsl")
    assert "textureLoad(t, clamp(vec2i(material.n), vec2i(0)," in kept
    assert "clamp" not in text("t.load(ivec2(0)).rgb", "wgsl")


def test_references_in_doubt_are_kept_to_depths() -> None:
    assert "saturate(input.uv.x)" in text("vec3(d(uv, uv.x))", "wgsl")
    assert "saturate" not in text("vec3(d(uv, 0.5))", "wgsl")


def test_a_texture_that_is_only_loaded_has_no_sampler() -> None:
    loaded = "t.load(ivec2(0)).rgb + vec3(float(u.load(ivec2(0)).r))"
    assert "sampler" not in text(loaded, "wgsl").lower()
    assert "SamplerState" not in text(loaded, "hlsl")
    assert "uniform sampler " not in text(loaded, "glsl:vulkan")


def test_a_depth_texture_that_is_only_loaded_is_no_shadow_sampler() -> None:
    assert "uniform sampler2D d;" in text("vec3(d.load(ivec2(0)))", "glsl:es300")
    assert "uniform sampler2DShadow d;" in text("vec3(d(uv, 0.5))", "glsl:es300")


def test_es_has_a_precision_for_every_type_of_sampler() -> None:
    written = text(
        "t(uv).rgb * d(uv, 0.5) * a(uv, n).rgb * float(u.load(ivec2(0)).r)", "glsl:es300"
    )
    declared = set(re.findall(r"^uniform (\w+) ", written, re.MULTILINE))
    assert declared == set(re.findall(r"^precision highp (\w*sampler\w+);", written, re.MULTILINE))


def test_the_extension_for_texels_is_asked_for_where_it_is_needed() -> None:
    extension = "#extension GL_EXT_samplerless_texture_functions : require\n"
    assert f"#version 450\n{extension}" in text("t.load(ivec2(0)).rgb", "glsl:vulkan")
    assert extension not in text("t(uv).rgb", "glsl:vulkan")

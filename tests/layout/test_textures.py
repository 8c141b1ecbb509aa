"""The reflection's description of textures, in the words of WebGPU's layouts."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.documents.reading import read
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.documents.writing import to_json

LAYOUTS = {
    ("texture2d", "t(uv).rgb"): ("2d", "float", "filtering"),
    ("texture2d_array", "t(uv, 1).rgb"): ("2d-array", "float", "filtering"),
    ("texture3d", "t(position).rgb"): ("3d", "float", "filtering"),
    ("texture_cube", "t(normal).rgb"): ("cube", "float", "filtering"),
    ("texture2d", "t.load(ivec2(0)).rgb"): ("2d", "unfilterable-float", None),
    ("depth2d", "vec3(t(uv, 0.5))"): ("2d", "depth", "comparison"),
    ("depth_cube", "vec3(t(normal, 0.5))"): ("cube", "depth", "comparison"),
    ("depth2d_array", "vec3(t.load(ivec2(0), 1))"): ("2d-array", "depth", None),
    ("itexture2d", "vec3(float(t.load(ivec2(0)).r))"): ("2d", "sint", None),
    ("utexture3d", "vec3(float(t.load(ivec3(0)).r))"): ("3d", "uint", None),
}


def reflection(type_: str, color: str, state: str = "") -> Reflection:
    source = f"material M {{ map t : {type_} {state} color = {color} }}"
    found = burnish.compile(source, ("wgsl", "glsl:es300"))["M"].reflection
    assert read(Reflection, to_json(found)) == found
    return found


@pytest.mark.parametrize(("given", "expected"), LAYOUTS.items(), ids=str)
def test_a_layout_says_how_a_texture_is_read(
    given: tuple[str, str], expected: tuple[str, str, str | None]
) -> None:
    found = reflection(*given)
    (row,) = found.textures
    layout = row.layout
    assert (layout.view_dimension, layout.sample_type, layout.sampler) == expected
    assert row.type == given[0]
    samplers = ["t"] if expected[2] else []
    assert [row.texture for row in found.samplers] == samplers
    assert list(found.backends["wgsl:webgpu"].samplers) == samplers


def test_what_nothing_mixes_may_have_a_format_that_cannot_be_mixed() -> None:
    nearest = reflection("texture2d", "t(uv).rgb", "with { filter = nearest, mip = none }")
    (row,) = nearest.textures
    assert to_json(row.layout) == {
        "viewDimension": "2d", "sampleType": "unfilterable-float", "sampler": "non-filtering",
    }  # fmt: skip


STATES = {
    "texture2d": {"filter": "linear", "mip": "linear", "wrap": "repeat", "compare": None},
    "texture_cube": {"filter": "linear", "mip": "linear", "wrap": "clamp", "compare": None},
    "depth2d": {"filter": "linear", "mip": "none", "wrap": "clamp", "compare": "less_equal"},
}
DEFAULTS = {"texture_cube": "white", "depth_cube": "far", "utexture2d": "zero"}


@pytest.mark.parametrize(("type_", "state"), STATES.items())
def test_the_state_of_a_sampler_is_complete(type_: str, state: dict[str, str]) -> None:
    (row,) = reflection(type_, "vec3(0)").samplers
    assert to_json(row.state) == state


@pytest.mark.parametrize(("type_", "default"), DEFAULTS.items())
def test_every_kind_of_texture_has_a_default(type_: str, default: str) -> None:
    assert reflection(type_, "vec3(0)").textures[0].default == default

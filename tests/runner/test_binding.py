"""A reflection becomes a pipeline: names, places, formats and states."""

from __future__ import annotations

from typing import Any, get_args

import pytest

import burnish
from burnish.api.entry_points import CompiledMaterial
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.ir.formats import VERTEX_FORMATS, VertexFormat
from burnish.compiler.semantics.shading.passes.formats import FORMATS as TARGET_FORMATS
from burnish.targets.runner.binding import FORMATS, pipeline
from burnish.targets.runner.codes import Codes
from burnish.targets.runner.drivers.pipeline import Code, VertexInput
from burnish.targets.runner.drivers.render_state import RenderTarget, TargetFormat
from burnish.targets.runner.drivers.slots import BlockSlot, Place, TextureSlot
from burnish.targets.runner.exact import Exact, exact_format
from burnish.targets.runner.routes import ROUTES

from .blends import named

CODES = Codes({"vertex": Code("vs", text="vertex"), "fragment": Code("fs", text="fragment")})
PROFILES = sorted({route.profile for route in ROUTES.values()})

TEXT = """
material Painted {
    attribute shade : vec4
    attribute place : vec2
    param gain : float = 1
    map albedo : texture2d = white with { filter = nearest, wrap = mirror }
    uv = place
    value = vec4(shade.rgb * gain, frag_coord.y)
}

pass Both : Forward blend add {
    target color : r16f = albedo(uv).r
    target more : rgba8_srgb = value
}

pass Fronts : Both {
    raster { cull = back }
    depth { compare = less_equal, write = false }
}
"""


def compiled(text: str, pass_: str | None, **options: Any) -> CompiledMaterial:
    (material,) = burnish.compile(text, PROFILES, pass_=pass_, **options).materials
    return material


def reflection(text: str = TEXT, pass_: str | None = "Both", **options: Any) -> Reflection:
    return compiled(text, pass_, **options).reflection


def test_every_table_is_whole() -> None:
    assert FORMATS.keys() == TARGET_FORMATS.keys()
    assert set(FORMATS.values()) <= set(get_args(TargetFormat))
    for name, type_ in TARGET_FORMATS.items():
        exact = exact_format(name)
        assert exact.endswith("32f")
        assert TARGET_FORMATS[exact] == type_
    assert set(VERTEX_FORMATS.values()) == set(get_args(VertexFormat))


def test_where_places_are_numbers() -> None:
    apart = TEXT.replace("= value\n", "= value blend alpha\n")
    found = reflection(apart, partial=True)  # Not every profile blends targets differently.
    made = pipeline(found, ROUTES["lavapipe:hlsl-dxc"], CODES)
    assert made.stages == CODES.stages
    assert {(each.identifier, each.format) for each in made.inputs} >= {
        ("shade", "float32x4"),
        ("place", "float32x2"),
        ("vertex_position", "float32x3"),
    }
    assert len({each.location for each in made.inputs}) == len(made.inputs)
    assert BlockSlot(Place("Material", 2, 0), 16) in made.blocks
    assert made.textures == (
        TextureSlot(
            Place("albedo", 2, 5), Place("albedo_sampler", 2, 6), "nearest", "linear", "mirror"
        ),
    )
    assert made.targets == (
        RenderTarget("r16float", named("add")),
        RenderTarget("rgba8unorm-srgb", named("alpha")),
    )
    assert (made.cull, made.front_face, made.first_row) == ("none", "ccw", "top")
    assert (made.depth.compare, made.depth.write) == ("less", True)
    assert made.host_uniforms == ()


def test_where_places_are_names() -> None:
    made = pipeline(reflection(pass_="Fronts"), ROUTES["llvmpipe:gl330"], CODES)
    assert BlockSlot(Place("Material", None, None), 16) in made.blocks
    (texture,) = made.textures
    assert (texture.texture, texture.sampler) == (Place("albedo", None, None), None)
    assert (made.cull, made.first_row) == ("back", "bottom")
    assert (made.depth.compare, made.depth.write) == ("less_equal", False)
    assert made.host_uniforms == ("viewport_height",)


def test_where_places_are_numbers_without_groups() -> None:
    """Each kind is numbered on its own, and a texture has its sampler with it."""
    made = pipeline(reflection(), ROUTES["llvmpipe:gl450"], CODES)
    assert [slot.place.binding for slot in made.blocks] == [1, 3, 8]
    (texture,) = made.textures
    assert (texture.texture, texture.sampler) == (Place("albedo", 0, 0), None)
    assert made.host_uniforms == ()
    assert made.clip_control == ("GL_UPPER_LEFT", "GL_ZERO_TO_ONE")
    assert pipeline(reflection(), ROUTES["llvmpipe:es310"], CODES).clip_control == ()


@pytest.mark.parametrize(
    ("route", "front_face", "first_row"),
    [
        ("llvmpipe:gl330", "cw", "top"),
        ("llvmpipe:gl450", "cw", "bottom"),
        ("llvmpipe:es310", "cw", "top"),
        ("chromium:webgl2", "cw", "top"),
        ("chromium:webgpu", "cw", "bottom"),
        ("lavapipe:wgsl-naga", "ccw", "top"),
        ("lavapipe:hlsl-dxc", "ccw", "top"),
        ("swiftshader:glsl", "ccw", "top"),
    ],
)
def test_a_flipped_material(route: str, front_face: str, first_row: str) -> None:
    made = pipeline(reflection(flip_y=True), ROUTES[route], CODES)
    assert (made.flip_y, made.front_face, made.first_row) == (True, front_face, first_row)


def test_what_hosts_of_flipped_texts_are_told() -> None:
    backends = reflection(flip_y=True).backends
    assert {name: (row.front_face, row.first_row) for name, row in backends.items()} == {
        "glsl:vulkan": ("ccw", "top"),
        "glsl:gl330": ("cw", "top"),
        "glsl:gl450": ("cw", "bottom"),
        "glsl:es300": ("cw", "top"),
        "glsl:es310": ("cw", "top"),
        "hlsl:sm6": ("cw", "bottom"),
        "wgsl:webgpu": ("cw", "bottom"),
    }


@pytest.mark.parametrize("route", ROUTES.values(), ids=lambda route: route.name)
def test_exact_targets_keep_what_is_written(route: Any) -> None:
    described = Exact.of(compiled(TEXT, "Both")).reflection
    made = pipeline(described, route, CODES)
    assert made.targets == (RenderTarget("r32float"), RenderTarget("rgba32float"))
    assert [slot.size for slot in made.blocks] == [row.size for row in described.blocks]
    identifiers = [slot.place.identifier for slot in made.blocks]
    assert identifiers == [
        described.backends[route.profile].blocks[row.name].identifier for row in described.blocks
    ]


def test_names_that_a_language_reserves() -> None:
    text = (
        "material Odd {\n attribute sample : uint\n attribute float4 : ivec2\n"
        " color = vec3(float(sample) * float(float4.x))\n}"
    )
    described = reflection(text, None)
    rows = {route: pipeline(described, ROUTES[route], CODES).inputs for route in ROUTES}
    (number,) = {row.location for row in described.vertex_inputs if row.name == "sample"}
    assert number is not None
    assert VertexInput("sample", number, "uint32") not in rows["lavapipe:hlsl-dxc"]
    assert VertexInput("sample", number, "uint32") in rows["lavapipe:wgsl-naga"]


def test_a_profile_that_was_not_compiled() -> None:
    (material,) = burnish.compile(TEXT, "wgsl").materials
    with pytest.raises(KeyError, match="glsl:vulkan"):
        pipeline(material.reflection, ROUTES["lavapipe:glsl"], CODES)


def test_a_texture_that_no_stage_reads_has_no_slot() -> None:
    made = pipeline(reflection(pass_="Forward"), ROUTES["lavapipe:glsl"], CODES)
    assert made.textures == ()

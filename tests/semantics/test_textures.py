"""Reads of textures: which builtin each is, and in which order its operands stand."""

from __future__ import annotations

import pytest

from burnish.compiler.ir.node import Node, reachable
from burnish.compiler.ir.stages import CLIP_POSITION, TARGET
from burnish.compiler.ir.types import TextureType

from .kit import shader

MAPS = """
    map colors  : texture2d
    map sheets  : texture2d_array
    map volume  : texture3d
    map sky     : texture_cube
    map depths  : depth2d
    map cascade : depth2d_array
    map around  : depth_cube
    map probes  : texture_cube_array
    map lamps   : depth_cube_array
    map codes   : utexture2d
    map signed  : itexture3d
    param n : int = 1
"""
READS = {
    "colors(uv)": "sample texture2d vec2 -> vec4",
    "sheets(uv, n)": "sample texture2d_array vec2 int -> vec4",
    "volume(position)": "sample texture3d vec3 -> vec4",
    "sky(normal)": "sample texture_cube vec3 -> vec4",
    "colors.bias(uv, 2)": "sample_bias texture2d vec2 float -> vec4",
    "sheets.bias(uv, n, 0.5)": "sample_bias texture2d_array vec2 int float -> vec4",
    "sky.bias(normal, -1)": "sample_bias texture_cube vec3 float -> vec4",
    "colors.level(uv, 2)": "sample_level texture2d vec2 float -> vec4",
    "sheets.level(uv, n, 0.5)": "sample_level texture2d_array vec2 int float -> vec4",
    "sky.grad(normal, position, normal)": "sample_grad texture_cube vec3 vec3 vec3 -> vec4",
    "colors.gather(uv, 3)": "gather texture2d vec2 int -> vec4",
    "depths(uv, 0.5)": "compare depth2d vec2 float -> float",
    "cascade(uv, n, 0.5)": "compare depth2d_array vec2 int float -> float",
    "around(normal, 1)": "compare depth_cube vec3 float -> float",
    "depths.gather(uv, 0.5)": "gather_compare depth2d vec2 float -> vec4",
    "codes.load(ivec2(n), 2)": "load utexture2d ivec2 int -> uvec4",
    "codes.load(ivec2(n))": "load utexture2d ivec2 int -> uvec4",
    "signed.load(ivec3(n))": "load itexture3d ivec3 int -> ivec4",
    "sheets.load(ivec2(n), 3, 0)": "load texture2d_array ivec2 int int -> vec4",
    "depths.load(ivec2(n))": "load depth2d ivec2 int -> float",
    "volume.size()": "texture_size texture3d int -> ivec3",
    "sky.size(n)": "texture_size texture_cube int -> ivec2",
    "cascade.layers()": "texture_layers depth2d_array -> int",
    "probes(normal, n)": "sample texture_cube_array vec3 int -> vec4",
    "probes.bias(normal, n, 1)": "sample_bias texture_cube_array vec3 int float -> vec4",
    "probes.level(normal, n, 1)": "sample_level texture_cube_array vec3 int float -> vec4",
    "probes.grad(eye, n, eye, eye)": "sample_grad texture_cube_array vec3 int vec3 vec3 -> vec4",
    "probes.gather(normal, n, 3)": "gather texture_cube_array vec3 int int -> vec4",
    "lamps(normal, n, 1)": "compare depth_cube_array vec3 int float -> float",
    "probes.size(n)": "texture_size texture_cube_array int -> ivec2",
    "probes.layers()": "texture_layers texture_cube_array -> int",
    "lamps.layers()": "texture_layers depth_cube_array -> int",
    "codes.levels()": "texture_levels utexture2d -> int",
}
LANES = {"vec4": "{}.xyz", "float": "vec3({})", "int": "vec3(float({}))"}
INTEGERS = {"ivec2": "{}.x", "ivec3": "{}.x", "ivec4": "{}.x", "uvec4": "{}.x"}


def reads(expression: str, type_: str = "vec4", more: str = "") -> list[Node]:
    """The reads in a material whose colour is an expression."""
    form = LANES.get(type_) or f"vec3(float({INTEGERS[type_]}))"
    text = f"material M {{ {MAPS} {more} color = {form.format(expression)} }}"
    nodes = reachable(result.value for result in shader(text).results_of(TARGET))
    return [node for node in nodes if any(isinstance(o.type, TextureType) for o in node.operands)]


@pytest.mark.parametrize(("expression", "expected"), READS.items())
def test_each_read_is_a_builtin(expression: str, expected: str) -> None:
    (node,) = reads(expression, expected.rsplit(maxsplit=1)[-1])
    operands = " ".join(str(operand.type) for operand in node.operands)
    assert f"{node.data} {operands} -> {node.type}" == expected


def test_a_level_that_is_left_out_is_the_first() -> None:
    (node,) = reads("codes.load(ivec2(n))", "uvec4")
    assert node.operands[-1].data == 0


def test_a_texture_is_read_through_a_function() -> None:
    text = f"""
    fn twice<T: textures>(t: T, p: vec2) = t.level(p, 1) + t.level(p, 2)
    material M {{ {MAPS} color = twice(colors, uv).rgb }}"""
    nodes = reachable(result.value for result in shader(text).results_of(TARGET))
    assert [node.data for node in nodes if node.op == "call"].count("sample_level") == 2


def test_a_texture_of_the_base_is_read_by_its_methods() -> None:
    text = f"""
    abstract material B {{ {MAPS} }}
    material M : B {{ color = inherited.colors.level(uv, 1).rgb }}"""
    assert "sample_level" in [
        node.data for node in reachable(result.value for result in shader(text).results_of(TARGET))
    ]


def test_a_read_that_names_its_level_moves_vertices() -> None:
    given = shader("""
    material M {
        map heights : texture2d
        position = @vertex (inherited.position + heights.level(uv, 0).rgb)
    }""")
    (position,) = given.results_of(CLIP_POSITION)
    assert "sample_level" in [node.data for node in reachable([position.value])]

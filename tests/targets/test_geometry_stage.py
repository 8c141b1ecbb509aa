"""The texts of geometry stages, and what is said where one is not there or cannot do enough.

``BURNISH_UPDATE_GOLDEN=1`` writes the texts anew.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.diagnostics.render import render
from burnish.compiler.documents.writing import to_json
from burnish.targets.toolchain import Toolchain

from ..examples.kit import jobs_of
from ..golden import assert_golden
from ..suite.verdicts import remarks

GOLDEN = Path(__file__).parent / "golden" / "geometry"
PROFILES = ("glsl:vulkan", "glsl:gl330", "glsl:gl450", "hlsl:sm6")

TENT = """
/// A roof over each triangle, walls around it, and a flag on every third one.
material Tent {
    param walls : int in 0..3 = 2
    param wind  : float in 0..1 = 0.5
    attribute shift : vec3 per instance
    part : int = 0

    expand triangle {
        list of 3 as i { position = corner[i].position + corner[i].normal + shift }
        strip of 4 as i for wall in 0..walls like corner[(wall + i mod 2) mod 3] {
            part     = 1
            position = inherited.position + float(i / 2) * inherited.normal
        }
        strip of 3 as i where primitive_index mod 3 == 0u {
            part = 2
            position = corner[0].position + wind * vec3(float(i mod 2), float(i), 0)
        }
    }
    color = vec3(uv, float(part))
}
"""
MANY = """
material Many {
    param count : int in 0..80 = 3
    expand triangle {
        strip of 4 as i for s in 0..count like corner[i mod 3] { uv = vec2(float(s)) }
    }
    color = vec3(uv, 0)
}
"""
WIDE = """
material Wide {
    expand triangle_adjacency {
        strip of 4 as i for s in 0..3 like corner[(2 * s + i) mod 6] {}
    }
    color = vec3(uv, 0) * normal
}
"""
ALIKE = """
material Alike {
    param weights : float[20]
    expand triangle {
        strip of 3 as i
            where (sum k in 0..20 : corner[0].uv.x * weights[k] * sin(corner[0].uv.y)) > 0.5 {}
        strip of 3 as i
            where (sum k in 0..20 : corner[1].uv.x * weights[k] * sin(corner[0].uv.y)) > 0.5 {}
        strip of 3 as i { position = -inherited.position }
        strip of 3 as i { position = -2 * inherited.position }
    }
    color = vec3(1)
}
"""
"""Groups with conditions that take statements, and all with the same names."""


SHARED = """
/// Fins on some triangles, and some more on all.
material Shared : Surface {
    param fins : int in 0..4 = 2
    expand triangle {
        strip of 3 as i where dot(corner[0].normal, corner[1].normal) > 0 {}
        strip of 3 as i for fin in 0..fins where dot(corner[0].normal, corner[1].normal) > 0 {
            position = corner[i].position
                + float(i + fin) * cross(corner[0].normal, corner[1].normal)
        }
        strip of 3 as i for fin in 0..2 where dot(corner[0].normal, corner[1].normal) > 0 {
            position = corner[i].position
                - float(i + fin) * cross(corner[0].normal, corner[1].normal)
        }
    }
}
"""
"""Groups that share a condition, and vertices that share a value."""


@pytest.mark.parametrize("text", [TENT, SHARED], ids=["tent", "shared"])
@pytest.mark.parametrize("profile", PROFILES)
def test_texts(profile: str, text: str) -> None:
    (material,) = burnish.compile(text, profile, native_stages=True).materials
    assert [file.stage for file in material.files] == ["vertex", "geometry", "fragment"]
    for file in material.files:
        assert_golden(file.text, GOLDEN / file.name)


@pytest.mark.parametrize("flip_y", [False, True])
@pytest.mark.parametrize("text", [TENT, SHARED], ids=["tent", "shared"])
@pytest.mark.parametrize("profile", PROFILES)
def test_compilers_accept_them(profile: str, text: str, flip_y: bool) -> None:
    (material,) = burnish.compile(text, profile, native_stages=True, flip_y=flip_y).materials
    assert complaints(material) == []


@pytest.mark.parametrize("profile", PROFILES)
def test_groups_may_use_the_same_names(profile: str) -> None:
    """The groups follow one another in one function, and compilers remark nothing."""
    (material,) = burnish.compile(ALIKE, profile, native_stages=True).materials
    assert complaints(material) == []


def complaints(material: CompiledMaterial) -> list[str]:
    """The logs of compilers about the texts that they refuse or remark on."""
    with Toolchain() as toolchain:
        return [each.log for each in remarks([*jobs_of(material)], toolchain)]


@pytest.mark.parametrize("profile", PROFILES)
def test_strips_that_are_never_there_are_left_out(profile: str) -> None:
    text = """material M {
        expand point {
            strip of 3 as i where false { uv = vec2(float(i)) }
            strip of 4 where 2 < 1 {}
        }
        color = vec3(uv, 0)
    }"""
    (material,) = burnish.compile(text, profile, native_stages=True).materials
    assert material.text(profile, "geometry").count("for (") == 1
    assert complaints(material) == []


def test_every_line_has_its_place_in_the_source() -> None:
    (material,) = burnish.compile(TENT, "glsl:vulkan", native_stages=True).materials
    geometry = next(file for file in material.files if file.stage == "geometry")
    number = geometry.text.split("\n").index("        EndPrimitive();") + 1
    assert number in geometry.spans


def test_the_reflection_says_that_the_stage_is_there() -> None:
    (material,) = burnish.compile(TENT, "glsl:vulkan", native_stages=True).materials
    assert to_json(material.reflection.draw) == {
        "primitive": "triangle", "corners": 3, "expanded_by": "geometry", "vertices": 18,
        "topology": "triangle-list", "tessellation": None, "layers": None,
    }  # fmt: skip
    rows = material.reflection.vertex_inputs
    assert {(row.name, row.step, row.mesh) for row in rows} == {
        ("vertex_position", "vertex", None), ("vertex_normal", "vertex", None),
        ("vertex_uv", "vertex", None), ("shift", "instance", None),
    }  # fmt: skip


def told(text: str, profile: str, *, native_stages: bool) -> list[str]:
    """The errors about a material that cannot be compiled for a profile."""
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(text, profile, native_stages=native_stages)
    return [render(found) for found in caught.value.diagnostics]


@pytest.mark.parametrize("profile", ["wgsl:webgpu", "glsl:es300", "msl:metal2"])
def test_a_profile_without_the_stage(profile: str) -> None:
    assert told(TENT, profile, native_stages=True) == [
        f"""error[B0701]: {profile} has no geometry stage
 --> <text>:9:12
  |
9 |     expand triangle {{
  |            ^^^^^^^^
  = help: without `--native-stages`, each primitive is drawn as an instance"""
    ]
    burnish.compile(TENT, profile)


def test_more_than_the_stage_can_emit() -> None:
    assert told(MANY, "glsl:gl330", native_stages=True) == [
        f"""error[B0702]: {count} of Many, but glsl:gl330 has only {limit}
 --> <text>:4:12
  |
4 |     expand triangle {{
  |            ^^^^^^^^
  = help: without `--native-stages`, each primitive is drawn as an instance"""
        for count, limit in (
            ("320 vertices of one primitive", 256),
            ("1920 numbers at the vertices of one primitive", 1024),
        )
    ]
    burnish.compile(MANY, "glsl:gl330")


def test_more_inputs_than_there_are() -> None:
    assert told(WIDE, "glsl:es300", native_stages=False) == [
        """error[B0702]: 18 vertex inputs of Wide, but glsl:es300 has only 16
 --> <text>:3:12
  |
3 |     expand triangle_adjacency {
  |            ^^^^^^^^^^^^^^^^^^
  = help: each corner that is read has inputs of its own, unless the vertex stage reads storage buffers: read fewer slots by corner, or compile for a profile that has these, or with `--native-stages` for one that has the stage"""  # noqa: E501
    ]
    (drawn,) = burnish.compile(WIDE, "wgsl").materials
    (buffer,) = drawn.reflection.buffers
    assert (buffer.name, buffer.stages) == ("mesh", ("vertex",))
    assert len(drawn.reflection.vertex_inputs) == 18
    rows = drawn.reflection.vertex_inputs
    assert {row.buffer and row.buffer.name for row in rows} == {"mesh"}
    burnish.compile(WIDE, PROFILES, native_stages=True)

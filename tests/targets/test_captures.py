"""The texts of passes that capture, and what the reflection tells a host of them."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.diagnostics.render import render
from burnish.compiler.documents.drawing import InBuffer
from burnish.compiler.documents.writing import to_json
from burnish.targets.toolchain import Toolchain

from ..examples.kit import jobs_of
from ..golden import assert_golden
from ..suite.verdicts import refused

GOLDEN = Path(__file__).parent / "golden" / "captures"

SPARKS = """
/// Every spark that is young enough becomes two.
material Sparks {
    param wind : vec3 = vec3(0.1, 0, 0)
    attribute age : float

    older : float = @vertex (age + 0.1)

    expand point {
        points of 2 as i where corner[0].older < 1 {
            position = inherited.position + wind * float(i)
            older    = 0.5 * inherited.older
        }
    }
    color = vec3(1)
}

/// A step in the life of sparks.
pass Step {
    capture position : vec3 = position      /// In world space
    capture age      : float = older
    capture mark     : uint = primitive_index
}
"""
PLAIN = """
material Plain { color = vec3(1) }
pass Step { capture number : int = int(vertex_index)  capture place : vec2 = uv }
"""


def compiled(text: str, profile: str) -> CompiledMaterial:
    (material,) = burnish.compile(text, profile, pass_="Step", native_stages=True).materials
    return material


@pytest.mark.parametrize("profile", ["glsl:vulkan", "glsl:gl330", "hlsl:sm6"])
def test_texts_of_points(profile: str) -> None:
    material = compiled(SPARKS, profile)
    assert [file.stage for file in material.files] == ["vertex", "geometry"]
    assert_golden(material.text(profile, "geometry"), GOLDEN / material.files[1].name)


@pytest.mark.parametrize("profile", ["glsl:gl450", "hlsl:sm6"])
def test_texts_of_vertices(profile: str) -> None:
    material = compiled(PLAIN, profile)
    assert [file.stage for file in material.files] == ["vertex"]
    assert_golden(material.text(profile, "vertex"), GOLDEN / material.files[0].name)


@pytest.mark.parametrize("profile", ["wgsl:webgpu", "hlsl:sm6"])
def test_texts_of_kernels(profile: str) -> None:
    (material,) = burnish.compile(SPARKS, profile, pass_="Step").materials
    assert [file.stage for file in material.files] == ["compute"]
    assert_golden(material.text(profile, "compute"), GOLDEN / material.files[0].name)


@pytest.mark.parametrize("captured", ["place : vec2 = uv", "number : uint = vertex_index"])
def test_kernels_hand_on_what_stands_nowhere(captured: str) -> None:
    """Values that are read from the mesh, or counted, have no equation to refer to."""
    text = f"material Plain {{ color = vec3(1) }} pass Step {{ capture {captured} }}"
    (material,) = burnish.compile(text, "wgsl", pass_="Step").materials
    (file,) = material.files
    assert "captured[" in file.text


def test_what_a_kernel_reads_and_writes_is_told() -> None:
    (material,) = burnish.compile(SPARKS, "wgsl:webgpu", pass_="Step").materials
    reflection = material.reflection
    capture = reflection.capture
    assert capture is not None
    assert (capture.buffer, capture.there, capture.stride) == ("captured", 20, 20)
    assert [row.stride for row in reflection.results] == [24]
    assert {row.name: row.buffer for row in reflection.vertex_inputs} == {
        "corner0.vertex_position": InBuffer(name="mesh", member="corner0_vertex_position"),
        "corner0.age": InBuffer(name="mesh", member="corner0_age"),
    }
    assert reflection.draw.primitive == "point"


def test_names_that_the_material_has_are_left_to_it() -> None:
    text = """
    struct MeshVertex { a : float }
    material M { param mesh : MeshVertex  buffer captured : float[]
        color = vec3(mesh.a, captured[0], 1) }
    pass Step { capture tint : vec3 = color * uv.x }
    """
    (material,) = burnish.compile(text, "glsl:vulkan", pass_="Step").materials
    assert "MeshVertex_ mesh_[]" in material.text("glsl:vulkan", "compute")
    assert "uint captured_[]" in material.text("glsl:vulkan", "compute")


def test_profiles_without_kernels_say_what_would_work() -> None:
    for profile in ("glsl:es300", "glsl:gl330"):
        with pytest.raises(burnish.CompileError) as caught:
            burnish.compile(PLAIN, profile, pass_="Step")
        (found,) = caught.value.diagnostics
        assert found.message == f"{profile} has no compute stage"
        assert str(found.hint).startswith("compile with `--native-stages`")


def test_numbers_of_vertices_are_not_captured_in_es() -> None:
    with pytest.raises(burnish.CompileError) as caught:
        compiled(PLAIN, "glsl:es300")
    (found,) = caught.value.diagnostics
    assert found.message == "glsl:es300 has no `vertex_index` where vertices are captured"
    assert found.span is not None and "vertex_index" in found.span.text


def test_compilers_accept_them() -> None:
    """This holds also for a single capture, which is returned as it is in HLSL."""
    single = "material M { color = vec3(1) } pass Step { capture place : vec3 = position }"
    jobs = [
        job
        for text in (SPARKS, PLAIN, single)
        for profile in ("glsl:vulkan", "hlsl:sm6", "glsl:gl330")
        for job in jobs_of(compiled(text, profile))
    ]
    with Toolchain() as toolchain:
        assert [(each.job.checker, each.log) for each in refused(jobs, toolchain)] == []


def test_the_reflection_says_where_values_lie() -> None:
    reflection = compiled(SPARKS, "hlsl:sm6").reflection
    capture = reflection.capture
    assert capture is not None
    assert (capture.topology, capture.vertices, capture.stride) == ("point", 2, 20)
    assert [tuple(row.values()) for row in to_json(capture.members)] == [
        ("position", "vec3", "vec3", 0, "In world space"),
        ("age", "float", "float", 12, ""),
        ("mark", "uint", "uint", 16, ""),
    ]
    assert reflection.targets == ()
    backend = reflection.backends["hlsl:sm6"]
    assert backend.stream_output == "semantics"
    assert [row.semantic for row in backend.captures.values()] == [
        "TEXCOORD0", "TEXCOORD1", "TEXCOORD2",
    ]  # fmt: skip


def test_names_are_told_where_the_text_does_not_place_outputs() -> None:
    backend = compiled(SPARKS, "glsl:gl330").reflection.backends["glsl:gl330"]
    assert backend.stream_output == "names"
    assert [row.identifier for row in backend.captures.values()] == [
        "v_position", "v_age", "v_mark",
    ]  # fmt: skip


def test_what_is_drawn_has_no_capture() -> None:
    (material,) = burnish.compile("material M { color = vec3(1) }", "glsl:vulkan").materials
    assert material.reflection.capture is None
    assert material.reflection.backends["glsl:vulkan"].captures == {}


def test_more_captures_than_outputs_are_told() -> None:
    members = " ".join(f"capture c{number} : float = uv.x" for number in range(17))
    text = f"material M {{ color = vec3(1) }} pass Step {{ {members} }}"
    with pytest.raises(burnish.CompileError, match="17 varyings of M, but glsl:vulkan has only 16"):
        compiled(text, "glsl:vulkan")


DIVIDED = """
material M { tessellate triangle by clamp(5 * end[0].uv.x, 1, 3) { } color = vec3(1) }
pass Step { capture place : vec3 = position }
"""


@pytest.mark.parametrize("native_stages", [True, False])
def test_of_a_patch_come_as_many_vertices_as_its_levels_allow(*, native_stages: bool) -> None:
    """A triangle that is divided by 3 everywhere is a ring of 12 triangles around one."""
    (material,) = burnish.compile(
        DIVIDED, "glsl:vulkan", pass_="Step", native_stages=native_stages
    ).materials
    reflection = material.reflection
    capture, tessellation = reflection.capture, reflection.draw.tessellation
    assert capture is not None and tessellation is not None
    assert capture.topology == "triangle"
    assert capture.vertices == 3 * 13
    assert tessellation.divided_by == ("evaluation" if native_stages else "instances")
    assert capture.there == (None if native_stages else 12)


@pytest.mark.parametrize("native_stages", [True, False])
def test_what_neither_a_stage_nor_a_kernel_captures_is_refused(*, native_stages: bool) -> None:
    """Nobody is sent from one form to the other where neither of them works."""
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(DIVIDED, "glsl:gl330", pass_="Step", native_stages=native_stages)
    (found,) = caught.value.diagnostics
    stage = "control" if native_stages else "compute"
    assert render(found).splitlines()[0] == f"error[B0701]: glsl:gl330 has no {stage} stage"
    assert found.hint == (
        "capture the control points as they are, and divide the patches where they are drawn, or "
        "compile for glsl:vulkan, glsl:gl450, glsl:es310, hlsl:sm6 or wgsl:webgpu"
    )


def test_expansions_are_captured_where_there_is_a_stage_for_them() -> None:
    for native_stages in (True, False):
        with pytest.raises(burnish.CompileError) as caught:
            burnish.compile(SPARKS, "glsl:es300", pass_="Step", native_stages=native_stages)
        (found,) = caught.value.diagnostics
        assert str(found.hint).startswith("capture the vertices of the mesh as they are, and ")
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(SPARKS, "glsl:gl330", pass_="Step")
    (found,) = caught.value.diagnostics
    assert str(found.hint).startswith("compile with `--native-stages`")

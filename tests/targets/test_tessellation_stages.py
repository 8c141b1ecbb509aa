"""The texts of the stages that divide patches.

``BURNISH_UPDATE_GOLDEN=1`` writes the texts anew. What drivers make of them is tried in
``tests/conformance/test_tessellation_stages.py``.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.diagnostics.render import render
from burnish.compiler.ir.stages import CONTROL
from burnish.targets.emit.emitter import EmitOptions
from burnish.targets.runner.kernels import UndrawableError, drawable

from ..passes.test_tessellated_graphs import divided
from .hand_made import compiled_shader
from .test_geometry_stage import complaints

GOLDEN = Path(__file__).parent / "golden" / "tessellation"
PROFILES = ("glsl:vulkan", "glsl:gl450", "hlsl:sm6")


def material(profile: str, options: EmitOptions) -> CompiledMaterial:
    """Triangles whose levels are lengths of edges, with one of them handed on to all vertices."""
    _, shader = divided()
    return compiled_shader(shader, [profile], options)


@pytest.mark.parametrize("profile", PROFILES)
def test_texts(profile: str) -> None:
    files = material(profile, EmitOptions()).files
    assert [file.stage for file in files] == ["vertex", "control", "evaluation", "fragment"]
    for file in files:
        assert_golden(file.name, file.text)


@pytest.mark.parametrize("flip_y", [False, True])
@pytest.mark.parametrize("profile", PROFILES)
def test_compilers_accept_them(profile: str, flip_y: bool) -> None:
    assert complaints(material(profile, EmitOptions(flip_y=flip_y))) == []


def test_compilers_accept_all_stages_in_one_text() -> None:
    made = material("hlsl:sm6", EmitOptions(single_file=True))
    assert [set(file.entry_points.values()) for file in made.files] == [
        {"vs_main", "hs_main", "ds_main", "fs_main"}
    ]
    assert complaints(made) == []


@pytest.mark.parametrize("profile", PROFILES)
def test_patches_may_take_nothing_of_the_mesh(profile: str) -> None:
    """In HLSL the control points are a parameter all the same, of a structure without members."""
    text = """material M {
        tessellate quad by 5 as at { position = point(vec3(at, 0)) }
        color = vec3(1)
    }"""
    (made,) = burnish.compile(text, profile, native_stages=True).materials
    assert complaints(made) == []


BLANKET = """
/// A blanket that is finer where it is wider.
material Blanket {
    param detail : float in 1..16 = 4
    /// How far the middles of the triangles rise.
    param bump : float in 0..1 = 0.25

    tessellate quad spacing fractional_odd
        by 1 + detail * abs(end[0].uv.x - end[1].uv.x)
        as at {
            position = inherited.position + bump * at.x * (1 - at.x) * inherited.normal
        }
    color = vec3(uv, 0)
}
"""


@pytest.mark.parametrize("profile", PROFILES)
def test_texts_of_a_material(profile: str) -> None:
    (found,) = burnish.compile(BLANKET, profile, native_stages=True).materials
    assert complaints(found) == []
    for file in found.files:
        if file.stage in ("control", "evaluation"):
            assert_golden(file.name, file.text)


def assert_golden(name: str, text: str) -> None:
    """Compare a text with the one that is kept."""
    path = GOLDEN / name
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    assert text == path.read_text(encoding="utf-8")


@pytest.mark.parametrize("profile", ["wgsl:webgpu", "glsl:es300", "glsl:gl330", "msl:metal2"])
def test_a_profile_without_the_stages(profile: str) -> None:
    text = "material M {\n    tessellate triangle by 3 { }\n    color = vec3(uv, 0)\n}\n"
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(text, profile, native_stages=True)
    assert [render(found) for found in caught.value.diagnostics] == [
        f"""error[B0701]: {profile} has no control stage
 --> <text>:2:16
  |
2 |     tessellate triangle by 3 {{ }}
  |                ^^^^^^^^
  = help: without `--native-stages`, each patch is drawn as an instance of a pattern"""
    ]
    burnish.compile(text, profile)


def test_what_is_handed_on_keeps_its_place() -> None:
    program = material("glsl:vulkan", EmitOptions()).staged.program
    vertex, control, evaluation, _ = program.stages
    assert control.handed_on == vertex.outputs == control.inputs
    assert set(evaluation.inputs) == {*control.handed_on, *control.outputs}
    locations = [field.location for field in evaluation.inputs]
    assert len(set(locations)) == len(locations)


LINES = "material M { tessellate isoline by 4 { } }"


@pytest.mark.parametrize(("native", "topology"), [(False, "line"), (True, "patch")])
def test_lines_are_drawn_with_the_stages_and_without(native: bool, topology: str) -> None:
    (material,) = burnish.compile(LINES, "glsl:vulkan", native_stages=native).materials
    draw = material.reflection.draw
    assert draw.tessellation is not None
    assert (draw.topology, draw.tessellation.kind) == (topology, "isoline")
    assert (CONTROL in material.shader.chain) == native


EXPANDED = """
material M {{
    tessellate triangle by {} {{ }}
    expand triangle {{ strip of 4 as i like corner[i mod 3] {{ }} }}
}}
"""


@pytest.mark.parametrize(
    ("level", "native", "vertices"),
    [
        ("4", True, 4),
        ("4", False, 6),  # For each triangle of the host's pattern.
        ("clamp(9 * end[0].uv.x, 1, 2)", True, 4),
        ("clamp(9 * end[0].uv.x, 1, 2)", False, 6 * 6),  # For each patch, of six triangles at most.
    ],
)
def test_what_a_host_draws_where_parts_of_patches_are_expanded(
    level: str, native: bool, vertices: int
) -> None:
    (made,) = burnish.compile(EXPANDED.format(level), "glsl:vulkan", native_stages=native).materials
    draw = made.reflection.draw
    assert (draw.primitive, draw.corners) == ("patch", 3)
    assert draw.topology == ("patch" if native else "triangle")
    assert draw.tessellation is not None
    assert draw.tessellation.divided_by == ("evaluation" if native else "instances")
    assert draw.expanded_by == ("geometry" if native else "instances")
    assert draw.vertices == vertices
    pattern = [
        (row.name, row.step, row.mesh.corner)
        for row in made.reflection.vertex_inputs
        if row.mesh is not None and row.mesh.is_of_pattern
    ]
    by_host = [(f"pattern.corner{k}.patch_weights", "vertex", k) for k in range(3)]
    assert pattern == ([] if native or level != "4" else by_host)


def test_native_stages_have_no_reference() -> None:
    (material,) = burnish.compile(LINES, "glsl:vulkan", native_stages=True).materials
    with pytest.raises(UndrawableError, match="M has other stages than the reference"):
        drawable(material.shader)

"""Bevy's own composer takes the shaders of materials, with Bevy's own modules, in all its passes.

That cargo takes the modules in Rust is no part of these tests, as Bevy is large:
``python -m burnish.tests.engines.bevy_suite`` checks it.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError

from ..golden import assert_golden
from .bevy import OWN, SWOLLEN, composed
from .files import EXAMPLES, files_of

GOLDEN = Path(__file__).parent / "golden"
pytestmark = pytest.mark.xdist_group("bevy")

WRITTEN = {"plastic": "Plastic", "gltf_material": "Painted", "water": "Water"}
"""Examples whose files are read: a plain one, one with a normal map and holes, one that moves."""
COMPOSED = {
    **WRITTEN, "texture_array": "Terrain", "indexed": "Indexed", "cube_map": "Shade",
    "gltf_layers": "Glass", "foliage": "Leaf", "morphing": "Soap",
}  # fmt: skip
"""Examples with textures of all kinds, with layers of a surface, with values of vertices."""


@pytest.mark.parametrize("name", list(WRITTEN))
def test_text(name: str) -> None:
    for file, text in files_of("bevy", EXAMPLES / f"{name}.burnish", WRITTEN[name]).items():
        assert_golden(text, GOLDEN / f"{file.partition('.')[0]}.bevy.{file.partition('.')[2]}")


def test_the_composer_takes_the_shaders_in_all_passes(tmp_path: Path) -> None:
    materials = {
        name: files_of("bevy", EXAMPLES / f"{name}.burnish", material)
        for name, material in COMPOSED.items()
    }
    materials["own"] = files_of("bevy", OWN, "Own")
    materials["swollen"] = files_of("bevy", SWOLLEN, "Swollen")
    wrong = dict(materials["plastic"])
    wrong["Plastic.wgsl"] = wrong["Plastic.wgsl"].replace("return base *", "return bass *")
    said = composed({**materials, "wrong": wrong}, tmp_path)
    refused = {label: text for label, text in said.items() if text}
    assert refused.keys() == {label for label in said if label.startswith("wrong, ")}
    assert all("no definition in scope for identifier: `bass`" in text for text in refused.values())
    assert {label.partition(", ")[2] for label in said if label.startswith("plastic")} == {
        "forward", "forward, skinned", "deferred", "deferred, skinned",
    }  # fmt: skip
    assert sum(label.endswith(", shadows") for label in said) > 3


def test_parameters_of_all_kinds() -> None:
    module = files_of("bevy", OWN, "Own")["Own.rs"]
    for line in (
        "    /// How well it fits. From 0 to 1.\n    pub r#match: f32,",
        "    pub mode: OwnMode,", "            mode: OwnMode::Striped,",
        "            mode: material.mode as i32,",
        "            weights: material.weights.map(Vec4::splat),",
        "            is_wet: material.is_wet.into(),",
        "            turn: Mat2::from_cols_array(&[0.0, 1.0, 1.0, 0.0]),",
        "    /// Of whole numbers. Until it is set, zero.\n",
        '    #[texture(101, sample_type = "u_int")]\n    pub grain: Handle<Image>,',
    ):  # fmt: skip
        assert line in module


@pytest.mark.parametrize(("name", "material", "said"), [
    ("tones", "Tones", "`clip_position`: its materials have nothing of that kind"),
    ("splatting", "Terrain", "`kinds`: it is a Ground[4], and Bevy has no such uniforms"),
    ("skinned", "Robot", "it reads `vertex_joints`, which Bevy lacks"),
])  # fmt: skip
def test_what_bevy_cannot_have_is_told(name: str, material: str, said: str) -> None:
    with pytest.raises(CompileError) as told:
        files_of("bevy", EXAMPLES / f"{name}.burnish", material)
    message = str(told.value)
    assert message.startswith("Bevy cannot draw `") and message.endswith(said)


def test_a_material_that_is_called_like_something_of_bevy_is_told() -> None:
    with pytest.raises(CompileError) as told:
        files_of("bevy", OWN.replace("material Own", "material Mesh"), "Mesh")
    assert str(told.value) == (
        "Bevy cannot draw `Mesh`: modules use something of Bevy or Rust that is called so"
    )


def test_a_vertex_is_moved_by_what_the_mesh_has() -> None:
    shader = files_of("bevy", SWOLLEN, "Swollen")["Swollen.wgsl"]
    moved = shader.partition("    var world_position")[2].partition("    out.world_position")[0]
    lines = map(str.strip, moved.splitlines())
    assert [line for line in lines if "given." in line] == [
        "out.object_normal = given.normal;",
        "out.object_position = given.position;",
        "vertex.position = swollen_object_position(given.position, given.normal, parameters.by);",
        "vertex.normal = swollen_object_normal(given.position, given.normal, parameters.by);",
    ]


BENT = """\
import std.motion.{MeshPoint}
material Bent {
    rest = inherited.object_shape
    object_shape = MeshPoint(-rest.position, -rest.normal, rest.tangent, rest.handedness, mat4(1))
    tint = abs(normal)
}
"""


def test_a_skin_of_bevy_moves_what_the_material_bends(tmp_path: Path) -> None:
    """The object's transform is that of the vertex, which the bones make where there are any."""
    files = files_of("bevy", BENT, "Bent")
    lines = [line.strip() for line in files["Bent.wgsl"].splitlines()]
    skinned = lines.index("let world_from_local = skinning::skin_model(")
    place = "world_position = vec4<f32>(bent_position(given.position, world_from_local), 1.0);"
    normal = next(line for line in lines if "bent_normal_2(given.normal, " in line)
    assert skinned < lines.index(place) and skinned < lines.index(normal)
    assert "bent_normal_2(given.normal, world_from_local)" in normal
    said = composed({"bent": files}, tmp_path)
    assert set(said.values()) == {""} and "bent, forward, skinned" in said

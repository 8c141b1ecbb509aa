"""What an engine cannot take is told with the slot; what moves a mesh reaches every engine."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from burnish.engines import known
from burnish.engines.slot_table import INPUTS, USUAL

from ..cli.kit import invoke

GLASS = """\
import std.models.{GltfSurface}
material Glass : GltfSurface { transmission = 0.9   ior = 1.3   clearcoat = 0.2 }
"""
PUSHED = """\
material Pushed {
    object_position = vertex_position + 0.1 * vertex_normal
    object_normal = vertex_normal + vertex_position.yzx
    tint = abs(normal)
}
"""
BENT = """\
import std.motion.{MeshPoint}
material Bent {
    rest = inherited.object_shape
    object_shape = MeshPoint(-rest.position, -rest.normal, rest.tangent, rest.handedness, mat4(1))
    rough = 0.3
}
"""


@pytest.fixture
def compiled(tmp_path: Path, request: pytest.FixtureRequest) -> str:
    """The texts that an engine gets, with what is told."""
    source, engine = request.param
    file = tmp_path / "m.burnish"
    file.write_text(source, encoding="utf-8")
    result = invoke("compile", str(file), "--engine", engine, "-o", "-")
    assert result.exit_code == 0, result.stderr
    return f"{result.stdout}\n{result.stderr}"


@pytest.mark.parametrize("compiled", [(GLASS, "godot")], indirect=True)
def test_what_an_engine_lacks_is_told(compiled: str) -> None:
    left_out = "the slot `transmission` of `Glass` is left out"
    expected = f"Burnish writes no `transmission` for Godot 4: {left_out}"
    assert f"warning[B0912]: {expected}" in compiled
    assert "writes no `ior`" in compiled and "writes no `dispersion`" not in compiled
    assert "CLEARCOAT = " in compiled and "CLEARCOAT_ROUGHNESS" not in compiled


def test_the_document_has_what_the_files_have(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(GLASS, encoding="utf-8")
    result = invoke("compile", str(file), "--engine", "godot", "-o", str(tmp_path / "out"))
    document = json.loads((tmp_path / "out" / "Glass.godot.functions.json").read_text("utf-8"))
    names = [row["name"] for row in document["functions"]]
    assert f"Glass: {len(names)} functions ({', '.join(names)}) in files" in result.stdout
    assert "clearcoat" in names and "transmission" not in names


def test_what_places_vertices_is_never_left_out(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material M { clip_position = vec4(vertex_uv, 0, 1)   color = rgb(uv, 0) }\n")
    result = invoke("compile", str(file), "--engine", "filament", "-o", str(tmp_path / "out"))
    assert result.exit_code == 1 and not (tmp_path / "out").exists()
    assert "error[B0909]: Filament cannot draw `clip_position`: its materials have" in result.stderr


OF_FUNCTIONS = [name for name in known.names() if known.load(name).write_shaders is None]
"""The engines that take functions."""


@pytest.mark.parametrize("compiled", [(BENT, name) for name in OF_FUNCTIONS], indirect=True)
def test_every_engine_is_given_a_bent_mesh(compiled: str) -> None:
    assert "bent_position(" in compiled and "bent_normal(" in compiled


@pytest.mark.parametrize("compiled", [(PUSHED, "filament")], indirect=True)
def test_normals_of_vertices_reach_an_engine_that_takes_those_of_pixels(compiled: str) -> None:
    assert "material.normal = normalize(pushed_normal(" in compiled
    assert "B0912" not in compiled


@pytest.mark.parametrize("compiled", [(PUSHED, "godot")], indirect=True)
def test_all_is_computed_before_a_vertex_is_moved(compiled: str) -> None:
    expected = """
        vec3 moved_object_position = pushed_object_position(VERTEX, NORMAL);
        vec3 moved_object_normal = pushed_object_normal(VERTEX, NORMAL);
        VERTEX = moved_object_position;
        NORMAL = moved_object_normal;
    """
    lines = [line.strip() for line in compiled.splitlines()]
    assert "\n".join(map(str.strip, expected.strip().splitlines())) in "\n".join(lines)


COATED = """\
import std.models.{OpenPbr}
material Paint : OpenPbr { base_color = #a01810   coat_weight = 0.5 }
"""


GLOWING = """\
import std.gltf.{MetallicRoughness}
material Glowing : MetallicRoughness {}
"""


@pytest.mark.parametrize("compiled", [(GLOWING, name) for name in OF_FUNCTIONS], indirect=True)
def test_light_of_its_own_reaches_every_engine(compiled: str) -> None:
    assert "glowing_glow(" in compiled.replace("GlowingGlow", "glowing_glow")


@pytest.mark.parametrize("compiled", [(BENT, "godot"), (BENT, "three")], indirect=True)
def test_a_surface_without_a_colour_is_told(compiled: str) -> None:
    assert "draws `Bent` white: no slot of it is known as its base colour" in compiled


HOLED = """\
import std.terms.{lambert}
material Holed {
    color = lambert(rgb(1, 1, 1))
    is_hidden = uv.x < 0.5
}
"""


@pytest.mark.parametrize("engine", ["bevy", "filament", "godot", "three"])
def test_all_engines_draw_what_has_no_colour_white(engine: str, tmp_path: Path) -> None:
    """That the material lights itself is no reason why one engine draws it and another does not."""
    file = tmp_path / "m.burnish"
    file.write_text(HOLED, encoding="utf-8")
    result = invoke("compile", str(file), "--engine", engine, "-o", str(tmp_path))
    assert result.exit_code == 0 and "B0909" not in result.stderr
    assert "draws `Holed` white: no slot of it is known as its base colour" in result.stderr


READ = """\
import std.terms.{lambert}
material Read {
    tint = rgb(wear, 1, 1)
    wear = uv.x
    occlusion = uv.x
    color = lambert(rgb(1, 1, 1))
}
"""


@pytest.mark.parametrize("engine", ["bevy", "filament", "godot", "three"])
def test_nobody_is_told_that_nothing_reads_what_an_engine_reads(
    engine: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A build is up to date then, as there is nothing to tell."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    Path("m.burnish").write_text(READ, encoding="utf-8")
    assert "warning[B0210]: nothing reads `occlusion`" in invoke("check", "m.burnish").stderr
    first, second = (invoke("build", ".", "--engine", engine) for _ in range(2))
    assert (first.exit_code, first.stderr, second.stderr) == (0, "", "")
    assert "0 actions run, 1 up to date" in second.stdout


@pytest.mark.parametrize("compiled", [(BENT, "unity"), (COATED, "godot")], indirect=True)
def test_others_have_a_colour_or_nothing_to_do_with_it(compiled: str) -> None:
    assert "white" not in compiled.partition("warning")[2]


@pytest.mark.parametrize("compiled", [(COATED, "godot")], indirect=True)
def test_constants_of_the_library_are_the_engines(compiled: str) -> None:
    """A surface with an alpha would be drawn as a transparent one, even if that is 1."""
    assert "ALPHA" not in compiled and "CLEARCOAT = " in compiled


LAYERED = """\
import std.models.{GltfSurface}
material Layered : GltfSurface {
    clearcoat = 0.5   clearcoat_roughness = 0   sheen_color = rgb(uv, 1)
    normal = normalize(inherited.normal + vec3(uv, 0))
}
material Bare : GltfSurface { ior = 1.5   sheen_roughness = 0   clearcoat_roughness = 0 }
"""
OTHERS = {"three": ["clearcoat_normal", "sheen_roughness"], "bevy": ["clearcoat_roughness"]}
"""The slots whose constants of the library these engines have not themselves."""
PARTNERS = ("ior", "clearcoat_roughness", "clearcoat_normal", "sheen_roughness")


@pytest.mark.parametrize("engine", ["three", "bevy", "godot", "filament"])
def test_constants_that_are_not_the_engines_are_given(engine: str, tmp_path: Path) -> None:
    """three.js has a sheen of the roughness 1, and the library one of 0."""
    file = tmp_path / "m.burnish"
    file.write_text(LAYERED, encoding="utf-8")
    result = invoke("compile", str(file), "--engine", engine, "-o", str(tmp_path))
    assert result.exit_code == 0, result.stderr

    def given(name: str) -> list[str]:
        document = json.loads((tmp_path / f"{name}.{engine}.functions.json").read_text("utf-8"))
        names = [row["name"] for row in document["functions"]]
        return [name for name in PARTNERS if name in names]

    assert given("Layered") == OTHERS.get(engine, [])
    assert given("Bare") == []


def test_what_engines_have_themselves_are_values_that_they_take() -> None:
    for name, values in USUAL.items():
        assert values.keys() <= known.load(name).taken


LIBRARY = (Path(__file__).parents[2] / "stdlib" / "models.burnish").read_text("utf-8")
MODELS = dict(
    re.findall(r"^abstract material (\w+) : Surface.*?\{\n(.*?)\n\n", LIBRARY, re.M | re.S)
)
"""What the models of the library declare first: the slots that people set."""
DECLARED = re.compile(r"^    (\w+) +: (float|rgb) +=", re.M)
PARTS = {"OpenPbr": {"base_weight", "base_color"}}
"""Slots that reach engines by another one, which is made of them."""


@pytest.mark.parametrize("engine", ["three", "bevy", "godot", "filament"])
@pytest.mark.parametrize("model", MODELS)
def test_no_slot_of_a_model_is_lost(model: str, engine: str, tmp_path: Path) -> None:
    slots = dict(DECLARED.findall(MODELS[model]))
    assert len(slots) > 8
    values = {"float": "0.3 + 0.5 * uv.x", "rgb": "rgb(uv, 1)"}
    lines = "\n".join(f"    {name} = {values[type_]}" for name, type_ in slots.items())
    file = tmp_path / "m.burnish"
    file.write_text(
        f"import std.models.{{{model}}}\nmaterial M : {model} {{\n{lines}\n}}\n", encoding="utf-8"
    )
    result = invoke("compile", str(file), "--engine", engine, "-o", str(tmp_path))
    assert result.exit_code == 0, result.stderr
    document = json.loads((tmp_path / f"M.{engine}.functions.json").read_text("utf-8"))
    written = {row["name"] for row in document["functions"]}
    told = set(re.findall(r"the slot `(\w+)` of `M` is left out", result.stderr))
    assert not slots.keys() - written - told - PARTS.get(model, set())
    assert not written & told


def test_engines_take_values_of_the_table() -> None:
    names = {row.name for row in INPUTS}
    for name in known.names():
        assert known.load(name).taken <= names

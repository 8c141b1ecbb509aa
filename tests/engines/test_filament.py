"""Filament's own compiler takes the definitions of materials, for phones and all else."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.targets.toolchain.process import run
from burnish.targets.toolchain.tools import program

from ..golden import assert_golden
from .drawing import leaf
from .files import EXAMPLES, files_of, summary, texts_of

GOLDEN = Path(__file__).parent / "golden"
pytestmark = pytest.mark.xdist_group("filament")

VARIANTS = "directionalLighting,dynamicLighting,shadowReceiver,skinning,vsm,fog"
"""What Filament adds to a material by itself, in dozens of shaders that say nothing new."""
LIMIT = 120.0
"""The seconds that the compiler may take; it takes one."""

COMPILED = {
    "plastic": "Plastic", "gltf_material": "Painted", "water": "Water", "texture_array": "Terrain",
    "indexed": "Indexed", "cube_map": "Shade",
}  # fmt: skip
"""Examples with textures of all kinds, with values between vertices and pixels, without lights."""


def said(text: str, folder: Path, *options: str) -> str:
    """What the compiler says of a definition; nothing if it takes it."""
    found = program("filament", "matc")
    assert found is not None
    (folder / "material.mat").write_text(text, "utf-8")
    command = [str(found), "--optimize-none", "--variant-filter", VARIANTS, *options]
    command += ["--output", str(folder / "material.filamat"), str(folder / "material.mat")]
    outcome = run(command, time_limit=LIMIT, folder=folder)
    return outcome.log if outcome.ending != "ended" or outcome.code else ""


def text_of(name: str, material: str) -> str:
    (text,) = files_of("filament", EXAMPLES / f"{name}.burnish", material).values()
    return text


@pytest.mark.parametrize("name", ["plastic", "gltf_material", "water"])
def test_text(name: str) -> None:
    assert_golden(text_of(name, COMPILED[name]), GOLDEN / f"{COMPILED[name]}.mat")


def test_what_filament_cannot_have_is_told() -> None:
    assert_golden(summary(*texts_of("filament")), GOLDEN / "filament.txt")


@pytest.mark.parametrize("name", list(COMPILED))
def test_the_compiler_takes_it(name: str, tmp_path: Path) -> None:
    text = text_of(name, COMPILED[name])
    assert not said(text, tmp_path, "--platform", "all", "--api", "opengl")


def test_the_compiler_takes_it_for_vulkan_and_metal(tmp_path: Path) -> None:
    text = text_of("gltf_material", "Painted")
    assert not said(text, tmp_path, "--platform", "all", "--api", "all")


MOVED = """\
import std.tangents.{Tangents, Bumped}
import std.motion.{MeshPoint}
material Moved : Surface + Tangents + Bumped {
    rest = inherited.object_shape
    object_shape = MeshPoint(2 * rest.position, rest.normal, rest.tangent, rest.handedness, mat4(1))
    position = @vertex (inherited.position + 0.1 * (eye - inherited.position))
    tint = abs(inherited.position)
    rough = distance(eye, inherited.position)
}
"""


def test_places_are_those_of_the_users_world(tmp_path: Path) -> None:
    """Filament's own world is moved to the camera."""
    (text,) = files_of("filament", MOVED, "Moved").values()
    eye = "getWorldCameraPosition()"
    assert eye not in text.replace(f"({eye} + getWorldOffset())", "") and eye in text
    assert "found[3].xyz += getWorldOffset();" in text and ") - getWorldOffset();" in text
    (plain,) = files_of("filament", "material Plain { tint = abs(position) }", "Plain").values()
    assert "plain_tint((getWorldPosition() + getWorldOffset()))" in plain
    assert not said(text, tmp_path, "--platform", "all", "--api", "opengl")


def test_tangents_are_those_of_the_frame(tmp_path: Path) -> None:
    """No mesh has to bring along its tangents twice."""
    (text,) = files_of("filament", MOVED, "Moved").values()
    assert "custom0" not in text and "vec4 object_tangent() {" in text
    text = text_of("normal_map", "TangentSpaceBumps")
    assert "material.object_tangent = object_tangent();" in text
    assert not said(text, tmp_path, "--platform", "all", "--api", "opengl")


@pytest.mark.parametrize("by", ["Cut", "Mixed", "Added", "Multiplied"])
def test_the_compiler_takes_what_passes_say(by: str, tmp_path: Path) -> None:
    text = leaf("filament", by=by, raster="raster { cull = back }")
    assert not said(text, tmp_path, "--platform", "all", "--api", "opengl")


def test_the_compiler_tells_mistakes(tmp_path: Path) -> None:
    text = text_of("plastic", "Plastic").replace("return base *", "return bass *")
    assert "'bass' : undeclared identifier" in said(text, tmp_path, "--platform", "desktop")

"""Displacements of documents: what moves points is an equation, which every target takes."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.api.entry_points import compile
from burnish.materialx.importing import Imported, imported

from .kit import document

TARGETS = ("glsl", "hlsl", "wgsl")
MOVED = """<materialx version="1.39">
{}
<displacement name="d" type="displacementshader">
  <input name="displacement" type="float" nodename="x"/>
</displacement>
<surfacematerial name="M" type="material">
  <input name="displacementshader" type="displacementshader" nodename="d"/>
</surfacematerial>
</materialx>
"""
MIXED = """<materialx version="1.39">
<displacement name="a" type="displacementshader">
  <input name="displacement" type="float" value="0.25"/><input name="scale" type="float" value="2"/>
</displacement>
<displacement name="b" type="displacementshader">
  <input name="displacement" type="vector3" value="1, 2, 3"/>
</displacement>
<dot name="c" type="displacementshader">
  <input name="in" type="displacementshader" nodename="b"/>
</dot>
<mix name="d" type="displacementshader">
  <input name="bg" type="displacementshader" nodename="a"/>
  <input name="fg" type="displacementshader" nodename="c"/>
  <input name="mix" type="float" value="0.25"/>
</mix>
<surfacematerial name="M" type="material">
  <input name="displacementshader" type="displacementshader" nodename="d"/>
</surfacematerial>
</materialx>
"""
UNSUITABLE = {
    "the view": (
        '<viewdirection name="v" type="vector3"/>'
        '<extract name="x" type="float"><input name="in" type="vector3" nodename="v"/></extract>',
        "M.mtlx:2: v: a displacement cannot depend on where the viewer is",
    ),
    "neighbouring pixels": (
        '<splitlr name="x" type="float"/>',
        "M.mtlx:2: x: a displacement cannot compare a pixel with those beside it",
    ),
    "a border": (
        '<image name="x" type="float"><input name="file" type="filename" value="a.png"/>'
        '<input name="uaddressmode" type="string" value="constant"/></image>',
        "M.mtlx:2: x: a displacement cannot compare a pixel with those beside it",
    ),
}


def written(found: Imported, folder: Path) -> Path:
    """The files of an import in a folder; gives the main one."""
    for name, content in found.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    return folder / found.main


def test_a_displacement_is_an_equation_that_all_targets_take(tmp_path: Path) -> None:
    found = imported(document("displaced_wood"))
    assert not found.problems
    assert [material.is_displaced for material in found.materials] == [True, True]
    text = found.files[found.main].decode()
    assert [text.count(f"    {slot} ") for slot in ("displacement", "displacement_vector")] == [
        1,
        1,
    ]
    for compiled in compile(written(found, tmp_path), TARGETS).materials:
        assert {file.target for file in compiled.files} == set(TARGETS)


def test_mixed_displacements_are_a_vector_if_one_of_them_is(tmp_path: Path) -> None:
    """MaterialX's own GLSL has no such mix."""
    path = tmp_path / "M.mtlx"
    path.write_text(MIXED, "utf-8")
    found = imported(path)
    assert not found.problems
    assert "    displacement_vector = mix(vec3(0, 0, 0.5), vec3(1, 2, 3), 0.25)" in (
        found.files[found.main].decode()
    )


def test_displacements_read_textures_at_their_largest_level() -> None:
    """Vertices have no pixels beside them; colours are read as ever."""
    found = imported(document("displaced_wood"))
    text = found.files[found.main].decode()
    assert "mask.level(uv, 0).r" in text
    assert "mask(uv).r" in text


@pytest.mark.parametrize("case", UNSUITABLE)
def test_what_vertices_cannot_compute_is_told(case: str, tmp_path: Path) -> None:
    nodes, message = UNSUITABLE[case]
    path = tmp_path / "M.mtlx"
    path.write_text(MOVED.format(nodes), "utf-8")
    (problem,) = imported(path).problems
    assert str(problem) == message
    assert problem.is_error

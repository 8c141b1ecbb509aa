"""Materials of the library's models as documents of MaterialX, and the command that writes them."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from burnish.materialx.importing import imported

from ..cli.kit import invoke, tree
from ..golden import assert_golden
from .kit import MATERIALS, exported, read_back, written

DOCUMENTS = Path(__file__).parents[1] / "materialx" / "documents"
MODELS = {
    "OpenPbr": ("open_pbr_surface", "OpenPbrSurface"),
    "GltfSurface": ("gltf_pbr", "GltfPbrSurface"),
    "Principled": ("disney_principled", "DisneyPrincipledSurface"),
}
"""The surfaces that models of ``std.models`` are: their files and names after importing."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    shutil.copy(MATERIALS / "models.burnish", tmp_path)
    (tmp_path / "paint.png").write_bytes(b"")
    return tmp_path


def test_the_document_of_models(folder: Path) -> None:
    given = [
        word for name in ("albedo", "Bumpy.paint", "normal_map")
        for word in ("--set", f"{name}={folder / 'paint.png'}")
    ]  # fmt: skip
    result = invoke("export", folder / "models.burnish", *given, "-o", folder / "models.mtlx")
    assert (result.exit_code, result.stderr) == (0, "")
    assert_golden((folder / "models.mtlx").read_text(), MATERIALS / "models.mtlx")


def test_the_document_of_models_is_read_back(tmp_path: Path) -> None:
    found = read_back(exported(MATERIALS / "models.burnish"), tmp_path, "models")
    assert_golden(found.read_text(), MATERIALS / "models_read_back.burnish")


@pytest.mark.parametrize(("model", "material"), [
    ("OpenPbr", "Paint"), ("Principled", "Toy"),
])  # fmt: skip
def test_a_model_of_the_library_is_the_imported_one(
    model: str, material: str, tmp_path: Path
) -> None:
    """A material that extends the imported surface becomes the same document."""
    stem, name = MODELS[model]
    document = exported(MATERIALS / "models.burnish", material)
    written(imported(_saved(tmp_path / "whole.mtlx", document)), tmp_path)
    text = (MATERIALS / "models.burnish").read_text()
    text = text.replace(f": {model} ", f": {name} ")
    text = text.replace("import std.color", f"import materialx.{stem}.{{{name}}}\nimport std.color")
    other = exported(_saved(tmp_path / "other.burnish", text), material)
    lines = [line for line in document.splitlines() if line not in other.splitlines()]
    # Defaults of the library's models are written where MaterialX has others.
    assert all('type="float" value=' in line for line in lines)


ENCODED = """burnish 1
import std.models.{OpenPbr}
import std.mtlx.color.{from_acescg}

material Encoded : OpenPbr {
    param tint : rgb = from_acescg(rgb(0.8, 0.6, 0.4))

    base_color = tint * 0.5
}
"""


def test_a_parameter_keeps_the_colour_space_of_its_default(tmp_path: Path) -> None:
    document = exported(_saved(tmp_path / "encoded.burnish", ENCODED))
    assert 'value="0.8, 0.6, 0.4" colorspace="acescg"' in document
    found = read_back(document, tmp_path / "back", "encoded").read_text()
    assert "tint : rgb = from_acescg(rgb(0.8, 0.6, 0.4))" in found


def test_what_cannot_be_said_is_told_and_nothing_is_written(tmp_path: Path) -> None:
    shutil.copy(MATERIALS / "unsayable.burnish", tmp_path)
    before = tree(tmp_path)
    result = invoke("export", tmp_path / "unsayable.burnish", "-o", tmp_path / "out.mtlx")
    assert (result.exit_code, result.stdout) == (1, "")
    assert_golden(result.stderr.replace(f"{tmp_path}/", ""), MATERIALS / "unsayable.txt")
    assert tree(tmp_path) == before


def test_a_file_that_is_not_known_is_told(folder: Path) -> None:
    result = invoke("export", folder / "models.burnish", "--material", "Paint", "--format", "mtlx")
    assert result.exit_code == 0
    assert result.stderr == (
        "note: no file is known for the texture `albedo`: the document names `albedo.png`\n"
        "  = help: name another one: `--set albedo=FILE`\n"
    )


def test_the_comment_of_a_file_names_its_textures(folder: Path) -> None:
    text = (folder / "models.burnish").read_text()
    command = "//!     burnish render models.burnish -o models.png --set albedo=paint.png\n"
    (folder / "models.burnish").write_text(text.replace("burnish 1\n", f"burnish 1\n{command}", 1))
    (folder / "deep").mkdir()
    out = folder / "deep" / "models.mtlx"
    result = invoke("export", folder / "models.burnish", "--material", "Paint", "-o", out)
    assert (result.exit_code, result.stderr) == (0, "")
    assert 'value="../paint.png"' in (folder / "deep" / "models.mtlx").read_text()


def test_a_texture_that_is_not_there_is_told(folder: Path) -> None:
    result = invoke(
        "export", folder / "models.burnish", "--set", "albino=x.png", "--format", "mtlx"
    )
    assert (result.exit_code, result.stdout) == (2, "")
    assert "no texture is called `albino`" in result.stderr


def test_words_are_members_of_enumerations_and_words_again(tmp_path: Path) -> None:
    found = imported(DOCUMENTS / "closure_sheen.mtlx")
    path = written(found, tmp_path / "cloth")
    assert "mode = SheenMode.zeltner" in path.read_text()
    tiles = imported(MATERIALS / "tiles.mtlx")
    text = written(tiles, tmp_path / "tiles").read_text()
    assert "worleynoise2d(st, style = WorleyStyle.solid)" in text
    assert "import std.mtlx.noise.{WorleyStyle, worleynoise2d}" in text
    document = exported(tmp_path / "tiles" / tiles.main)
    assert '<input name="style" type="integer" value="1" />' in document
    assert "WorleyStyle.solid" in read_back(document, tmp_path / "back", "tiles").read_text()


def _saved(path: Path, text: str) -> Path:
    path.write_text(text)
    return path

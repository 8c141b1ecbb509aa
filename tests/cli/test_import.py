"""``burnish import``: the files that it writes and says, and what it leaves as it is."""

from __future__ import annotations

import errno
import re
import sys
from pathlib import Path
from zipfile import ZipFile

import click
import pytest

import burnish as package
from burnish.commands.comments import asked
from burnish.commands.group import burnish
from burnish.support.installing import install_command

from ..materialx.kit import document
from .kit import invoke, shell, tree

OWN = document("own_definition")
FILES = {"own_definition.burnish", "materialx/place2d.burnish", "materialx/switch.burnish"}


def contents(folder: Path) -> dict[str, bytes]:
    return {
        name: (folder / name).read_bytes() for name in tree(folder) if (folder / name).is_file()
    }


def broken(folder: Path) -> Path:
    """A document with one material that is converted and one that is not."""
    path = folder / "broken.mtlx"
    path.write_text(
        '<materialx version="1.39">\n'
        '<surface_unlit name="good" type="surfaceshader"/>\n'
        '<surfacematerial name="Good" type="material">'
        '<input name="surfaceshader" type="surfaceshader" nodename="good"/></surfacematerial>\n'
        '<surfacematerial name="Bad" type="material">'
        '<input name="surfaceshader" type="surfaceshader" nodename="gone"/></surfacematerial>\n'
        "</materialx>\n"
    )
    return path


def test_files_are_written_and_told(tmp_path: Path) -> None:
    out = tmp_path / "a folder"
    said = invoke("import", OWN, "-o", out)
    assert said.exit_code == 0
    *files, last = said.stdout.splitlines()
    assert set(files) == {str(out / name) for name in FILES}
    main = out / "own_definition.burnish"
    assert last == f"Woven. To see it: burnish render '{main}', or burnish view '{main}'"
    assert set(contents(out)) == FILES
    assert not package.check(main)


def test_a_second_time_changes_nothing(tmp_path: Path) -> None:
    invoke("import", OWN, "-o", tmp_path)
    times = {name: (tmp_path / name).stat().st_mtime_ns for name in FILES}
    said = invoke("import", OWN, "-o", tmp_path)
    assert said.exit_code == 0
    assert said.stdout.count("(was there already)") == len(FILES)
    assert {name: (tmp_path / name).stat().st_mtime_ns for name in FILES} == times


def test_files_with_other_contents_stay(tmp_path: Path) -> None:
    place = tmp_path / "materialx" / "switch.burnish"
    place.parent.mkdir()
    place.write_text("mine")
    said = invoke("import", OWN, "-o", tmp_path)
    assert said.exit_code == 1
    assert said.stderr == (
        f"error: `{place}` is there already with other contents, and nothing was written\n"
        "  = help: name another folder, `-o FOLDER`, or replace what is there: `--force`\n"
    )
    assert contents(tmp_path) == {"materialx/switch.burnish": b"mine"}


def test_files_with_other_contents_are_replaced_by_force(tmp_path: Path) -> None:
    place = tmp_path / "own_definition.burnish"
    place.write_text("mine")
    said = invoke("import", OWN, "-o", tmp_path, "--force")
    assert said.exit_code == 0
    assert not package.check(place)


def test_a_link_is_no_file_of_the_import(tmp_path: Path) -> None:
    """It may lead anywhere; by force, the link is replaced, and not what it leads to."""
    elsewhere = tmp_path / "elsewhere"
    elsewhere.write_text("theirs")
    out = tmp_path / "out"
    out.mkdir()
    (out / "own_definition.burnish").symlink_to(elsewhere)
    assert invoke("import", OWN, "-o", out).exit_code == 1
    assert invoke("import", OWN, "-o", out, "--force").exit_code == 0
    assert elsewhere.read_text() == "theirs"


def test_what_cannot_be_converted_is_told_and_nothing_is_written(tmp_path: Path) -> None:
    out = tmp_path / "out"
    said = invoke("import", broken(tmp_path), "-o", out)
    assert said.exit_code == 1
    assert said.stderr == (
        "error: broken.mtlx:4: Bad: there is no node 'gone'\n"
        "note: nothing is written; --partial writes the rest\n"
    )
    assert not out.exists()


def test_the_rest_is_written_where_that_is_wanted(tmp_path: Path) -> None:
    out = tmp_path / "out"
    said = invoke("import", broken(tmp_path), "-o", out, "--partial")
    assert said.exit_code == 0
    assert said.stderr == "warning: broken.mtlx:4: Bad: there is no node 'gone'\n"
    assert said.stdout.splitlines()[-1].startswith("Good. To see it: ")
    assert tree(out) == {"broken.burnish"}


def test_a_document_without_materials(tmp_path: Path) -> None:
    path = tmp_path / "none.mtlx"
    path.write_text('<materialx version="1.39"/>')
    said = invoke("import", path, "-o", tmp_path / "out")
    assert said.exit_code == 1
    assert said.stderr == (
        f"error: `{path}` has no material, surface or output that could be drawn\n"
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (None, "error: `{path}`: No such file or directory\n"),
        ("", "error: odd.mtlx:1: the file is empty\n"),
        ("<a/>", "error: odd.mtlx:1: this is no document of MaterialX: it begins with <a>\n"),
        (
            '<materialx><xi:include href="&#x202e;&#10;x"/></materialx>',
            "error: odd.mtlx:1: there is no file '<U+202E><U+000A>x', which is included\n",
        ),
    ],
)
def test_what_is_no_document_is_told(text: str | None, expected: str, tmp_path: Path) -> None:
    path = tmp_path / "odd.mtlx"
    if text is not None:
        path.write_text(text)
    said = invoke("import", path, "-o", tmp_path / "out")
    assert (said.exit_code, said.stdout) == (1, "")
    assert said.stderr == expected.replace("{path}", str(path))
    assert not (tmp_path / "out").exists()


def test_a_folder_that_cannot_be_written_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(path: str, *_: object) -> None:
        raise PermissionError(errno.EACCES, "Permission denied", path)

    monkeypatch.setattr("burnish.commands.output.replace_tree", refused)
    said = invoke("import", OWN, "-o", tmp_path)
    assert said.exit_code == 1
    assert f"error[B0009]: cannot write to `{tmp_path}`: Permission denied" in said.stderr


def test_a_folder_below_a_file(tmp_path: Path) -> None:
    """A half of the files is no import: what was written before is gone again."""
    out = tmp_path / "out"
    out.mkdir()
    (out / "materialx").write_text("a file")
    said = invoke("import", OWN, "-o", out)
    assert said.exit_code == 1
    assert "error[B0009]: cannot write to" in said.stderr
    assert contents(out) == {"materialx": b"a file"}


def test_the_folder_is_a_file(tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.write_text("mine")
    said = invoke("import", OWN, "-o", out)
    assert said.exit_code == 2
    assert f"Error: Invalid value for '-o': Directory '{out}' is a file." in said.stderr
    assert out.read_text() == "mine"


def test_the_package_is_missing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "MaterialX", None)
    said = invoke("import", OWN, "-o", tmp_path / "out")
    assert said.exit_code == 1
    assert said.stderr == (
        "error: documents of MaterialX are read by the package MaterialX: "
        f"{install_command(['materialx'])}\n"
    )


def test_pictures_of_a_further_folder(tmp_path: Path) -> None:
    pictures = tmp_path / "pictures"
    path = tmp_path / "document" / "painted.mtlx"
    path.parent.mkdir()
    path.write_text(
        '<materialx version="1.39">\n<image name="wood" type="color3">'
        '<input name="file" type="filename" value="../pictures/old wood.png"/></image>\n'
        '<surface_unlit name="s" type="surfaceshader">'
        '<input name="emission_color" type="color3" nodename="wood"/></surface_unlit>\n'
        "</materialx>\n"
    )
    alone = invoke("import", path, "-o", tmp_path / "alone")
    assert alone.exit_code == 0
    assert alone.stderr == (
        "note: painted.mtlx:3: s: the picture `../pictures/old wood.png` is not in the document's "
        "folder: its texture is white until a host binds it\n"
    )
    pictures.mkdir()
    (pictures / "old wood.png").write_bytes(b"a picture")
    out = tmp_path / "out"
    said = invoke("import", path, "-o", out, "--images", pictures)
    assert (said.exit_code, said.stderr) == (0, "")
    assert contents(out)["textures/old_wood.png"] == b"a picture"
    assert "--set old_wood=textures/old_wood.png" in (out / "painted.burnish").read_text()


@pytest.mark.parametrize("name", ["own_definition", "image_plain", "surface_mix"])
def test_the_command_of_an_imported_file_is_followed(name: str, tmp_path: Path) -> None:
    """The gallery draws the file as its first comment says."""
    assert invoke("import", document(name), "-o", tmp_path).exit_code == 0
    main = tmp_path / f"{name}.burnish"
    render = burnish.get_command(click.Context(burnish), "render")
    assert render is not None
    found = asked(main.read_text(), main.name, tmp_path, 256, render)
    assert not found.note
    assert found.words[0] == main.name


def test_help() -> None:
    said = invoke("import", "--help")
    assert said.exit_code == 0
    words = re.findall(r"--?[a-z]+", said.stdout)
    assert {"-o", "--images", "--partial", "--force"} <= set(words)


def test_a_shell_imports(tmp_path: Path) -> None:
    """By default, files go to the folder that a command is run in."""
    done = shell("import", OWN, folder=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert tree(tmp_path) >= FILES


def test_an_archive_is_imported(tmp_path: Path) -> None:
    made = tmp_path / "sticker.mtlx.zip"
    with ZipFile(made, "w") as archive:
        for name in ("image_plain.mtlx", "images/tiles.png"):
            archive.write(OWN.parent / name, name)
    said = invoke("import", made, "-o", tmp_path / "out")
    assert (said.exit_code, said.stderr) == (0, "")
    assert tree(tmp_path / "out") >= {"image_plain.burnish", "textures/tiles.png"}


def test_an_archive_that_is_none_is_told(tmp_path: Path) -> None:
    path = tmp_path / "a.mtlx.zip"
    path.write_text("hello")
    said = invoke("import", path, "-o", tmp_path / "out")
    assert said.exit_code == 1
    assert said.stderr == (
        "error: a.mtlx.zip:1: this is no whole ZIP archive: File is not a zip file\n"
    )
    assert not (tmp_path / "out").exists()


def test_a_folder_is_no_document(tmp_path: Path) -> None:
    said = invoke("import", tmp_path, "-o", tmp_path / "out")
    assert (said.exit_code, said.stderr) == (
        1, f"error: cannot read {tmp_path}: it is not a file\n",
    )  # fmt: skip

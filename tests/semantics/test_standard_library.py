"""The library is read once in a process, and again after somebody has changed it."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

import burnish
from burnish.compiler import frontend
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.library import FOLDER, standard_library

from ..suite.processes import at_once

MATERIAL = "import std.vertices\nmaterial M { color = rgb(added()) }"


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "library"
    shutil.copytree(FOLDER, folder)
    monkeypatch.setattr(frontend, "FOLDER", folder)
    return folder


def test_all_compiles_see_the_same_symbols() -> None:
    library = standard_library(FOLDER)
    assert standard_library(FOLDER) is library
    one, other = (library.module("lights.burnish") for _ in range(2))
    assert one is other is not None


def test_a_change_is_seen(library: Path) -> None:
    def write(value: str) -> None:
        path = library / "vertices.burnish"
        text = path.read_text("utf-8").split("\nfn added")[0]
        path.write_text(f"{text}\nfn added() -> float = {value}\n", "utf-8")
        after = path.stat().st_mtime_ns + 1_000_000_000  # Clocks of file systems are coarse.
        os.utime(path, ns=(after, after))

    write("0.125")
    first = burnish.compile(MATERIAL, ["glsl"])["M"]
    write("0.375")
    second = burnish.compile(MATERIAL, ["glsl"])["M"]
    assert "0.125" in first.files[-1].text
    assert "0.375" in second.files[-1].text


def test_a_mistake_in_the_library_is_reported_by_each_compile(library: Path) -> None:
    path = library / "prelude.burnish"
    path.write_text(path.read_text("utf-8") + "\nimport std.nothing\n", "utf-8")
    for _ in range(2):
        with pytest.raises(burnish.CompileError) as caught:
            burnish.compile("material M {}", ["glsl"])
        assert [each.rule.code for each in caught.value.diagnostics] == ["B0006"]


@pytest.mark.parametrize(
    ("file", "old", "new", "message", "place"),
    [
        (
            "closures",
            "/// The same light",
            "fn broken(x: float) -> = 1\n/// The",
            "expected a name",
            "closures",
        ),
        ("fresnel", "fn grey(", "fn gray(", "does not declare `grey`", "closures"),
        ("fresnel", "import std.", "import std.nothing.{x}\nimport std.", "std.nothing", "fresnel"),
        (
            "fresnel",
            "fn grey(",
            "fn broken(x: float) -> = 1\nfn grey(",
            "expected a name",
            "fresnel",
        ),
    ],
)
def test_a_mistake_in_a_file_of_the_library_is_told_by_the_first_compile_that_reads_it(
    library: Path, file: str, old: str, new: str, message: str, place: str
) -> None:
    """Also if it is another file of the library that imports it."""
    changed = library / "mtlx" / f"{file}.burnish"
    changed.write_text(changed.read_text().replace(old, new, 1))
    source = (
        "import std.mtlx.closures.{dielectric_bsdf}\nimport std.mtlx.asking.{passing}\n"
        "material M { color = dielectric_bsdf(passing(to_eye, ambient_light), normal = normal, "
        "tangent = normal).response }"
    )
    for _ in range(2):
        with pytest.raises(burnish.CompileError) as caught:
            burnish.compile(source, ["glsl"])
        told = render_all(caught.value.diagnostics)
        assert message in told
        assert f"--> std/mtlx/{place}.burnish:" in told


def test_threads_wait_until_a_module_is_linked(library: Path) -> None:
    """A module that is half linked would lack names in some compiles."""
    found = at_once([lambda: standard_library(library).module("terms.burnish")] * 8)
    assert found[0] is not None
    assert len(set(map(id, found))) == 1

"""The library is made of files like any other: the compiler knows none of its names."""

from __future__ import annotations

import json
import re
import shutil
import tomllib
from codecs import encode
from pathlib import Path

import pytest

import burnish
from burnish.compiler import frontend
from burnish.compiler.documents.writing import to_json
from burnish.compiler.reflection import roles
from burnish.compiler.semantics.names.standard_library import files_of
from burnish.targets import registry

from ..suite.package import FOLDERS
from .kit import LIBRARY, ROOT, files, library_names

NAMES = library_names()
WORDS = re.compile(rf"\b({'|'.join(sorted(NAMES))})\b")
EXAMPLE = ROOT / "examples" / "plastic.burnish"
PROFILES = [f"{n}:{p.name}" for n in registry.names() for p in registry.load(n).profiles]


def test_the_names_are_found() -> None:
    assert {"Surface", "Light", "Forward", "Daylight", "Spot", "ambient", "lambert"} <= NAMES


KNOW_OF_METAL = {
    "targets/runner/drivers/wgpu/__init__.py",
    "targets/runner/drivers/wgpu/device.py",
    "targets/toolchain/checkers.py",
    "targets/toolchain/tools.py",
}
"""The row of a checker and that of its tool, and a driver whose devices may be reached by it."""
METAL = re.compile(r"\b(msl|metal2?|apple)\b", re.IGNORECASE)


@pytest.mark.parametrize("folder", FOLDERS)
def test_a_language_is_known_in_its_own_folder_alone(folder: str) -> None:
    """Metal was the first to be added from outside; the next has to find no less.

    Materials of the library may be of metal.
    """
    found = {
        str(path.relative_to(ROOT))
        for path in files(ROOT / folder)
        if path.parent.name != "msl"
        and path.suffix != ".burnish"
        and METAL.search(path.read_text("utf-8"))
    }
    assert found == (KNOW_OF_METAL if folder == "targets" else set())


@pytest.mark.parametrize("folder", ["compiler", "targets"])
def test_no_file_contains_a_name_of_the_library(folder: str) -> None:
    """Nor do comments: an example in one would be the first step to a special case."""
    found = [
        f"{path.relative_to(ROOT)}:{number}: {line.strip()}"
        for path in files(ROOT / folder)
        for number, line in enumerate(path.read_text("utf-8").splitlines(), 1)
        if WORDS.search(line)
    ]
    assert not found, "\n".join(found)


def other(name: str) -> str:
    """Another name of the same length; nothing else in the library or the texts looks like it."""
    return encode(name, "rot13")


def renamed(text: str) -> str:
    return WORDS.sub(lambda match: other(match.group()), text)


def restored(text: str) -> str:
    for name in sorted(NAMES, key=len, reverse=True):
        text = text.replace(other(name), name)
    return text


def test_the_demo_compiles_with_everything_renamed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (expected,) = burnish.compile(EXAMPLE, PROFILES).materials
    assert expected.reflection.parameters, "made here, by the library's own names"
    library = tmp_path / "library"
    shutil.copytree(LIBRARY, library)
    for path in files_of(library):
        path.write_text(renamed(path.read_text("utf-8")), "utf-8")
    example = tmp_path / EXAMPLE.name
    example.write_text(renamed(EXAMPLE.read_text("utf-8")), "utf-8")
    monkeypatch.setattr(frontend, "FOLDER", library)
    meanings = renamed((LIBRARY / "scene.toml").read_text("utf-8"))
    monkeypatch.setattr(roles, "scene_names", lambda: tomllib.loads(meanings))

    (found,) = burnish.compile(example, PROFILES).materials
    for before, after in zip(expected.files, found.files, strict=True):
        assert WORDS.search(before.text) is None or after.text != before.text
        assert restored(after.text) == before.text
    one, other = (to_json(material.reflection) for material in (found, expected))
    for backend in (*one["backends"].values(), *other["backends"].values()):
        backend.pop("source_maps")  # The example lies elsewhere now.
    for block in (*one["blocks"], *other["blocks"]):
        block.pop("layout_id")  # A digest of names, too.
    assert json.loads(restored(json.dumps(one))) == other
    assert json.dumps(one) != json.dumps(other)

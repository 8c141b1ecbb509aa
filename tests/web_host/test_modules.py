"""What is generated of the host, and its compiled modules, are what their sources make now.

``BURNISH_UPDATE_GOLDEN=1`` writes them anew.
"""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path

import pytest

from burnish.targets.toolchain.sources import OwnInstaller
from burnish.targets.toolchain.tools import program, tool_named

from ..suite.processes import run
from . import size
from .generated import generated_modules
from .kit import FOLDER, MODULES


def texts(folder: Path) -> dict[str, str]:
    return {path.relative_to(folder).as_posix(): path.read_text() for path in folder.rglob("*.js")}


def test_what_is_generated_is_what_its_sources_make() -> None:
    folder = FOLDER / "generated"
    made = generated_modules()
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        for name, text in made.items():
            (folder / name).write_text(text, encoding="utf-8")
    assert {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()} == made


def test_the_modules_are_those_of_the_sources(tmp_path: Path) -> None:
    node, compiler = program("node", "node"), program("typescript", "tsc")
    assert node is not None
    assert compiler is not None
    command = [str(node), str(compiler), "-p", str(FOLDER), "--outDir", str(tmp_path)]
    done = run(command)
    assert done.stdout == "", "TypeScript refuses the sources"
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        shutil.rmtree(MODULES)
        shutil.copytree(tmp_path, MODULES)
    assert texts(MODULES) == texts(tmp_path)


def test_the_package_names_the_tools_of_the_toolchain() -> None:
    package = json.loads((FOLDER / "package.json").read_text())
    for name, version in package["devDependencies"].items():
        source = tool_named(name).source
        assert isinstance(source, OwnInstaller)
        assert source.pinned == version


def test_the_host_for_webgpu_is_small() -> None:
    """Comments, blank lines and what is generated apart."""
    assert sum(size.sizes(".", "webgpu").values()) < size.MOST


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("", 0),
        ("const a = 1;\n\nconst b = 2; // both\n", 2),
        ("/** What it is,\n * and why. */\nconst a = 1;\n  // Alone.\n", 1),
        ("f({ /* nothing */ }); /** Next. */\ng();\n", 2),
    ],
)
def test_lines_of_code_are_counted(text: str, count: int) -> None:
    assert size.code_lines(text) == count


def test_lines_have_the_length_of_the_tree() -> None:
    lines = [
        f"{path.relative_to(FOLDER)}:{number}"
        for path in FOLDER.rglob("*.ts")
        if path.parent.name != "generated"
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if len(line) > 100
    ]
    assert not lines

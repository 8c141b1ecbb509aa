"""The compiled modules of the host are what TypeScript makes of its sources now.

``BURNISH_UPDATE_GOLDEN=1`` writes them anew.
"""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path

from burnish.targets.toolchain.sources import OwnInstaller
from burnish.targets.toolchain.tools import program, tool_named

from ..suite.processes import run
from .kit import FOLDER, MODULES


def texts(folder: Path) -> dict[str, str]:
    return {path.relative_to(folder).as_posix(): path.read_text() for path in folder.rglob("*.js")}


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


def test_the_package_names_the_compiler_of_the_toolchain() -> None:
    package = json.loads((FOLDER / "package.json").read_text())
    source = tool_named("typescript").source
    assert isinstance(source, OwnInstaller)
    assert package["devDependencies"] == {"typescript": source.pinned}


def test_lines_have_the_length_of_the_tree() -> None:
    lines = [
        f"{path.relative_to(FOLDER)}:{number}"
        for path in FOLDER.rglob("*.ts")
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if len(line) > 100
    ]
    assert not lines

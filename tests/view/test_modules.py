"""The compiled modules of the page are what TypeScript makes of its sources now.

``BURNISH_UPDATE_GOLDEN=1`` writes them anew.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from burnish.targets.toolchain.tools import program

from ..suite.processes import run

FOLDER = Path(__file__).parents[2] / "targets" / "web_view"
MODULES = FOLDER / "modules"


def test_the_modules_are_those_of_the_sources(tmp_path: Path) -> None:
    node, compiler = program("node", "node"), program("typescript", "tsc")
    assert node is not None
    assert compiler is not None
    done = run([str(node), str(compiler), "-p", str(FOLDER), "--outDir", str(tmp_path)])
    assert done.stdout == "", "TypeScript refuses the sources"
    # It has made those of the host as well, which stand beside the host's sources.
    made = tmp_path / "web_view"
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        shutil.rmtree(MODULES, ignore_errors=True)
        shutil.copytree(made, MODULES)
    assert _texts(MODULES) == _texts(made)


def _texts(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in folder.glob("*.js")}


def test_lines_have_the_length_of_the_tree() -> None:
    lines = [
        f"{path.name}:{number}"
        for path in FOLDER.glob("*.ts")
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if len(line) > 100
    ]
    assert not lines

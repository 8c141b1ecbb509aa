"""Makes the projects of ``docs/integrations.md``, so that the page says what has been tried.

A block of the page that is marked with ``project=NAME file=PATH`` is that file. What a project has
besides, such as its materials, is in the folder ``projects``.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
from collections.abc import Mapping
from pathlib import Path

from burnish.targets.toolchain.tools import program

from ..docs.kit import ROOT, all_blocks

PROJECTS = Path(__file__).with_name("projects")
INTEGRATIONS = ROOT / "integrations"
PROGRAMS = Path(sys.executable).parent
"""The folder with the program ``burnish`` of the checkout."""

LANGUAGES = ("cmake", "toml", "rust", "js", "yaml")
WARNED = "material Plastic { shade = #ff8000 }\n"
"""A material with a warning, which misses a colour."""
WARNED_PLACE = ":1:20: warning"
BROKEN = "material Plastic { color = tnt(#ff8000) }\n"
"""A material with a mistake in its first line."""
PLACE = ":1:28: error"
"""What is said of it begins so, behind the name of the file."""


def project(name: str, folder: Path) -> Path:
    """Write a project of the page into a folder, which is returned."""
    shutil.copytree(PROJECTS / "materials", folder / "materials")
    if (PROJECTS / name).is_dir():
        shutil.copytree(PROJECTS / name, folder, dirs_exist_ok=True)
    for language in LANGUAGES:
        for block in all_blocks(language):
            if block.value("project") == name:
                file = folder / (block.value("file") or "")
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(block.text, encoding="utf-8")
    return folder


def environment(**more: str) -> Mapping[str, str]:
    """The environment of somebody who has activated the checkout's Python."""
    return {**os.environ, "PATH": f"{PROGRAMS}{os.pathsep}{os.environ['PATH']}", **more}


def without_burnish() -> Mapping[str, str]:
    """The environment of somebody who has Burnish on no path."""
    paths = os.environ["PATH"].split(os.pathsep)
    others = [path for path in paths if not Path(path, "burnish").exists()]
    return {**os.environ, "PATH": os.pathsep.join(others)}


def tool(name: str, file: str) -> str:
    """The path of a program of a tool, which has to be there."""
    path = program(name, file)
    assert path is not None, f"{name} is missing: make tools"
    return str(path)


def replaced(file: Path, old: str, new: str) -> None:
    """Change a file, as an editor does."""
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")


def words(text: str) -> str:
    """A text in one line: programs break the lines of messages."""
    return re.sub(r"\s+", " ", text)

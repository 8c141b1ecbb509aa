"""Exports materials and imports them again."""

from __future__ import annotations

import re
from pathlib import Path

from burnish.materialx.export.files import export
from burnish.materialx.importing import Imported, imported

MATERIALS = Path(__file__).parent / "materials"
_FILE = re.compile(r"`([^`]+)`")


def written(found: Imported, folder: Path) -> Path:
    """Write an import into a folder; gives its main file."""
    for name, content in found.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    return folder / found.main


def exported(path: Path, material: str | None = None) -> str:
    """The document of a file, whose textures have the files that their comments name."""

    def file_of(_material: str, texture: object) -> str:
        told = _FILE.search(texture.doc)  # type: ignore[attr-defined]
        return told[1] if told is not None else "picture.png"

    return export(path, material=material, file_of=file_of).text


def read_back(document: str, folder: Path, name: str) -> Path:
    """The file that importing makes of a document."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.mtlx"
    path.write_text(document)
    found = imported(path)
    assert not [problem for problem in found.problems if problem.is_error]
    return written(found, folder)


def declarations(path: Path) -> str:
    """The text of a file without the comment about it, which has the names of files."""
    lines = path.read_text().splitlines(keepends=True)
    return "".join(line for line in lines if not line.startswith("//!"))

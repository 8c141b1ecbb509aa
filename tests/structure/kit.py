"""The files of the tree, and the names that the library declares."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.semantics.names.standard_library import files_of
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse

ROOT = Path(__file__).parents[2]
LIBRARY = ROOT / "stdlib"
_GENERATED = {"__pycache__", "build", "dist", "generated"}


def files(folder: Path) -> Iterator[Path]:
    """The files below a folder that people wrote, and not tools."""
    for path in sorted(folder.iterdir()):
        generated = path.name in _GENERATED or path.name.startswith(".")
        if path.is_dir() and not generated and path.suffix != ".egg-info":
            yield from files(path)
        elif path.is_file() and not generated:
            yield path


def library_names() -> frozenset[str]:
    """Every material, light, pass, rig and term that the library declares."""
    return frozenset(
        declaration.name.text
        for path in files_of(LIBRARY)
        for declaration in parse(Source(path.name, path.read_text("utf-8")), Report()).declarations
        if isinstance(declaration, ast.Record | ast.Rig)
        or (isinstance(declaration, ast.Function) and declaration.kind == "term")
    )

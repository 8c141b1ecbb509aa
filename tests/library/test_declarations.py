"""Every declaration of the library has values from elsewhere."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.library import FOLDER
from burnish.compiler.semantics.names.standard_library import files_of, import_path
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse

from .truth import TRUTHS, load_all

ELSEWHERE = {
    "meaning": "tests/builtins holds what builtins mean against NumPy and mpmath",
    "tessellator": "its vertices are held against the reference's tessellator, as a whole",
}
"""Files whose declarations have no rows of their own, and what knows them instead."""


def declared(path: Path) -> list[str]:
    """The full names of what a file of the library declares."""
    file = parse(Source(path.name, path.read_text("utf-8")), Report())
    named = [each for each in file.declarations if not isinstance(each, ast.Import)]
    return list(dict.fromkeys(f"{import_path(path, FOLDER)}.{each.name.text}" for each in named))


FILES = files_of(FOLDER)


@pytest.mark.parametrize("path", FILES, ids=lambda path: import_path(path, FOLDER))
def test_each_declaration_is_known_from_elsewhere(path: Path) -> None:
    load_all()
    missing = [] if path.stem in ELSEWHERE else [n for n in declared(path) if n not in TRUTHS]
    assert not missing, (
        f"no test has values from elsewhere for {', '.join(missing)}; write one in tests/library"
    )


def test_truths_are_of_what_there_is() -> None:
    load_all()
    known = {name for path in FILES for name in declared(path)}
    assert sorted(TRUTHS.keys() - known) == []

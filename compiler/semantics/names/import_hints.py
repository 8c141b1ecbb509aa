"""Hints for imports that find no file."""

from __future__ import annotations

import re

from ...diagnostics.fixes import Hint, fix_it
from ...diagnostics.nearest import nearest
from ...diagnostics.source import Span
from ...syntax import ast
from .standard_library import StandardLibrary


def missing_import_hint(wanted: ast.Import, library: StandardLibrary) -> Hint:
    """The import that was probably meant by one that finds no file; empty if none is likely."""
    if wanted.quoted:
        return _add_ending(wanted)
    *folder, name = wanted.path
    if folder and library.offering(name) == ".".join(folder):
        declaration = f"{'.'.join(folder)}.{{{name}}}"
        return _instead(f"write `import {declaration}`", wanted, declaration)
    if wanted.path[0] != "std":
        return ""
    near = nearest(".".join(wanted.path), library.import_paths())
    return "" if near is None else _instead(f"did you mean `{near}`?", wanted, near)


def _add_ending(wanted: ast.Import) -> Hint:
    path = wanted.path[0]
    if path.endswith(".burnish"):
        return ""
    ending = f'"{path}.burnish"'
    return _instead(f"the ending belongs to the path: `{ending}`", wanted, ending)


def _instead(said: str, wanted: ast.Import, path: str) -> Hint:
    """A hint to import ``path``; the names that are wanted of it stay."""
    span = wanted.span
    written = re.match(r"import\s+(\"[^\"\n]*\"|[\w.]*\w)", span.text)
    if written is None:
        return said
    place = Span(span.source, span.start + written.start(1), span.start + written.end(1))
    return fix_it(said, (place, path))

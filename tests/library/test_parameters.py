"""The parameters, attributes, buffers, targets and results of the library, and slots that are
numbers, as ``parameters.txt`` lists them.

Users' hosts depend on all of these, and no formula says what they are. The list was read by people:
lengths and angles are those of the manual, and ranges end before anything has no meaning.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from burnish.compiler import library
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.semantics.names.standard_library import files_of, import_path
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse

from ..golden import assert_golden

GOLDEN = Path(__file__).parent / "parameters.txt"


def parameters() -> Iterator[str]:
    """Each of them as it is written, behind the name of its owner."""
    for path in files_of(library.FOLDER):
        name = import_path(path, library.FOLDER)
        yield from parameters_of(name, path.read_text("utf-8"))


@lru_cache(maxsize=128)
def parameters_of(name: str, text: str) -> tuple[str, ...]:
    """Those of one file. Mutants ask again for the files that they do not change."""
    found = []
    for declaration in parse(Source(name, text), Report()).declarations:
        if isinstance(declaration, ast.Record | ast.Mixin):
            for member in declaration.members:
                if said := " ".join(text[slice(*_told(member))].split()):
                    found.append(f"{name}.{declaration.name.text}: {said}")
    return tuple(found)


def _told(member: ast.Member) -> tuple[int, int]:
    """The part of a member that the list has."""
    span = member.span
    match member:
        case ast.Param() | ast.Texture() | ast.Attribute() | ast.Buffer():
            return span.start, span.end
        case ast.Slot(value=ast.Number()):
            return span.start, span.end
        case ast.Target(format=format_):
            return span.start, format_.span.end
        case ast.Result(type=type_):
            return span.start, type_.span.end
    return 0, 0


def test_parameters_are_as_they_were() -> None:
    assert_golden("\n".join(parameters()) + "\n", GOLDEN)

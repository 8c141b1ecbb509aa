"""The parameters of the library, and slots that are numbers, as ``parameters.txt`` lists them.

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
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse

from ..golden import assert_golden

GOLDEN = Path(__file__).parent / "parameters.txt"


def parameters() -> Iterator[str]:
    """Each parameter of the library as it is written, below the name of its owner."""
    for path in sorted(library.FOLDER.glob("*.burnish")):
        yield from parameters_of(path.stem, path.read_text("utf-8"))


@lru_cache(maxsize=64)
def parameters_of(name: str, text: str) -> tuple[str, ...]:
    """The parameters of one file. Mutants ask again for the files that they do not change."""
    found = []
    for declaration in parse(Source(name, text), Report()).declarations:
        if isinstance(declaration, ast.Record | ast.Mixin):
            for member in declaration.members:
                named = isinstance(member, ast.Param | ast.Texture)
                if named or (isinstance(member, ast.Slot) and isinstance(member.value, ast.Number)):
                    said = " ".join(text[member.span.start : member.span.end].split())
                    found.append(f"std.{name}.{declaration.name.text}: {said}")
    return tuple(found)


def test_parameters_are_as_they_were() -> None:
    assert_golden("\n".join(parameters()) + "\n", GOLDEN)

"""docs/library.md: what each file of the library declares, from the library's own doc comments."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.library import FOLDER
from burnish.compiler.semantics.names.standard_library import files_of, import_path
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse

from .tables import NOTE, cell, table

EXAMPLES = Path(__file__).parents[2] / "examples"
HOSTS = EXAMPLES / "hosts"
"""Copies of examples, and what other programs draw."""
LEFT_OUT = ("meaning", "tessellator")
"""Files that the compiler imports by itself: what operations mean, and how patches are divided."""

HEAD = f"""{NOTE}

# The library

Every file of the standard library, with what it declares, and examples that import it. A file
costs nothing where it is not imported. `import std.noise.{{fbm}}` imports one name, and
`import std.noise` all names of a file. What other systems call these functions is in
[builtins.md](builtins.md#names-in-other-languages).

Functions are written `name(argument: type) -> type`. A *term* is a function that sees the surface;
`per light` means that it is summed over the lights of a rig.
"""

Named = ast.Record | ast.Mixin | ast.Function | ast.Constant | ast.StructDeclaration | ast.Rig


def library_page() -> str:
    """The page, with one section for each file."""
    paths = [path for path in files_of(FOLDER) if path.stem not in LEFT_OUT]
    return HEAD + "".join(_section(path) for path in paths)


def _section(path: Path) -> str:
    """A file: its own comment, the examples that import it, and its declarations."""
    parsed = _parsed(path)
    name = import_path(path, FOLDER)
    shown = list(filter(None, map(_link, _users(name))))
    examples = f"\nExamples: {', '.join(shown)}.\n" if shown else ""
    title = f"\n## `{name}`\n\n{parsed.doc}\n{examples}"
    rows = _rows([each for each in parsed.declarations if isinstance(each, Named)])
    return title + "\n" + table(("what", ""), rows)


def _parsed(path: Path) -> ast.File:
    report = Report()
    parsed = parse(Source(path.name, path.read_text("utf-8")), report)
    assert not report.failed, path
    return parsed


def _users(name: str) -> Iterator[Path]:
    """The examples that import a file of the library."""
    imported = re.compile(rf"^import {re.escape(name)}\b(?!\.\w)", re.MULTILINE)
    found = (path for path in EXAMPLES.rglob("*.burnish") if HOSTS not in path.parents)
    for path in sorted(found):
        if imported.search(path.read_text("utf-8")):
            yield path


def _link(path: Path) -> str:
    name = path.relative_to(EXAMPLES).as_posix()
    return f"[{name.removesuffix('.burnish')}](../examples/{name})"


def _rows(declarations: Sequence[Named]) -> Iterator[tuple[str, str]]:
    """One row for each declaration; an overload without a comment stands with the one before it."""
    rows: list[tuple[str, list[str], str]] = []
    for each in declarations:
        if rows and not each.doc and rows[-1][0] == each.name.text:
            rows[-1][1].append(_head(each))
        else:
            rows.append((each.name.text, [_head(each)], each.doc))
    for _, heads, doc in rows:
        yield "<br>".join(f"`{cell(head)}`" for head in heads), cell(doc.replace("\n", " "))


def _head(declaration: Named) -> str:
    """A declaration as far as it says how it is used."""
    text = " ".join(declaration.span.text.split())
    if isinstance(declaration, ast.Function):
        return _signature(text)
    if isinstance(declaration, ast.Constant):
        return text.partition("=")[0].strip()
    return text.partition("{")[0].strip()


def _signature(text: str) -> str:
    """A function up to the `=` before its body, without the word `fn`."""
    depth = 0
    for place, letter in enumerate(text):
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if letter == "=" and not depth:
            return text[:place].strip().removeprefix("fn ")
    return text

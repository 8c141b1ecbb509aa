"""Finds the truths that may notice a change of a declaration of the library: its own, and those of
all declarations that use it, directly or not, the nearest first.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cache

from burnish.compiler import library
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.semantics.names.standard_library import files_of, import_path
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse

from .truth import TRUTHS, Test

EVERYWHERE = ("prelude", "spaces")
"""Files whose declarations are used by others that do not name them."""
WORD = re.compile(r"[a-z_]\w*", re.IGNORECASE)


def truths_about(declaration: str) -> tuple[list[Test], list[Test]]:
    """The tests that may find a change of a declaration, the likeliest first: those of it and of
    what uses it by name; and those of all else, if it is used without being named.
    """
    named = _with_users(declaration)
    others = _words() if declaration.split(".")[1] in EVERYWHERE else ()
    near, all_of_them = _truths(named), _truths([*named, *others])
    return near, all_of_them[len(near) :]


def _truths(declarations: Iterable[str]) -> list[Test]:
    """The tests of some declarations, each once."""
    return list(dict.fromkeys(test for name in declarations for test in TRUTHS.get(name, ())))


def _with_users(declaration: str) -> list[str]:
    """A declaration and those that use it, the nearest first."""
    words = _words()
    found, last = [declaration], {_own(declaration)}
    while last:
        users = [name for name, used in words.items() if used & last and name not in found]
        found += users
        last = {_own(name) for name in users}
    return found


def _own(declaration: str) -> str:
    return declaration.rpartition(".")[2]


@cache
def _words() -> Mapping[str, frozenset[str]]:
    """The words in each declaration of the library, by its full name."""
    found: dict[str, frozenset[str]] = {}
    for path in files_of(library.FOLDER):
        text = path.read_text("utf-8")
        for declaration in parse(Source(path.name, text), Report()).declarations:
            if not isinstance(declaration, ast.Import):
                span = declaration.span
                name = f"{import_path(path, library.FOLDER)}.{declaration.name.text}"
                words = WORD.findall(text[span.start : span.end])
                found[name] = found.get(name, frozenset()) | frozenset(words)
    return found

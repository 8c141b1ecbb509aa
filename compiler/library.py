"""The standard library as the compiler reads it: parsed once, kept in the content-keyed cache."""

from __future__ import annotations

import pickle
from functools import lru_cache
from pathlib import Path

from .cache import cached
from .diagnostics.diagnostic import Report
from .diagnostics.source import Source
from .semantics.modules import Module, Symbol
from .syntax import ast
from .syntax.parser import parse

FOLDER = Path(__file__).parent.parent / "stdlib"
MEANING = "meaning.burnish"


def parse_library(source: Source, report: Report) -> ast.File:
    """A library file's tree, from the cache if it has been parsed before."""

    def compute() -> bytes:
        return pickle.dumps(parse(source, report), pickle.HIGHEST_PROTOCOL)

    tree = cached("library", (_tree_shape(), source.name, source.text), compute)
    file: ast.File = pickle.loads(tree)
    return file


@lru_cache(maxsize=1)
def _tree_shape() -> str:
    """The texts that decide what a tree looks like: a tree of another shape must not be read."""
    syntax = Path(__file__).parent / "syntax"
    names = ("ast.py", "builder.py", "burnish.lark")
    return "".join((syntax / name).read_text(encoding="utf-8") for name in names)


@lru_cache(maxsize=1)
def expansions() -> tuple[Module, dict[str, tuple[Symbol, ...]]]:
    """The module of the builtins' expansions, and its functions by the builtin they stand for.

    In that module a builtin's name means the builtin, so the functions themselves stand apart.
    """
    from ..stdlib.builtins import BUILTINS  # noqa: PLC0415

    path = FOLDER / MEANING
    source = Source(MEANING, path.read_text(encoding="utf-8"))
    report = Report()
    file = parse_library(source, report)
    assert not report.failed, report.diagnostics
    module = Module(file, path)
    found: dict[str, tuple[Symbol, ...]] = {}
    for declaration in file.declarations:
        assert not isinstance(declaration, ast.Import)
        name = declaration.name.text
        names = found if name in BUILTINS else module.declared
        names[name] = (*names.get(name, ()), Symbol(declaration, module))
    return module, found

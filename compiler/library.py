"""Reads the standard library, and keeps its syntax trees in the user's cache, keyed by content.

The front end asks for ``standard_library``, the files that are imported from ``std``. Semantics
asks for ``conversions``, and the passes that expand builtins ask for ``expansion``.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Mapping
from functools import cache, lru_cache, wraps
from io import BytesIO
from pathlib import Path
from threading import RLock
from typing import TypeVar

from .cache import cached
from .diagnostics.diagnostic import Diagnostic, Report
from .diagnostics.source import Source
from .semantics.names.modules import Module, Symbol
from .semantics.names.standard_library import StandardLibrary
from .syntax import ast
from .syntax.load import load_source
from .syntax.parser import parse

FOLDER = Path(__file__).parent.parent / "stdlib"
_READERS = ("builder.py", "burnish.lark")
"""The files of ``syntax`` that decide, besides those of ``ast``, what a tree looks like."""
MEANING = "meaning.burnish"
CONVERSIONS = "spaces.burnish"

T = TypeVar("T")

_MAKING = RLock()


def once(make: Callable[[], T]) -> Callable[[], T]:
    """A function that returns what ``make`` returned to the first caller; other threads wait for
    it.

    Modules and their symbols are compared by identity, so no compile may see two of the same.
    """
    kept = lru_cache(maxsize=1)(make)

    @wraps(make)
    def made() -> T:
        with _MAKING:
            return kept()

    return made


_kept: dict[Path, StandardLibrary] = {}
"""The libraries in use by their folders: one, but in tests."""


def standard_library(folder: Path) -> StandardLibrary:
    """The library in a folder, linked; the same for all compiles, as long as no file changes."""
    with _MAKING:
        library = _kept.get(folder)
        if library is None or not library.is_current():
            library = _kept[folder] = StandardLibrary(folder, parse_library, load_source)
        return library


def parse_library(source: Source, report: Report) -> ast.File:
    """A library file's tree, from the cache if it has been parsed before; ``report`` gets its
    diagnostics."""
    file, diagnostics = _parsed(source.name, source.text)
    report.extend(diagnostics)
    return file


@lru_cache(maxsize=64)
def _parsed(name: str, text: str) -> tuple[ast.File, tuple[Diagnostic, ...]]:
    def compute() -> bytes:
        report = Report()
        tree = parse(Source(name, text), report)
        return pickle.dumps((tree, report.diagnostics), pickle.HIGHEST_PROTOCOL)

    stored = cached("library", (_tree_shape(), name, text), compute)
    found: tuple[ast.File, tuple[Diagnostic, ...]] = pickle.loads(stored)
    return found


@lru_cache(maxsize=1)
def _tree_shape() -> str:
    """All texts that decide what a tree looks like: they are part of the cache's keys."""
    here = Path(__file__)
    syntax = here.parent / "syntax"
    deciding = (here, *sorted((syntax / "ast").glob("*.py")), *map(syntax.joinpath, _READERS))
    return "".join(path.read_text(encoding="utf-8") for path in deciding)


@once
def conversions() -> Module:
    """The module with the functions that convert values from one space to another."""
    path = FOLDER / CONVERSIONS
    report = Report()
    file = parse_library(Source(f"std/{CONVERSIONS}", path.read_text(encoding="utf-8")), report)
    assert not report.failed, report.diagnostics
    module = Module(file, path)
    for declaration in file.declarations:
        assert not isinstance(declaration, ast.Import)
        name = declaration.name.text
        others = module.declared.get(name, ())
        module.declared[name] = (*others, Symbol(declaration, module))
    return module


def expansion(function: str) -> tuple[Symbol, ...]:
    """The functions of that name in the file of the builtins' expansions."""
    with _MAKING:
        return _expansion(function)


@cache
def _expansion(function: str) -> tuple[Symbol, ...]:
    module, trees = _meaning()
    return _symbols(trees[function], module)


@once
def _meaning() -> tuple[Module, Mapping[str, bytes]]:
    """The module of the builtins' expansions, and the trees of its functions by their names.

    A compile needs few of many expansions, so trees are read one by one. In that module a builtin's
    name means the builtin itself, so only the other functions, which help them, are declared in it.
    """
    from ..stdlib.builtins import BUILTINS

    path = FOLDER / MEANING
    source = Source(f"std/{MEANING}", path.read_text(encoding="utf-8"))
    trees = cached("library", (_tree_shape(), "each", source.text), lambda: _each(source))
    module = Module(ast.File(source, edition=1, doc="", declarations=()), path)
    expanding = {name for row in BUILTINS.values() for name in (row.expansion, row.definition)}
    module.declared.update(
        {name: _symbols(tree, module) for name, tree in trees.items() if name not in expanding}
    )
    return module, trees


def _each(source: Source) -> dict[str, bytes]:
    """The trees of a file's declarations by their names, each for itself."""
    report = Report()
    declared: dict[str, list[ast.Declaration]] = {}
    for declaration in parse(source, report).declarations:
        assert not isinstance(declaration, ast.Import)
        declared.setdefault(declaration.name.text, []).append(declaration)
    assert not report.failed, report.diagnostics
    trees = {}
    for name, overloaded in declared.items():
        stream = BytesIO()
        _TreePickler(stream, pickle.HIGHEST_PROTOCOL).dump(overloaded)
        trees[name] = stream.getvalue()
    return trees


def _symbols(tree: bytes, module: Module) -> tuple[Symbol, ...]:
    declarations = _TreeUnpickler(BytesIO(tree), module.file.source).load()
    return tuple(Symbol(declaration, module) for declaration in declarations)


class _TreePickler(pickle.Pickler):
    """Writes a part of a file's tree without the source, which all parts of it share."""

    def persistent_id(self, part: object) -> str | None:
        return "source" if isinstance(part, Source) else None


class _TreeUnpickler(pickle.Unpickler):
    """Reads what ``_TreePickler`` has written."""

    def __init__(self, stream: BytesIO, source: Source) -> None:
        super().__init__(stream)
        self._source = source

    def persistent_load(self, _: str) -> Source:
        return self._source

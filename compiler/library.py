"""Reads and links the standard library.

The front end asks for ``standard_library``, the files that are imported from ``std``. Semantics
asks for ``conversions`` and for the ``tessellator``, and the passes that expand builtins ask for
``expansion``. The syntax trees are usually made when the package is built (``library_trees.py``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, lru_cache, wraps
from pathlib import Path
from typing import TypeVar

from ..support.locks import reentrant_lock
from .diagnostics.source import Source
from .library_trees import (
    declarations,
    declarations_to_generate,
    flawless,
    parse_library,
    tree_to_generate,
)
from .precomputed import Precomputations
from .semantics.names.modules import Module, Named, Symbol
from .semantics.names.standard_library import StandardLibrary, files_of
from .syntax import ast
from .syntax.load import load_source
from .syntax.stored import loaded

FOLDER = Path(__file__).parent.parent / "stdlib"
MEANING = "meaning.burnish"
CONVERSIONS = "spaces.burnish"
TESSELLATOR = "tessellator.burnish"

T = TypeVar("T")

_MAKING = reentrant_lock()


def once(make: Callable[[], T]) -> Callable[[], T]:
    """A function that keeps the result of the first call of ``make``; other threads wait for it.

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


def trees_to_generate() -> Precomputations:
    """The trees that are made when the package is built: those of all files."""
    made: dict[str, Callable[[], object]] = {}
    for path in files_of(FOLDER):
        source = Source(path.name, path.read_text(encoding="utf-8"))
        one_by_one = path.name == MEANING
        made |= declarations_to_generate(source) if one_by_one else tree_to_generate(source)
    return made


@once
def conversions() -> Module:
    """The module with the functions that convert values from one space to another."""
    return _alone(CONVERSIONS)


@once
def tessellator() -> Module:
    """The module with the functions that say where the vertices of a divided patch lie."""
    return _alone(TESSELLATOR)


def _alone(name: str) -> Module:
    """A file of the library that imports nothing, as a module that the compiler itself uses."""
    path = FOLDER / name
    file = flawless(Source(f"std/{name}", path.read_text(encoding="utf-8")), parse_library)
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
    trees = declarations(source)
    module = Module(ast.File(source, edition=1, doc="", declarations=()), path)
    expanding = {name for row in BUILTINS.values() for name in (row.expansion, row.definition)}
    module.declared.update(
        {name: _symbols(tree, module) for name, tree in trees.items() if name not in expanding}
    )
    return module, trees


def _symbols(tree: bytes, module: Module) -> tuple[Symbol, ...]:
    declarations: list[Named] = loaded(tree, module.file.source)
    return tuple(Symbol(declaration, module) for declaration in declarations)

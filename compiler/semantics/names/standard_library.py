"""The modules of the standard library, which are the same for every compile of a process.

``compiler/library.py`` makes one ``StandardLibrary`` and keeps it. Each compile's ``Loader`` takes
the prelude and the modules that files import from ``std`` from there. This is safe, because linking
is the only thing that changes a module, and a module of the library can name only modules of the
library. Symbols are compared by identity, so all compiles see the same ones.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Protocol

from ....support.locks import reentrant_lock
from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ...diagnostics.source import Source, Span
from ...syntax import ast
from .declarations import declare_all
from .imports import import_names
from .modules import Module, Offer, Offers

_PRELUDE = "prelude.burnish"
_NOT_IMPORTED = frozenset({"std.prelude", "std.meaning", "std.spaces"})
"""Library files that every file sees, or none."""


_LINKING = reentrant_lock()
"""Held while modules are linked: no thread sees half of one."""


class Parse(Protocol):
    """Parses a file; mistakes go into the report."""

    def __call__(self, source: Source, report: Report, /) -> ast.File: ...


class Read(Protocol):
    """Reads a file, which messages call ``name``; ``None`` after reporting at ``span`` why not."""

    def __call__(
        self, path: Path, report: Report, name: str = "", span: Span | None = None, /
    ) -> Source | None: ...


class StandardLibrary:
    """Reads and links the files of the library, each when it is first wanted."""

    def __init__(self, folder: Path, parse: Parse, read: Read) -> None:
        self.folder = folder
        self.report = Report()
        """The errors in the library itself: none, unless somebody is changing it."""
        self._parse = parse
        self._read = read
        self._modules: dict[str, Module] = {}
        """The modules by their paths within the folder; all of them are linked."""
        self._begun: dict[str, Module] = {}
        """The linked modules, and those that are being linked just now."""
        self._imports: dict[str, list[str]] = {}
        """The files that each linked module imports, by their paths within the folder."""
        self._stamps: dict[Path, tuple[int, int]] = {}
        self._offers: dict[str, list[Offer]] | None = None
        prelude = self.module(_PRELUDE)
        assert prelude is not None, "the library has no prelude"
        self.prelude: Module = prelude

    @property
    def files(self) -> tuple[Path, ...]:
        """The files that have been read."""
        return tuple(self._stamps)

    def behind(self, relative: str = _PRELUDE) -> Iterator[Path]:
        """A file of the library with all that it imports, among them the prelude."""
        pending, seen = [_PRELUDE, relative], set[str]()
        while pending:
            name = pending.pop()
            if name not in seen:
                seen.add(name)
                pending += self._imports.get(name, ())
                yield self.folder / name

    def is_current(self) -> bool:
        """True if the files that were read have not changed since."""
        try:
            return all(_stamp(path) == stamp for path, stamp in list(self._stamps.items()))
        except OSError:
            return False

    def module(self, relative: str) -> Module | None:
        """The module in a file of the library; ``None`` if there is no such file."""
        known = self._modules.get(relative)
        if known is None:
            with _LINKING:
                known = self._linked(relative)
                self._modules.update(self._begun)
        return known

    def offers(self) -> Offers:
        """What the files of the library declare that can be imported, by name."""
        if self._offers is None:
            self._offers = {}
            for name, offer in self._offered():
                self._offers.setdefault(name, []).append(offer)
        return self._offers

    def import_paths(self) -> list[str]:
        """The import paths of all library files that can be imported."""
        paths = (import_path(path, self.folder) for path in files_of(self.folder))
        return [path for path in paths if path not in _NOT_IMPORTED]

    def _offered(self) -> Iterator[tuple[str, Offer]]:
        """The names that library files declare.

        Those of files in folders within are left out: they are what other systems call so, and
        whoever writes one by hand is better off with the library's own.
        """
        for path in (path for path in self.import_paths() if path.count(".") == 1):
            source = self._source(in_library(path.split(".")))
            tree = None if source is None else self._parse(source, Report())
            for declaration in () if tree is None else tree.declarations:
                if not isinstance(declaration, ast.Import):
                    yield declaration.name.text, Offer(path, _kind(declaration))

    def _linked(self, relative: str) -> Module | None:
        """A module with all its names. Library files import each other hardly deeper than once."""
        if relative in self._begun:
            return self._begun[relative]
        source = self._source(relative)
        if source is None:
            return None
        prelude = self._begun.get(_PRELUDE)
        path = self.folder / relative
        module = Module(self._parse(source, self.report), path, is_standard=True, prelude=prelude)
        # Known before it is linked: the files that the prelude imports see the prelude as well.
        self._begun[relative] = module
        imports = declare_all(module, self.report)
        self._imports[relative] = [in_library(each.path) for each in imports if not each.quoted]
        for wanted in imports:
            found = None if wanted.quoted else self._linked(in_library(wanted.path))
            if found is None:
                shown = ".".join(wanted.path)
                self.report.add(rules.MISSING_IMPORT, wanted.span, path=shown, hint="")
            import_names(module, wanted, found, self.report)
        return module

    def _source(self, relative: str) -> Source | None:
        path = self.folder / relative
        if not path.is_file():
            return None
        self._stamps[path] = _stamp(path)
        return self._read(path, self.report, f"std/{relative}")


def _kind(declaration: ast.Declaration) -> str:
    """The word with which something is declared, as messages call it."""
    if isinstance(declaration, ast.Mixin):
        return "mixin"
    return declaration.kind if isinstance(declaration, ast.Record | ast.Function) else ""


def files_of(folder: Path) -> list[Path]:
    """The files of the library in a folder, also those in folders within it."""
    return sorted(folder.rglob("*.burnish"))


def import_path(file: Path, folder: Path) -> str:
    """The path by which a file of the library in a folder is imported: ``std.mtlx.noise``."""
    return ".".join(("std", *file.relative_to(folder).with_suffix("").parts))


def in_library(path: Sequence[str]) -> str:
    """The file that an import path such as ``std.mtlx.noise`` is about: ``mtlx/noise.burnish``."""
    return "/".join((*path[1:-1], f"{path[-1]}.burnish"))


def _stamp(path: Path) -> tuple[int, int]:
    status = os.stat(path)  # noqa: PTH116 - Each compile asks; a path's own method takes twice as long.
    return status.st_mtime_ns, status.st_size

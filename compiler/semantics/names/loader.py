"""Reads a user's files and links them: looks imports up, and gives each file its names.

The front end makes a ``Loader`` for each compile. Import paths are looked up beside the importing
file (quoted ones) and in the search path, and never lead out of the folder they start from. What is
imported from ``std`` comes from the ``StandardLibrary``, which is linked already.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path, PurePosixPath
from posixpath import normpath
from stat import S_ISDIR, S_ISREG
from typing import Protocol

from ....support.frozen import record
from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ...diagnostics.file_names import why_unreadable
from ...diagnostics.fixes import Hint, fix_it
from ...diagnostics.nearest import nearest
from ...diagnostics.source import Source, Span
from ...syntax import ast
from .declarations import declare_all
from .imports import import_names
from .modules import Module
from .standard_library import Parse, Read, StandardLibrary, in_library

_ENDING = ".burnish"


def missing_import_hint(
    wanted: ast.Import, library: StandardLibrary, beside: Sequence[str] = ()
) -> Hint:
    """The import that was probably meant by one that finds no file; empty if none is likely.

    ``beside`` are the names of files where it was looked for.
    """
    if wanted.quoted:
        return _add_ending(wanted) or _quoted_near(wanted, beside)
    *folder, name = wanted.path
    offers = library.offers().get(name, ()) if folder else ()
    if any(offer.path == ".".join(folder) for offer in offers):
        declaration = f"{'.'.join(folder)}.{{{name}}}"
        return _instead(f"write `import {declaration}`", wanted, declaration)
    if wanted.path[0] != "std":
        return _near(wanted, name, library, beside)
    near = nearest(".".join(wanted.path), library.import_paths())
    return "" if near is None else _instead(f"did you mean `{near}`?", wanted, near)


def _near(wanted: ast.Import, name: str, library: StandardLibrary, beside: Sequence[str]) -> Hint:
    """A file beside that is nearly called so, or the library's of this name."""
    within = f"std.{'.'.join(wanted.path)}"
    near = nearest(name, filter(str.isidentifier, _stems(beside)))
    if within in library.import_paths():
        meant = within
    elif near is not None:
        meant = ".".join((*wanted.path[:-1], near))
    else:
        return ""
    return _instead(f"did you mean `{meant}`?", wanted, meant)


def _stems(beside: Sequence[str]) -> Iterator[str]:
    """The names of Burnish files, without their ending."""
    return (each.removesuffix(_ENDING) for each in beside if each.endswith(_ENDING))


def _quoted_near(wanted: ast.Import, beside: Sequence[str]) -> Hint:
    """A file beside that is nearly called so."""
    path = PurePosixPath(wanted.path[0])
    near = nearest(path.stem, _stems(beside))
    if near is None:
        return ""
    meant = f'"{path.with_name(near + _ENDING)}"'
    return _instead(f"did you mean `{meant}`?", wanted, meant)


def _without_detours(path: str) -> str:
    """A path without the folders that it enters and leaves again: `sub/../c.burnish`."""
    return normpath(path) if ".." in PurePosixPath(path).parts else path


def _add_ending(wanted: ast.Import) -> Hint:
    path = wanted.path[0]
    if path.endswith(_ENDING):
        return ""
    ending = f'"{path}{_ENDING}"'
    return _instead(f"the ending belongs to the path: `{ending}`", wanted, ending)


def _instead(said: str, wanted: ast.Import, path: str) -> Hint:
    """A hint to import ``path``; the names that are wanted of it stay."""
    span = wanted.span
    written = re.match(r"import\s+(\"[^\"\n]*\"|[\w.]*\w)", span.text)
    if written is None:
        return said
    place = Span(span.source, span.start + written.start(1), span.start + written.end(1))
    return fix_it(said, (place, path))


LONGEST_CYCLE = 8
"""The number of files of a cycle that a message names."""


class Files(Protocol):
    """Answers what is there, and is told of each place where an imported file was looked for."""

    def real(self, path: Path, /) -> str:
        """The path without links; one that goes round in links stays as it is."""

    def mode(self, path: Path, /) -> int | None:
        """The kind of file at a path; ``None`` if there is none. Raises ``OSError``."""

    def names(self, folder: Path, /) -> Sequence[str]:
        """Some of the names in a folder; none if it cannot be read."""

    def looked(self, root: Path, path: Path, /, *, found: bool) -> None:
        """``path`` below ``root`` was looked at; ``found`` says whether a file is there."""

    def of_library(self, paths: Iterable[Path], /) -> None:
        """These files of the library are read, if not for this compile, then for an earlier one."""


@record
class _Linking:
    """A module whose imports are being read."""

    module: Module
    imports: list[ast.Import]
    """The imports that are left, the last one first."""
    path: Path | None = None
    """The path that it was read from, if another module imports it."""
    wanted: ast.Import | None = None
    """The import by which that module does so."""


class Loader:
    """Reads and links modules; each file once."""

    def __init__(
        self,
        report: Report,
        library: StandardLibrary,
        search_path: Sequence[Path],
        parse: Parse,
        read: Read,
        files: Files,
    ) -> None:
        self._report = report
        self._library = library
        self._search_path = tuple(search_path)
        self._parse = parse
        self._read = read
        self._files = files
        self._modules: dict[Path, Module] = {}
        self._loading: dict[Path, str] = {}
        """The files whose imports are being read, with their names in messages.

        Each is imported by the one before it.
        """
        self._real: dict[Path, Path] = {}
        """Folders without links, as far as anybody has asked.

        They are kept, since the system goes through all of a path each time.
        """
        report.extend(library.report.diagnostics)

    @property
    def files(self) -> tuple[Path, ...]:
        """The imported files that were read, and those of the library."""
        return (*self._modules, *self._library.files)

    def main(self, source: Source, path: Path | None) -> Module:
        """The module that a user compiles."""
        self._files.of_library(self._library.behind())
        if path is not None:
            self._loading[self._without_links(path)] = source.name
        module = Module(
            self._parse(source, self._report), path, prelude=self._library.prelude,
            offers=self._library.offers,
        )  # fmt: skip
        self._link(module)
        return module

    def _link(self, module: Module) -> None:
        """Give a module its names, and those that it imports, file after file.

        Files import each other without limit, so those whose imports are not all known yet wait in
        a list.
        """
        pending = [_Linking(module, self._declared(module))]
        while pending:
            top = pending[-1]
            if top.imports:
                wanted = top.imports.pop()
                found = self._resolve(top.module, wanted)
                if isinstance(found, _Linking):
                    pending.append(found)
                else:
                    import_names(top.module, wanted, found, self._report)
                continue
            pending.pop()
            if top.path is not None:
                assert top.wanted is not None
                del self._loading[top.path]
                self._modules[top.path] = top.module
                import_names(pending[-1].module, top.wanted, top.module, self._report)

    def _declared(self, module: Module) -> list[ast.Import]:
        """Give a module its own names; its imports, the last one first."""
        return declare_all(module, self._report)[::-1]

    def _resolve(self, module: Module, wanted: ast.Import) -> Module | _Linking | None:
        """The module that an import is about, if need be before it is linked."""
        if not wanted.quoted and wanted.path[0] == "std":
            return self._from_library(wanted)
        written = wanted.path[0] if wanted.quoted else "/".join(wanted.path) + _ENDING
        relative = _without_detours(written)
        if PurePosixPath(relative).is_absolute() or ".." in PurePosixPath(relative).parts:
            self._report.add(rules.IMPORT_ESCAPES, wanted.span, path=written)
            return None
        for root in self._roots(module):
            try:
                found = root / relative
                path = self._without_links(found)
                if not path.is_relative_to(self._resolved(root)):
                    self._report.add(rules.IMPORT_ESCAPES, wanted.span, path=relative)
                    return None
                mode = self._files.mode(found)
            except (OSError, ValueError) as error:
                self._report.add(
                    rules.UNREADABLE_FILE, wanted.span, path=relative, reason=why_unreadable(error)
                )
                return None
            self._files.looked(root, found, found=mode is not None)
            if mode is not None and self._is_file(mode, wanted, found):
                return self._load(found, path, wanted)
            if mode is not None:
                return None
        folders = (root / PurePosixPath(relative).parent for root in self._roots(module))
        beside = [name for folder in folders for name in self._files.names(folder)]
        self._report_missing(wanted, relative, beside)
        return None

    def _is_file(self, mode: int, wanted: ast.Import, found: Path) -> bool:
        """True if an import has found a file; anything else is reported, and not opened."""
        if S_ISDIR(mode):
            self._report.add(rules.NOT_A_FILE, wanted.span, path=found)
        elif not S_ISREG(mode):
            reason = "it is a pipe or a device"
            self._report.add(rules.UNREADABLE_FILE, wanted.span, path=found, reason=reason)
        return S_ISREG(mode)

    def _from_library(self, wanted: ast.Import) -> Module | None:
        inside = in_library(wanted.path)
        found = self._of_library(inside)
        if found is None:
            self._report_missing(wanted, f"std/{inside}")
        return found

    def _of_library(self, inside: str) -> Module | None:
        """A file of the library; mistakes in it are told, and in those that it imports."""
        found = self._library.module(inside)
        if found is not None:
            self._files.of_library(self._library.behind(inside))
        self._report.extend(self._library.report.diagnostics)
        return found

    def _report_missing(
        self, wanted: ast.Import, relative: str, beside: Sequence[str] = ()
    ) -> None:
        hint = missing_import_hint(wanted, self._library, beside)
        self._report.add(rules.MISSING_IMPORT, wanted.span, path=relative, hint=hint)

    def _resolved(self, folder: Path) -> Path:
        """A folder that files are looked for in, without links."""
        if folder not in self._real:
            self._real[folder] = self._without_links(folder)
        return self._real[folder]

    def _without_links(self, path: Path) -> Path:
        return Path(self._files.real(path))

    def _roots(self, module: Module) -> Iterator[Path]:
        if module.path is not None:
            yield module.path.parent
        yield from self._search_path

    def _load(self, found: Path, path: Path, wanted: ast.Import) -> Module | _Linking | None:
        if path in self._modules:
            return self._modules[path]
        if path in self._loading:
            self._report.add(rules.IMPORT_CYCLE, wanted.span, cycle=self._cycle(path))
            return None
        library = self._resolved(self._library.folder)
        if path.is_relative_to(library):
            return self._of_library(path.relative_to(library).as_posix())
        source = self._read(found, self._report, str(found), wanted.span)
        if source is None:
            return None
        self._loading[path] = source.name
        module = Module(self._parse(source, self._report), path, prelude=self._library.prelude)
        return _Linking(module, self._declared(module), path, wanted)

    def _cycle(self, path: Path) -> str:
        """The files that import each other, from the one at ``path`` to itself, in words."""
        pending = list(self._loading)
        steps = pending[pending.index(path) :]
        names = [step.name for step in steps]
        if len(set(names)) < len(names):
            names = [self._loading[step] for step in steps]
        if len(names) > LONGEST_CYCLE:
            left_out = len(names) - LONGEST_CYCLE
            half = LONGEST_CYCLE // 2
            names = [*names[:half], f"{left_out} more", *names[-half:]]
        return " → ".join([*names, names[0]])

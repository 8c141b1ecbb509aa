"""Opens files and texts: reads them with all that they import, as modules that can be compiled.

``Frontend`` opens one file, or one text, by this.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path

from .diagnostics import rules
from .diagnostics.diagnostic import Report
from .diagnostics.file_names import readable
from .diagnostics.source import Compared, Source, Span
from .inputs import Inputs
from .semantics.inheritance.flattening import records_of
from .semantics.names.loader import Loader
from .semantics.names.modules import Module, Symbol
from .semantics.names.standard_library import StandardLibrary
from .syntax import ast
from .syntax.incremental import parse
from .syntax.load import TOTAL_LIMIT, check_text, decoded, load_source

MOST_PROGRAMS = 256
"""The largest number of materials, kernels and frames of a file.

Each takes up to 0.03 s to compile for all targets.
"""
MOST_RECORDS = 1024
"""The largest number of a file's records that extend others or are extended.

Each of them is put together with all that it extends.
"""


class Opening:
    """Reads a file or a text, and the files that it imports."""

    def __init__(
        self, report: Report, library: StandardLibrary, search_path: Sequence[Path], inputs: Inputs
    ) -> None:
        """``inputs`` has a note of everything that is read, or has it all from an earlier time."""
        self._inputs = inputs
        folders = []
        for folder in search_path:
            if self._inputs.is_folder(folder):
                self._inputs.searched(folder)
                folders.append(folder)
            else:
                report.add(rules.MISSING_FOLDER, None, path=folder)
        self._base = _without_links(folders[0]) if folders else ""
        """The folder from which outputs count the names of files."""
        self._size = 0
        """The number of characters that have been read, of all files."""
        self._compared = Compared()
        self._report = report
        self._loader = Loader(report, library, folders, parse, self._read, self._inputs)

    def open_file(self, path: Path) -> Module | None:
        """The module in a file; ``None`` after reporting that it cannot be read, or is too much."""
        with suppress(ValueError):  # No file has such a name, which is told when it is read.
            self._base = _without_links(path.parent)
        source = self._read(path, self._report)
        return None if source is None else self._limited(self._loader.main(source, path))

    def _read(
        self, path: Path, report: Report, name: str = "", span: Span | None = None
    ) -> Source | None:
        """The text of a file, and a note that it was read."""
        if self._size > TOTAL_LIMIT:
            return None  # This has been reported of the file that was too much.
        known = self._inputs.content(path)
        if known is None:
            source = load_source(path, report, name, span, partial(self._inputs.read, path))
        else:
            source = decoded(known, readable(name or str(path)), report, span)
        if source is None:
            return None
        source.portable = self._portable(path)
        source.compared = self._compared
        self._size += len(source.text)
        if self._size > TOTAL_LIMIT:
            limit = f"{TOTAL_LIMIT} characters"
            report.add(rules.TOO_MUCH_IMPORTED, span, path=source.name, limit=limit)
            return None
        return source

    def _portable(self, path: Path) -> str:
        """The name of a file in outputs: the same, whatever folder the compiler runs in."""
        place = os.path.join(_without_links(path.parent), path.name)  # noqa: PTH118
        try:
            return readable(os.path.relpath(place, self._base).replace(os.sep, "/"))
        except ValueError:  # On Windows, no path leads from one drive to another.
            return ""

    def open_text(self, text: str, name: str) -> Module | None:
        """The module in a text; its quoted imports are looked up along the search path.

        ``None`` after reporting that the text does not consist of characters, or is too much.
        """
        if not check_text(text, name, self._report):
            return None
        return self._limited(self._loader.main(Source(name, text, compared=self._compared), None))

    def _limited(self, module: Module) -> Module | None:
        """A module to compile, or ``None`` after reporting that it makes too much of it."""
        kinds = ("material", "kernel", "frame")
        programs = [each for kind in kinds for each in records_of(module, kind, abstract=False)]
        found = (each for symbols in module.declared.values() for each in symbols)
        records = [s for s in found if isinstance(s.declaration, ast.Record | ast.Mixin)]
        are_few = self._are_few(
            module, programs, "materials, kernels and frames", MOST_PROGRAMS
        ) and self._are_few(module, records, "records and mixins", MOST_RECORDS)
        return module if are_few else None

    def _are_few(self, module: Module, symbols: Sequence[Symbol], kinds: str, most: int) -> bool:
        """True if a module declares no more of something than is possible; reported if not."""
        if len(symbols) <= most:
            return True
        names = sorted((each.declaration.name.span for each in symbols), key=lambda at: at.start)
        self._report.add(
            rules.TOO_MANY_DECLARED, names[most],
            path=module.file.source.name, count=len(symbols), kinds=kinds, most=most,
        )  # fmt: skip
        return False

    @property
    def files(self) -> tuple[Path, ...]:
        """The files imported so far, down to those of the library."""
        return self._loader.files


def _without_links(folder: Path) -> str:
    return os.path.realpath(folder)

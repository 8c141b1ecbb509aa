"""The files that one server of ``burnish view`` shows: one, or all of a folder.

A page names a file by its path within the folder. Such a name is looked up here among those that
were found, and never becomes a path itself.
"""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from pathlib import Path
from threading import Lock
from typing import Any

from ...api import entry_points as api
from ...compiler.diagnostics.diagnostic import CompileError
from ..catalogue import ENDING, Group, catalogue, is_shown

_PATIENCE = 2.0
"""The seconds for reading files for one list. The remaining files are listed without their
declarations, which a later list has."""
_MOST_SUBJECTS = 32
"""The most names that are listed of one file."""


class Folder:
    """The files that are shown. Threads may share a ``Folder``."""

    def __init__(self, root: Path, search_path: Sequence[Path]) -> None:
        """``root`` is a file or a folder."""
        self._root = root
        self._search_path = search_path
        self._lock = Lock()
        self._declared: dict[Path, tuple[int, list[str] | None]] = {}
        """The time of each file's last change, and its declarations that can be drawn."""
        self._groups: Sequence[Group] = ()
        self._paths: dict[str, Path] = {}
        """The paths of files, by the names that pages have for them."""
        self._is_folder = root.is_dir()
        self._find()

    def first(self) -> str | None:
        """The name of the file to begin with; ``None`` if nothing in the folder can be drawn."""
        with self._lock:
            if not self._is_folder:
                return next(iter(self._paths))
            return next((name for name, path in self._paths.items() if self._subjects(path)), None)

    def path(self, name: str) -> Path | None:
        """The path of a file, by its name; ``None`` if there is none."""
        with self._lock:
            path = self._paths.get(name)
        # By now the file may be a link.
        is_own = not self._is_folder or (path and is_shown(path, self._root.resolve(), ENDING))
        return path if is_own else None

    def listing(self) -> list[dict[str, Any]]:
        """The files of the folder that can be drawn, as they are now, for the page's list."""
        with self._lock:
            self._find()
            self._read_all(time.monotonic() + _PATIENCE)
            groups = []
            for group in self._groups:
                files = [
                    {"name": _shown(each.name), "what": each.what, "subjects": subjects}
                    for each in group.files
                    if (subjects := self._declared.get(each.path, (0, []))[1]) is not None
                ]
                if files:
                    groups.append({"title": group.title, "files": files})
            return groups

    def _find(self) -> None:
        """Look for files."""
        if not self._is_folder:
            self._paths = {_shown(self._root.name): self._root}
            return
        self._groups = catalogue(self._root)
        self._paths = {
            _shown(each.name): each.path for group in self._groups for each in group.files
        }
        found = set(self._paths.values())
        self._declared = {path: row for path, row in self._declared.items() if path in found}

    def _read_all(self, end: float) -> None:
        """Read files that have changed, until the time is over."""
        for path in self._paths.values():
            self._subjects(path)
            if time.monotonic() > end:
                return

    def _subjects(self, path: Path) -> list[str] | None:
        """The frames, materials and kernels of a file; ``None`` if it declares none.

        There are none of a file that cannot be read, either.
        """
        try:
            stamp = path.stat().st_mtime_ns
        except OSError:
            return None
        known = self._declared.get(path)
        if known is None or known[0] != stamp:
            known = self._declared[path] = stamp, self._read(path)
        return known[1]

    def _read(self, path: Path) -> list[str] | None:
        try:
            declared = api.declared(path, search_path=self._search_path)
        except CompileError:
            return []  # The syntax is wrong.
        names = *declared.frames, *declared.materials, *declared.kernels
        return list(names[:_MOST_SUBJECTS]) or None


def _shown(name: str) -> str:
    """A name for pages: bytes that are no UTF-8 are written as their numbers."""
    return os.fsencode(name).decode("utf-8", "backslashreplace")

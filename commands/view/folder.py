"""The files that one server of ``burnish view`` shows: one, or all of a folder.

A page names a file by its path within the folder. Such a name is looked up here among those that
were found, and never becomes a path itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from threading import Lock
from typing import Any

from ... import api
from ...compiler.diagnostics.diagnostic import CompileError
from ..catalogue import ENDING, Group, Listed, catalogue, is_shown


class Folder:
    """What is shown. Threads may share it."""

    def __init__(self, root: Path, search_path: Sequence[Path]) -> None:
        """``root`` is a file or a folder."""
        self._root = root
        self._search_path = search_path
        self._lock = Lock()
        self._declared: dict[Path, tuple[int, list[str] | None]] = {}
        """When each file was changed last, and what it declares that can be drawn."""
        self._groups: Sequence[Group] = ()
        self._find()

    @property
    def is_folder(self) -> bool:
        """Whether there is something to choose from."""
        return self._root.is_dir()

    def first(self) -> str | None:
        """The name of the file to begin with; ``None`` if nothing in the folder can be drawn."""
        if not self.is_folder:
            return self._root.name
        with self._lock:
            drawn = (each.name for each in self._files() if self._subjects(each.path))
            return next(drawn, None)

    def path(self, name: str) -> Path | None:
        """Where a file is, by its name; ``None`` if there is none."""
        if not self.is_folder:
            return self._root if name == self._root.name else None
        with self._lock:
            path = next((each.path for each in self._files() if each.name == name), None)
        # By now it may be a link.
        return path if path and is_shown(path, self._root.resolve(), ENDING) else None

    def listing(self) -> list[dict[str, Any]]:
        """The files of the folder that can be drawn, as they are now, for the page's list."""
        with self._lock:
            self._find()
            groups = []
            for group in self._groups:
                files = [
                    {"name": each.name, "what": each.what, "subjects": subjects}
                    for each in group.files
                    if (subjects := self._subjects(each.path)) is not None
                ]
                if files:
                    groups.append({"title": group.title, "files": files})
            return groups

    def _find(self) -> None:
        """Look for files."""
        if self.is_folder:
            self._groups = catalogue(self._root)

    def _files(self) -> Iterator[Listed]:
        return (each for group in self._groups for each in group.files)

    def _subjects(self, path: Path) -> list[str] | None:
        """The frames, materials and kernels of a file; ``None`` if it declares none. Of a file that
        cannot be read, nobody knows any."""
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
            return []  # Its syntax is wrong.
        return [*declared.frames, *declared.materials, *declared.kernels] or None

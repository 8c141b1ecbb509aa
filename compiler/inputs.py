"""Records all files that a compile has read, and the paths where it has looked in vain.

The front end fills this record while it reads. As long as all of it is unchanged, compiling the
same file with the same options gives the same result, which ``api/remembered.py`` relies on within
a process, and ``commands/results.py`` from one process to the next. And whatever changes, the same
can be compiled once more from the record itself, which ``api/compiling.py`` does.
"""

from __future__ import annotations

import os
from itertools import islice
from stat import S_IFREG, S_ISREG

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path


_MOST_NAMES = 1000
"""The names of a folder that are looked at to find what a misspelt import means."""


class Inputs:
    """Files and folders that a compile depends on.

    Keys of ``contents`` are paths without links, keys of the others are paths as they were asked
    for: relative ones are relative to the current folder.
    """

    def __init__(self) -> None:
        self.contents: dict[str, bytes | None] = {}
        """The content of files that were read; ``None`` where a file was looked for and is none."""
        self.links: dict[str, str] = {}
        """The target of each path, after following links."""
        self.folders: list[str] = []
        """The folders of the search path; each of them is there."""
        self.library: dict[str, None] = {}
        """The files of the library that were imported, or are imported by those.

        A change of Burnish itself is noticed elsewhere: these are for build systems.
        """

    def real(self, path: Path) -> str:
        """The path without links; one that goes round in links stays as it is."""
        return os.path.realpath(path)

    def mode(self, path: Path) -> int | None:
        """The kind of file at a path; ``None`` if there is none. Raises ``OSError``."""
        try:
            return path.stat().st_mode
        except (FileNotFoundError, NotADirectoryError):
            return None

    def is_folder(self, path: Path) -> bool:
        """True if there is a folder, whatever the path looks like."""
        return os.path.isdir(path)  # noqa: PTH112

    def names(self, folder: Path) -> list[str]:
        """The names in a folder, for a hint about one that is not there; not more than a few."""
        try:
            with os.scandir(folder) as entries:
                return sorted(entry.name for entry in islice(entries, _MOST_NAMES))
        except OSError:
            return []

    def content(self, path: Path) -> bytes | None:  # noqa: ARG002 - of the disk, nothing is known
        """The content of a file, if it need not be read."""
        return None

    def read(self, path: Path, content: bytes) -> None:
        """Notes that the file at ``path`` was read, and its content."""
        self.contents.setdefault(self._real(path), content)

    def looked(self, root: Path, path: Path, *, found: bool) -> None:
        """Note that ``path`` was looked for below ``root``, and whether there is a file."""
        self._real(root)
        real = self._real(path)
        if not found:
            self.contents.setdefault(real, None)

    def of_library(self, paths: Iterable[Path]) -> None:
        """Note files of the library."""
        self.library.update(dict.fromkeys(map(str, paths)))

    def searched(self, folder: Path) -> None:
        """Note a folder of the search path."""
        self.folders.append(str(folder))

    def _real(self, path: Path) -> str:
        asked = str(path)
        known = self.links.get(asked)
        if known is None:
            known = self.links[asked] = os.path.realpath(path)
        return known

    def joined(self, others: Iterable[Inputs]) -> Inputs:
        """All that several compiles depend on together, in the same folder."""
        found = Inputs()
        for each in (self, *others):
            for path, content in each.contents.items():
                found.contents.setdefault(path, content)
            found.links |= each.links
            found.folders += each.folders
            found.library |= each.library
        return found

    def are_current(self) -> bool:
        """True if all of it is found again, and is the same."""
        return unchanged(self.contents, self.links, self.folders)


class Recorded(Inputs):
    """Files as they were when a compile noted them, whatever has become of them since.

    A compile that reads from here, of the same file with the same options, asks for the same again.
    """

    def __init__(self, noted: Inputs) -> None:
        super().__init__()
        self._noted = noted

    def real(self, path: Path) -> str:
        """The path without links, as it was; the library's files were not noted."""
        return self._noted.links.get(str(path)) or super().real(path)

    def mode(self, path: Path) -> int | None:
        """The kind of a regular file, unless one was looked for in vain."""
        is_missing = self._noted.contents.get(self.real(path), b"") is None
        return None if is_missing else S_IFREG

    def is_folder(self, path: Path) -> bool:
        """True for the folders of the search path, which were all there."""
        return str(path) in self._noted.folders

    def names(self, folder: Path) -> list[str]:  # noqa: ARG002 - the record has no folder's names
        """No names: what was compiled once lacks no file."""
        return []

    def content(self, path: Path) -> bytes | None:
        """The content that was read; ``None`` for a file of the library."""
        return self._noted.contents.get(self.real(path))

    def read(self, path: Path, content: bytes) -> None:
        """Note nothing: it is known."""

    def of_library(self, paths: Iterable[Path]) -> None:
        """Note nothing, likewise."""

    def looked(self, root: Path, path: Path, *, found: bool) -> None:
        """Note nothing, likewise."""


def unchanged(
    contents: Mapping[str, bytes | None], links: Mapping[str, str], folders: Iterable[str]
) -> bool:
    """True if all of what a record has noted is found again, and is the same. Nothing is raised."""
    try:
        return (
            all(map(os.path.isdir, folders))
            and all(os.path.realpath(path) == real for path, real in links.items())
            and all(_holds(path, content) for path, content in contents.items())
        )
    except (OSError, ValueError):
        return False


def _holds(path: str, content: bytes | None) -> bool:
    """True if a file has this content or, with ``None``, if there is no file. Raises ``OSError``.

    A pipe or a device can be read only once, which is left to the compile.
    """
    try:
        status = os.stat(path)  # noqa: PTH116
    except (FileNotFoundError, NotADirectoryError):
        return content is None
    is_file = S_ISREG(status.st_mode)
    if content is None or not is_file:
        return content is None and not is_file
    return status.st_size == len(content) and _read(path, len(content) + 1) == content


def _read(path: str, most: int) -> bytes:
    """Up to so many bytes of a file: at once, since a stream takes longer to make than to read."""
    file = os.open(path, os.O_RDONLY | getattr(os, "O_BINARY", 0))
    try:
        return os.read(file, most)
    finally:
        os.close(file)

"""Records all files that a compile has read, and the paths where it has looked in vain.

The front end fills this record while it reads. As long as all of it is unchanged, compiling the
same file with the same options gives the same result, which ``commands/results.py`` relies on.
"""

from __future__ import annotations

import os
from pathlib import Path


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

    def read(self, path: Path, content: bytes) -> None:
        """Notes that the file at ``path`` was read, and its content."""
        self.contents.setdefault(self._real(path), content)

    def looked(self, root: Path, path: Path, *, found: bool) -> None:
        """Note that ``path`` was looked for below ``root``, and whether there is a file."""
        self._real(root)
        real = self._real(path)
        if not found:
            self.contents.setdefault(real, None)

    def searched(self, folder: Path) -> None:
        """Note a folder of the search path."""
        self.folders.append(str(folder))

    def _real(self, path: Path) -> str:
        asked = str(path)
        known = self.links.get(asked)
        if known is None:
            known = self.links[asked] = os.path.realpath(path)
        return known

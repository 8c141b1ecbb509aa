"""The pictures that a document names: found in its folder, and copied beside the imported file."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path
from typing import NamedTuple

FOLDER = "textures"
FIRST = {"<UDIM>": "1001", "<UVTILE>": "u1_v1"}
"""The tokens in the names of sets of files, and what the name of the first file has there."""
LARGEST = 256 << 20
"""The most bytes of a picture that is copied."""
_PLAIN = re.compile(r"[^A-Za-z0-9._-]+")


class Picture(NamedTuple):
    """A picture as it is written: its path beside the imported file, and its bytes."""

    path: str
    content: bytes


class Pictures:
    """Looks for pictures in some folders and in nothing outside of them."""

    def __init__(self, folders: Sequence[Path]) -> None:
        self._folders = folders
        self._found: dict[Path, Picture] = {}

    def found(self, name: str) -> Picture | None:
        """The picture with this path in one of the folders; nothing if there is none that may be
        read. Of a set of files for the squares of a chart, it is the first one."""
        for token, tile in FIRST.items():
            name = name.replace(token, tile)
        for folder, wanted in product(self._folders, _ends(name)):
            root = folder.resolve()
            try:
                path = (root / wanted).resolve()
                if path.is_relative_to(root) and path.is_file() and path.stat().st_size <= LARGEST:
                    return self._copied(path)
            except (OSError, ValueError):
                continue
        return None

    def _copied(self, path: Path) -> Picture:
        if path not in self._found:
            taken = {picture.path for picture in self._found.values()}
            name = _PLAIN.sub("_", path.name)
            number = 2
            wanted = f"{FOLDER}/{name}"
            while wanted in taken:
                wanted = f"{FOLDER}/{number}_{name}"
                number += 1
            self._found[path] = Picture(wanted, path.read_bytes())
        return self._found[path]


def _ends(name: str) -> Iterator[str]:
    """The path as it stands; if it leads elsewhere, what is left
    of it without its first folders."""
    parts = name.replace("\\", "/").split("/")
    yield "/".join(parts)
    if ".." in parts or name.startswith("/"):
        for start in range(1, len(parts)):
            if parts[start] != "..":
                yield "/".join(parts[start:])

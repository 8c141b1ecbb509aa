"""The pictures that a document names: found in its folder, and copied beside the imported file."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import product
from pathlib import Path
from typing import NamedTuple

FOLDER = "textures"
FIRST = 1001
"""The number of the first square of a chart. Ten are beside each other; the next are above them."""
MOST_ROWS = 100
"""The most rows of squares for which files of a set are looked for."""
_IN_ROW = 10
_TOKENS: dict[str, Callable[[int], str]] = {
    "<UDIM>": str,
    "<UVTILE>": lambda tile: f"u{(tile - FIRST) % _IN_ROW + 1}_v{(tile - FIRST) // _IN_ROW + 1}",
}
"""The tokens in the names of sets of files, and what the name of a square's file has there."""
LARGEST_TOGETHER = 2 << 30
"""The most bytes of all pictures that are copied together, which are in memory at once."""
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
        self._tiles: dict[str, tuple[int, ...]] = {}
        self.too_large: set[str] = set()
        """The names of pictures that are there, and were not copied because of their size."""

    def found(self, name: str) -> Picture | None:
        """The picture with this path in one of the folders; nothing if there is none that may be
        read. Of a set of files for the squares of a chart, it is the first one."""
        (first,) = files_of_set(name, (FIRST,)) or (name,)
        for folder, wanted in product(self._folders, _ends(first)):
            path = _inside(folder.resolve(), wanted)
            if path is None:
                continue
            if self._fits(path):
                self.too_large.discard(name)
                return self._copied(path)
            self.too_large.add(name)
        return None

    def tiles(self, name: str) -> tuple[int, ...]:
        """The squares of a chart for which a set of files has files; none for one file."""
        if name not in self._tiles:
            self._tiles[name] = self._tiles_of(name) if is_set(name) else ()
        return self._tiles[name]

    def _tiles_of(self, name: str) -> tuple[int, ...]:
        numbers = range(FIRST, FIRST + _IN_ROW * MOST_ROWS)
        for folder, wanted in product(self._folders, _ends(name)):
            root, files = folder.resolve(), files_of_set(wanted, numbers)
            pairs = zip(numbers, files, strict=True)
            found = tuple(number for number, file in pairs if _inside(root, file) is not None)
            if found:
                return found
        return ()

    def _fits(self, path: Path) -> bool:
        size = path.stat().st_size
        left = LARGEST_TOGETHER - sum(len(picture.content) for picture in self._found.values())
        return path in self._found or size <= min(LARGEST, left)

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


def is_set(name: str) -> bool:
    """True for the name of a set of files, one for each square of a chart."""
    return any(token in name for token in _TOKENS)


def without_tokens(name: str) -> str:
    """The name of a set of files without what differs between them."""
    for token in _TOKENS:
        name = name.replace(token, "")
    return name


def files_of_set(name: str, tiles: Iterable[int]) -> tuple[str, ...]:
    """The names of the files of a set for some squares; none if it is no set."""
    if not is_set(name):
        return ()
    files = []
    for tile in tiles:
        file = name
        for token, spelled in _TOKENS.items():
            file = file.replace(token, spelled(tile))
        files.append(file)
    return tuple(files)


def _inside(root: Path, wanted: str) -> Path | None:
    """The file with this path in a folder; nothing if there is none, or if it lies elsewhere."""
    try:
        if (root / wanted).is_file():
            path = (root / wanted).resolve()
            return path if path.is_relative_to(root) else None
    except (OSError, ValueError):  # Too long, or with characters that no path has.
        pass
    return None


def _ends(name: str) -> Iterator[str]:
    """The path as it stands; if it leads elsewhere, what is left
    of it without its first folders."""
    parts = name.replace("\\", "/").split("/")
    yield "/".join(parts)
    if ".." in parts or name.startswith("/"):
        for start in range(1, len(parts)):
            if parts[start] != "..":
                yield "/".join(parts[start:])

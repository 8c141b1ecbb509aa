"""Keeps results that are costly to compute, in files whose names are digests of their ingredients.

It exists besides ``compiler/cache.py`` because these results decide whether tests pass: names have
160 bits instead of 64, so that no two agree by accident. Because there are many results, those that
have not been used for longest are deleted. So a run that makes more than there is room for finds
nothing of itself when it is repeated; results are compressed, as pictures shrink to a third or
less, which takes a few milliseconds where drawing them takes a hundred. A store only saves time: if
its folder cannot be read or written, or is not this user's alone, it is empty.
"""

from __future__ import annotations

import os
import zlib
from collections.abc import Iterator
from contextlib import suppress
from hashlib import blake2b
from itertools import chain
from pathlib import Path

from ...compiler.cache import private_files, private_folder, read_private, write_private

LIMIT = 1 << 30
"""The approximate number of bytes that a store may hold."""
KEPT = 0.75
"""The part of the limit that remains after deleting, so that not every write has to delete."""
CHECK_EVERY = 1 << 26
"""The number of written bytes after which a process examines the whole folder again."""

_DIGEST_SIZE = 20
_COMPRESSION = 1
"""The fastest level of zlib; higher ones take several times as long, and save little."""


def digest(*ingredients: str | bytes) -> str:
    """The name of a result that depends on these ingredients, in this order, and on nothing
    else."""
    total = blake2b(digest_size=_DIGEST_SIZE)
    for item in ingredients:
        # File names may have bytes that are no text, which Python decodes to surrogates.
        data = item.encode("utf-8", "surrogatepass") if isinstance(item, str) else item
        total.update(len(data).to_bytes(8, "little"))
        total.update(data)
    return total.hexdigest()


def digest_of_sources(*folders: Path) -> str:
    """The digest of all Python and JavaScript code below some folders."""
    return digest(*chain.from_iterable(map(_sources, folders)))


def _sources(folder: Path) -> Iterator[str | bytes]:
    """The names and contents of the files of code below a folder."""
    for path in sorted(folder.rglob("*")):
        if path.suffix in (".py", ".mjs", ".js"):
            yield str(path.relative_to(folder))
            yield path.read_bytes()


_UNCHECKED: dict[Path, int] = {}
"""The bytes that this process has written into a folder since it last examined the folder, which
takes long. The first write examines it."""


class Store:
    """A folder of results, which several processes may use at the same time."""

    def __init__(self, name: str, limit: int = LIMIT) -> None:
        """The store called ``name`` in Burnish's cache folder; ``limit`` is in bytes.

        A store with the limit 0 keeps nothing, and leaves the files in its folder as they are.
        """
        self.folder = Path(private_folder()) / name
        self._limit = limit

    def read(self, name: str) -> bytes | None:
        """The data with this name, if it exists and is not damaged."""
        path = self._path(name)
        content = read_private(str(path))
        if content is None:
            return None
        try:
            data = zlib.decompress(content[_DIGEST_SIZE:])
        except zlib.error:
            return None
        if _checksum(data) != content[:_DIGEST_SIZE]:
            return None
        with suppress(OSError):
            os.utime(path)
        return data

    def write(self, name: str, data: bytes) -> None:
        """Keep data under a name; no reader ever sees half of it."""
        if not self._limit:
            return
        path = self._path(name)
        compressed = zlib.compress(data, _COMPRESSION)
        with suppress(OSError):
            write_private(str(path), _checksum(data) + compressed)
        unchecked = _UNCHECKED.get(self.folder)
        if unchecked is None or unchecked > min(CHECK_EVERY, self._limit):
            self.prune()
            unchecked = 0
        _UNCHECKED[self.folder] = unchecked + len(compressed)

    def prune(self) -> None:
        """Delete the files that have not been used for longest, if the store is above its limit."""
        files = sorted(self._files(), reverse=True)
        if sum(size for _, size, _ in files) <= self._limit:
            return
        total = 0
        for _, size, path in files:
            total += size
            if total > KEPT * self._limit:
                with suppress(OSError):
                    os.unlink(path)  # noqa: PTH108 - Paths would take longer than all the rest.

    def _path(self, name: str) -> Path:
        return self.folder / name[:2] / name[2:]

    def _files(self) -> Iterator[tuple[int, int, str]]:
        """The time of last use, size and path of each file; includes files of killed processes."""
        with suppress(OSError):
            for folder, _ in private_files(str(self.folder)):
                with suppress(OSError):
                    for path, status in private_files(folder):
                        yield status.st_mtime_ns, status.st_size, path


def _checksum(data: bytes) -> bytes:
    return blake2b(data, digest_size=_DIGEST_SIZE).digest()

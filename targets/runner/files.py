"""Opens files that a user names, or that a received file names.

They may be anything: a pipe that nobody writes to, a device that never ends, a file of many
gigabytes. Pictures, scenes and the elements of buffers are read by this module, so that all of them
refuse these in the same words.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from ...compiler.budget import check


class FileError(ValueError):
    """A file cannot be read; the text tells people why."""


def read_file(path: Path, name: str, limit: str = "file", *, links: bool = True) -> bytes:
    """All bytes of a file.

    ``name`` is the file's name in errors, and ``limit`` the row of the budget for the number of
    bytes. Without ``links`` no link is followed: a name in a received file may be a link to
    anything. Raises ``FileError`` and ``BudgetError``.
    """
    with opened(path, name, limit, links=links) as file:
        size = os.fstat(file.fileno()).st_size
        data = file.read(size + 1)
    if len(data) > size:
        raise FileError(f"cannot read {name}: it grows while it is read")
    return data


@contextmanager
def opened(path: Path, name: str, limit: str = "file", *, links: bool = True) -> Iterator[BinaryIO]:
    """A file that is open for reading, and has no more bytes than the budget allows.

    Raises ``FileError``, also if reading fails inside the ``with`` block, and ``BudgetError``.
    """
    if "\0" in os.fspath(path):
        raise FileError(f"cannot read {name}: a name has no character NUL")
    try:
        with regular(path, name, links=links) as file:
            check(limit, os.fstat(file.fileno()).st_size, f"{name} has")
            yield file
    except OSError as error:
        raise FileError(f"cannot read {name}: {error.strerror or error}") from None


@contextmanager
def regular(path: Path, name: str, *, links: bool = True) -> Iterator[BinaryIO]:
    """A file of any size that is open for reading, for callers with limits of their own.

    Raises ``FileError`` for what is no file, and ``OSError``.
    """
    # Opening a device can have effects, so it is not even tried.
    _check_regular(path.stat(follow_symlinks=links), name)
    with open(path, "rb", opener=_without_waiting if links else _without_links) as file:
        # Something else may have been put in its place since.
        _check_regular(os.fstat(file.fileno()), name)
        yield file


def _check_regular(status: os.stat_result, name: str) -> None:
    if stat.S_ISLNK(status.st_mode):
        raise FileError(f"cannot read {name}: it is a link, and links are not followed there")
    if not stat.S_ISREG(status.st_mode):
        raise FileError(f"cannot read {name}: it is not a file")


def _without_waiting(path: str, flags: int) -> int:
    """Open a file without waiting for a writer, should the file have become a pipe."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def _without_links(path: str, flags: int) -> int:
    """Open a file without waiting for a writer; fails if the file has become a link."""
    return _without_waiting(path, flags | getattr(os, "O_NOFOLLOW", 0))

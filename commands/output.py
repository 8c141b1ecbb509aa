"""Writes the files of a command to a folder: either all of them or none."""

from __future__ import annotations

import errno
import os
import stat
import time
from collections.abc import Mapping
from pathlib import Path

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import CompileError, Report
from .replacing import ON_WINDOWS, PATIENCE, replace_all
from .results import encoded


def obstacle(folder: Path, file: str = "") -> str | None:
    """Why a folder, which need not exist yet, or a file in it cannot be written; else ``None``.

    Commands ask this before work that takes long. ``None`` does not guarantee that writing
    succeeds.
    """
    try:
        if file and (folder / file).is_dir():
            return "it is a folder"
        if file and _is_stream(folder / file):
            return None
        nearest = next(path for path in (folder, *folder.absolute().parents) if path.exists())
    except OSError as error:
        return error.strerror
    if not nearest.is_dir():
        return f"`{nearest}` is a file, not a folder"
    if os.access(nearest, os.W_OK | os.X_OK):
        return None
    if hasattr(os, "statvfs") and os.statvfs(nearest).f_flag & os.ST_RDONLY:
        return os.strerror(errno.EROFS)
    return f"nobody but its owner may write into `{nearest}`"


def write_all(folder: Path, texts: Mapping[str, str]) -> None:
    """Write each text under its name, or raise ``CompileError`` and change nothing."""
    try:
        replace_all(str(folder), encoded(texts))
    except OSError as error:
        raise unwritable(Path(error.filename), error.strerror) from error


def write_file(path: Path, content: bytes) -> None:
    """Write the file that a user has named, completely or not at all; raises ``OSError``.

    A link is replaced, not followed: whoever has made the folder could have it lead to any file. A
    device or a pipe, such as ``/dev/null``, is written to; it is not replaced by a file.
    """
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, "it is a folder", str(path))
    if _is_stream(path):
        _write_to_stream(path, content)
    else:
        replace_all(str(path.parent), {path.name: content})


def _is_stream(path: Path) -> bool:
    """Whether what is there is to be written to, and not to be replaced.

    That are devices and pipes, and whatever the system itself has in its folder of devices, such
    as ``/dev/stdout``, which is a link to an open file.
    """
    try:
        mode = path.lstat().st_mode
    except OSError:
        return False
    folder = os.path.realpath(path.parent)
    is_of_system = folder in ("/dev", "/dev/fd") or folder.startswith("/proc/")
    return is_of_system or stat.S_ISCHR(mode) or stat.S_ISFIFO(mode)


def _write_to_stream(path: Path, content: bytes) -> None:
    """Write to a device or a pipe; raises ``TimeoutError`` if nobody begins to read a pipe."""
    give_up = time.monotonic() + PATIENCE
    while True:
        try:
            with open(path, "wb", opener=_without_waiting) as file:
                file.write(content)
            return
        except OSError as error:
            if error.errno != errno.ENXIO:
                raise
        if time.monotonic() > give_up:
            unread = f"nobody has begun to read it within {PATIENCE:g} seconds"
            raise TimeoutError(errno.ETIMEDOUT, unread, str(path))
        time.sleep(0.005)


def _without_waiting(path: str, flags: int) -> int:
    """Open a pipe or a device to write to it; ``OSError`` says ``ENXIO`` if nobody reads it."""
    if ON_WINDOWS:
        return os.open(path, flags)
    file = os.open(path, flags | os.O_NONBLOCK | os.O_NOCTTY)
    os.set_blocking(file, True)
    return file


def unwritable(path: Path, reason: str) -> CompileError:
    """The error to raise if an output cannot be written."""
    report = Report()
    report.add(rules.UNWRITABLE_OUTPUT, None, path=path, reason=reason)
    return CompileError(report.diagnostics)

"""Writes the files of a command to a folder: either all of them or none."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import CompileError, Report
from .answering import collector
from .replacing import ForeignFileError, replace_all, replace_tree
from .results import encoded

if TYPE_CHECKING:
    from .ownership import Ownership


def obstacle(folder: Path, file: str = "") -> str | None:
    """The reason why a folder, or a file in it, cannot be written; else ``None``.

    The folder need not exist yet. Commands ask this before long work. ``None`` does not guarantee
    that writing succeeds.
    """
    try:
        if file:
            if not (folder / file).is_symlink() and (folder / file).is_dir():
                return "it is a folder"
            if _is_device(folder / file):
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


def write_all(
    folder: Path, texts: Mapping[str, str | bytes], guard: Ownership | None = None
) -> None:
    """Write each text under its name, or raise ``CompileError`` and change nothing."""
    try:
        replace_all(str(folder), encoded(texts), guard)
    except ForeignFileError as error:
        raise foreign(Path(error.filename), str(error.strerror)) from error
    except OSError as error:
        raise unwritable(Path(error.filename), error.strerror or str(error)) from error
    _note(folder / name for name in texts)


def write_tree(folder: Path, contents: Mapping[str, bytes]) -> None:
    """Write each content under its path, with slashes, or raise ``CompileError`` and change
    nothing."""
    named = {tuple(path.split("/")): content for path, content in contents.items()}
    try:
        replace_tree(str(folder), named)
    except OSError as error:
        raise unwritable(Path(error.filename), error.strerror or str(error)) from error
    _note(folder / path for path in contents)


def write_file(path: Path, content: bytes) -> None:
    """Write the file that a user has named, completely or not at all; raises ``OSError``.

    A link is replaced: it may have come with the folder, and lead anywhere. A device or a pipe is
    written to, such as ``/dev/null``, ``/dev/stdout`` or a result of ``mkfifo``.
    """
    if _is_device(path):
        _write_to_device(path, content)
    else:
        folder, name = os.path.split(path)
        replace_all(folder or os.curdir, {name: content})
    _note([path])


def _write_to_device(path: Path, content: bytes) -> None:
    """Write to a device, or to a pipe that somebody reads.

    Without a reader, writing might wait for ever. If the path leads to a file after all, as
    ``/dev/stdout`` may, its contents stay.
    """
    without_waiting = getattr(os, "O_NONBLOCK", 0)
    try:
        file = os.open(path, os.O_WRONLY | os.O_APPEND | without_waiting)
    except OSError as error:
        if error.errno == errno.ENXIO:
            raise OSError(error.errno, "nobody reads this pipe", str(path)) from None
        raise
    with os.fdopen(file, "wb") as stream:
        if without_waiting:
            os.set_blocking(file, True)
        stream.write(content)


def _note(paths: Iterable[Path]) -> None:
    """Let the answer of the command name these files, if it is wanted as JSON."""
    if (collected := collector()) is not None:
        collected.write(map(str, paths))


def _is_device(path: Path) -> bool:
    """True for a device, a pipe, or a link of the system's own to any open file.

    ``/dev/stdout`` is such a link: it is written through, and never replaced.
    """
    try:
        mode = path.lstat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        return False
    if stat.S_ISLNK(mode):
        folder = os.path.realpath(path.parent)
        return folder in ("/dev", "/dev/fd") or folder.startswith("/proc/")
    return stat.S_ISCHR(mode) or stat.S_ISFIFO(mode)


def foreign(path: Path, reason: str) -> CompileError:
    """The error to raise if a file of somebody else would be overwritten."""
    report = Report()
    report.add(rules.FOREIGN_OUTPUT, None, path=path, reason=reason)
    return CompileError(report.diagnostics)


def unwritable(path: Path, reason: str) -> CompileError:
    """The error to raise if an output cannot be written."""
    report = Report()
    report.add(rules.UNWRITABLE_OUTPUT, None, path=path, reason=reason)
    return CompileError(report.diagnostics)

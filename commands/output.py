"""Writes the files of a command to a folder: either all of them or none."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Mapping
from pathlib import Path

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import CompileError, Report
from .replacing import replace_all
from .results import encoded


def obstacle(folder: Path, file: str = "") -> str | None:
    """Why a folder, which need not exist yet, or a file in it cannot be written; else ``None``.

    Commands ask this before work that takes long. ``None`` does not guarantee that writing
    succeeds.
    """
    try:
        if file:
            if (folder / file).is_dir():
                return "it is a folder"
            if _is_device(folder / file):
                return None
            if (folder / file).is_symlink():
                folder = Path(os.path.realpath(folder / file)).parent
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
    except IsADirectoryError as error:
        raise unwritable(Path(error.filename), error.strerror or str(error)) from error
    except OSError as error:
        raise unwritable(folder, error.strerror or str(error)) from error


def write_file(path: Path, content: bytes) -> None:
    """Write the file that a user has named, completely or not at all; raises ``OSError``.

    A link is followed. A device or a pipe, such as ``/dev/null``, is written to; it is not replaced
    by a file.
    """
    if _is_device(path):
        path.write_bytes(content)
        return
    folder, name = os.path.split(os.path.realpath(path))
    replace_all(folder, {name: content})


def _is_device(path: Path) -> bool:
    """Whether something is there that is neither a file nor a folder."""
    try:
        mode = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def unwritable(path: Path, reason: str) -> CompileError:
    """The error to raise if an output cannot be written."""
    report = Report()
    report.add(rules.UNWRITABLE_OUTPUT, None, path=path, reason=reason)
    return CompileError(report.diagnostics)

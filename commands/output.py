"""Writes the files of a command to a folder: either all of them or none."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import CompileError, Report
from .results import put_in_place


def obstacle(folder: Path, file: str = "") -> str | None:
    """Why a folder, which need not exist yet, or a file in it cannot be written; else ``None``.

    Commands ask this before work that takes long. ``None`` does not guarantee that writing
    succeeds.
    """
    try:
        nearest = next(path for path in (folder, *folder.absolute().parents) if path.exists())
        if file and (folder / file).is_dir():
            return "it is a folder"
    except OSError as error:
        return error.strerror
    if not nearest.is_dir():
        return f"`{nearest}` is a file, not a folder"
    allowed = os.access(nearest, os.W_OK | os.X_OK)
    return None if allowed else f"nobody but its owner may write into `{nearest}`"


def write_all(folder: Path, texts: Mapping[str, str]) -> None:
    """Write each text under its name, or raise ``CompileError`` and change nothing."""
    blocked = next((name for name in texts if (folder / name).is_dir()), None)
    if blocked is not None:
        raise unwritable(folder / blocked, "it is a folder")
    try:
        put_in_place(str(folder), texts)
    except OSError as error:
        raise unwritable(folder, error.strerror or str(error)) from error


def unwritable(path: Path, reason: str) -> CompileError:
    """The error to raise if an output cannot be written."""
    report = Report()
    report.add(rules.UNWRITABLE_OUTPUT, None, path=path, reason=reason)
    return CompileError(report.diagnostics)

"""``burnish compile --watch``: does something again whenever one of a file's sources changes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import click

from ..compiler.diagnostics.diagnostic import Report
from ..compiler.frontend import Frontend

_POLL = 1000
"""Milliseconds after which files are looked at even without news of them."""

Stamps = dict[Path, int]


def watch(file: Path, search_path: Sequence[Path], act: Callable[[], object]) -> None:
    """Call ``act`` now and after each change to ``file`` or what it imports; never returns.

    The folders are watched and not the files, as editors put a new file in the old one's place.
    """
    try:
        from watchfiles import watch as changes
    except ImportError:
        raise click.UsageError("--watch needs one more package: pip install watchfiles") from None
    while True:
        folders = _folders(file, search_path)
        before = _stamps(file, folders)
        act()
        wakings = changes(*folders, recursive=False, yield_on_timeout=True, rust_timeout=_POLL)
        next(waking for waking in wakings if _stamps(file, folders) != before)


def _folders(file: Path, search_path: Sequence[Path]) -> list[Path]:
    """Where the file and its imports lie, including those that only need mending to be found."""
    frontend = Frontend(Report(), search_path)
    frontend.open_file(file)
    files = (file, *frontend.files)
    folders = dict.fromkeys((*(path.parent for path in files), *search_path))
    return [folder for folder in folders if folder.is_dir()]


def _stamps(file: Path, folders: Sequence[Path]) -> Stamps:
    """When each source in the folders was last changed: compared, no change is ever missed."""
    sources = {file, *(path for folder in folders for path in folder.glob("*.burnish"))}
    return {path: path.stat().st_mtime_ns for path in sources if path.is_file()}

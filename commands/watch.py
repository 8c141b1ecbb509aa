"""``burnish compile --watch``: compiles again whenever one of a file's sources changes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path

import click

from ..compiler.diagnostics.diagnostic import Report
from ..compiler.frontend import Frontend

_POLL = 1000
"""After how many milliseconds files are examined even if no change was reported."""

Stamps = dict[Path, int]


def watch(file: Path, search_path: Sequence[Path], act: Callable[[], object]) -> None:
    """Call ``act`` now and after each change to ``file`` or its imports; never returns.

    It watches folders, not files, because editors replace a file by a new one.
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
    """The folders of the file and its imports, also of imports that cannot be found yet."""
    frontend = Frontend(Report(), search_path)
    frontend.open_file(file)
    files = (file, *frontend.files)
    folders = dict.fromkeys((*(path.parent for path in files), *search_path))
    return [folder for folder in folders if folder.is_dir()]


def _stamps(file: Path, folders: Sequence[Path]) -> Stamps:
    """When each source in the folders was last changed. Comparing these never misses a change."""
    sources = {file, *(path for folder in folders for path in folder.glob("*.burnish"))}
    stamps = {}
    for path in sources:
        with suppress(OSError, ValueError):  # It may be gone by now, or never have been there.
            stamps[path] = path.stat().st_mtime_ns
    return stamps

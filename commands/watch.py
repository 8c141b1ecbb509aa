"""Waits until the sources of a file have changed.

``burnish compile --watch`` compiles again after each change, and ``burnish view`` draws again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..compiler.diagnostics.diagnostic import Report
from ..compiler.frontend import Frontend

if TYPE_CHECKING:
    from threading import Event

_POLL = 1000
"""After how many milliseconds files are examined even if no change was reported."""
_STEP = 10
"""How many milliseconds nothing may be reported until a change counts as complete: an editor
writes a file in several steps, and nobody wants to wait."""

Stamps = dict[Path, int]


def watch(file: Path, search_path: Sequence[Path], act: Callable[[], object]) -> None:
    """Call ``act`` now and after each change to ``file`` or its imports; never returns.

    Raises ``UsageError`` if the package that watches is not installed.
    """
    try:
        import watchfiles  # noqa: F401
    except ImportError:
        raise click.UsageError("--watch needs one more package: pip install watchfiles") from None
    for _ in states(file, search_path):
        act()


def states(
    file: Path, search_path: Sequence[Path], others: Sequence[Path] = (), stop: Event | None = None
) -> Iterator[None]:
    """Yield now and after each change to ``file``, its imports or ``others``, until ``stop`` is
    set.

    It watches folders, not files, because editors replace a file by a new one.
    """
    from watchfiles import watch as changes

    while True:
        folders = _folders(file, search_path, others)
        before = _stamps(file, folders, others)
        yield
        wakings = changes(
            *folders, recursive=False, yield_on_timeout=True, rust_timeout=_POLL, step=_STEP,
            debounce=_POLL, stop_event=stop,
        )  # fmt: skip
        if not any(_stamps(file, folders, others) != before for _ in wakings):
            return


def _folders(file: Path, search_path: Sequence[Path], others: Sequence[Path]) -> list[Path]:
    """The folders of the file and its imports, also of imports that cannot be found yet."""
    frontend = Frontend(Report(), search_path)
    frontend.open_file(file)
    files = (file, *frontend.files, *others)
    folders = dict.fromkeys((*(path.parent for path in files), *search_path))
    return [folder for folder in folders if folder.is_dir()]


def _stamps(file: Path, folders: Sequence[Path], others: Sequence[Path]) -> Stamps:
    """When each source in the folders was last changed. Comparing these never misses a change."""
    sources = {file, *others, *(path for folder in folders for path in folder.glob("*.burnish"))}
    stamps = {}
    for path in sources:
        with suppress(OSError, ValueError):  # It may be gone by now, or never have been there.
            stamps[path] = path.stat().st_mtime_ns
    return stamps

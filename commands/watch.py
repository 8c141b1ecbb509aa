"""Finds the files that have changed: one watcher for everything that a command compiles or shows.

``burnish compile --watch`` compiles again after each change, and ``burnish view`` draws again.
"""

from __future__ import annotations

import os
import stat
import time
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from threading import Event, Lock
from typing import Generic, TypeVar

import click

from ..compiler.diagnostics.diagnostic import Report
from ..compiler.frontend import Frontend
from ..compiler.inputs import Inputs
from ..support.installing import install_command
from .console import remark

_POLL = 1000
"""The milliseconds after which files are examined even if no change was reported: file systems of
other computers report none."""
_STEP = 20
"""The milliseconds without reports after which a change is complete: an editor writes a file in
several steps, and nobody wants to wait."""
_POLL_ALONE = 0.3
"""The seconds after which files are examined if the system fails to report changes; then it is
asked again."""
_TELL_AFTER = 3
"""The number of such failures after which a message is printed."""
_REST = 20
"""The rest after examining all files, as a factor of the time that this took. So not even very many
files, or a folder that never rests, keep a processor busy."""

Key = TypeVar("Key", bound=Hashable)
Stamp = tuple[int, ...] | None
"""The data by which a changed file is recognised; ``None`` if there is no file."""


def watch(
    files: Sequence[Path],
    search_path: Sequence[Path],
    act: Callable[[], object],
    further: Sequence[Path] = (),
) -> None:
    """Call ``act`` now and after each change to one of the files or its imports; never returns.

    ``further`` are files of another kind on which everything depends.
    Raises ``UsageError`` if the package that watches is not installed.
    """
    try:
        import watchfiles  # noqa: F401
    except ImportError:
        command = install_command(["watch"])
        raise click.UsageError(f"--watch needs one more package: {command}") from None
    watcher = Watcher[Path]()

    def follow(file: Path) -> None:
        watcher.follow(file, file, lambda: sources(file, search_path) | {*further})

    for file in files:
        follow(file)
    act()
    for file in watcher.changes():
        follow(file)
        act()


def sources(file: Path, search_path: Sequence[Path]) -> set[Path]:
    """The paths that a compile of a file depends on.

    They are the file, its imports, the places where imports were looked for in vain, and the
    folders in which all of these lie.
    """
    inputs = Inputs()
    Frontend(Report(), search_path, inputs).open_file(file)
    return {file, *search_path, *map(Path, inputs.links), *map(Path, inputs.contents)}


class Watcher(Generic[Key]):
    """Follows the files of several things, each of which has a key.

    One thread waits in ``changes``; others may call everything else meanwhile. The system watches
    folders, not files, because editors replace a file by a new one. A file has changed if it is
    another one than when it was followed, so no change is missed, whatever is reported.
    """

    def __init__(self) -> None:
        self._lock = Lock()
        self._followed: dict[Key, dict[Path, Stamp]] = {}
        self._again = Event()
        """Set if the system has to watch other folders than before, or nothing more."""
        self._is_stopped = False
        self._failures = 0
        """The number of times that the system has failed to report changes since it last
        succeeded."""
        self._is_told = False

    def follow(self, key: Key, file: Path, find: Callable[[], Iterable[Path]]) -> None:
        """Follow a file, and the files that ``find`` finds by reading it.

        To be called again after each change.
        """
        before = _stamp(file)
        stamps = {path: _stamp(path) for path in find()} | {file: before}
        with self._lock:
            known = {path.parent for each in self._followed.values() for path in each}
            self._followed[key] = stamps
        if not known.issuperset(path.parent for path in stamps):
            self._again.set()

    def leave(self, key: Key) -> None:
        """Stop following the files of a thing."""
        with self._lock:
            self._followed.pop(key, None)

    def stop(self) -> None:
        """End ``changes``, wherever it waits."""
        self._is_stopped = True
        self._again.set()

    def changes(self) -> Iterator[Key]:
        """The key of each thing whose files have changed, as soon as that is noticed.

        The iterator ends when ``stop`` is called.
        """
        while True:
            self._again.clear()
            if self._is_stopped:
                return
            folders = self._folders()
            for _ in self._wakings([folder for folder, found in folders.items() if found]):
                begun = time.monotonic()
                changed, moved = self._changed(), self._folders() != folders
                took = time.monotonic() - begun
                yield from changed
                if moved or self._again.wait(_REST * took):
                    break

    def _wakings(self, folders: Sequence[Path]) -> Iterator[object]:
        """Yield whenever something may have changed in these folders."""
        from watchfiles import watch as reported

        try:
            for _ in reported(
                *folders, watch_filter=None, recursive=False, yield_on_timeout=True,
                rust_timeout=_POLL, step=_STEP, debounce=_POLL, stop_event=self._again,
                ignore_permission_denied=True,
            ):  # fmt: skip
                self._failures = 0
                yield None
        except (OSError, RuntimeError) as error:
            self._fail(error)
        else:
            return
        self._again.wait(_POLL_ALONE)
        yield None

    def _fail(self, error: Exception) -> None:
        """Print once that changes may be noticed late, if the system fails repeatedly.

        A single failure means nothing: a folder has gone just now, or the name of a file beside
        those that matter is no UTF-8.
        """
        self._failures += 1
        if self._failures == _TELL_AFTER and not self._is_told:
            self._is_told = True
            remark("note", (
                "the system does not report changes of files, so they are looked for every "
                f"{_POLL_ALONE:g} seconds: {error}"
            ))  # fmt: skip

    def _changed(self) -> list[Key]:
        """The keys of the things that have changed since the last call."""
        with self._lock:
            followed = {key: dict(stamps) for key, stamps in self._followed.items()}
        now = {path: _stamp(path) for path in {p for each in followed.values() for p in each}}
        changed = []
        for key, stamps in followed.items():
            if any(now[path] != stamp for path, stamp in stamps.items()):
                self._note(key, stamps, now)
                changed.append(key)
        return changed

    def _note(self, key: Key, before: Mapping[Path, Stamp], now: Mapping[Path, Stamp]) -> None:
        """Remember the present files, unless somebody has followed the key anew meanwhile."""
        with self._lock:
            if self._followed.get(key) == before:
                self._followed[key] = {path: now[path] for path in before}

    def _folders(self) -> dict[Path, Stamp]:
        """The folders of followed files, existing or not, with stamps that identify the folders.

        The system cannot watch folders whose names are no UTF-8.
        """
        with self._lock:
            parents = {path.parent for each in self._followed.values() for path in each}
        return {folder: _stamp(folder) for folder in parents if _is_unicode(folder)}


def _stamp(path: Path) -> Stamp:
    try:
        found = path.stat()
    except (OSError, ValueError):  # The file may be gone by now, or its name may be impossible.
        return None
    if stat.S_ISDIR(found.st_mode):  # Other files in it do not matter.
        return found.st_dev, found.st_ino
    return found.st_dev, found.st_ino, found.st_mtime_ns, found.st_size


def _is_unicode(path: Path) -> bool:
    try:
        os.fspath(path).encode()
    except UnicodeEncodeError:
        return False
    return "\0" not in os.fspath(path)

"""Writes a set of files into a folder: all of them, or none if something goes wrong.

``output.py``, ``results.py`` and the commands that make pages write everything with it that they
leave in a folder. A file system changes one name at a time. So each new file is first written
completely, under a temporary name in the same folder; then all are renamed, which takes
microseconds. An error on the way takes back what has been renamed. Only a process that is killed
just then leaves some new files beside old ones, and each of them is whole; one that is killed
earlier leaves the old files, and temporary ones, which nobody reads.

The folder may be somebody else's: a repository that was cloned, for example. So nothing that lies
there is believed. No name in it is opened but temporary ones, which must be new, and no link is
followed; nothing is removed but what this very call has made. The folder is opened once, and
everything is done relative to it, even if its path leads elsewhere a moment later.
"""

from __future__ import annotations

import errno
import os
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from os.path import join
from stat import S_ISDIR

PATIENCE = 10.0
"""For how many seconds to wait for another process, which needs far less to write its files."""
TEMPORARY = ".burnish-"
"""How the temporary names begin."""

_ANCHORED = os.open in os.supports_dir_fd
"""Whether names can be relative to an open folder, as everywhere but on Windows."""
_NEW = (
    os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
)
_NO_LOCKS = frozenset({errno.EBADF, errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP})
"""What file systems say that cannot lock a folder. There, processes should take turns."""


def replace_all(folder: str, contents: Mapping[str, bytes]) -> None:
    """Write each content under its name into a folder, or raise ``OSError`` and change nothing.

    The folder is made if need be. A link that has one of the names is replaced, not followed.
    """
    for name in contents:
        _check_name(folder, name)
    os.makedirs(folder, exist_ok=True)
    with _opened(folder) as anchor:
        _Replacement(folder, anchor).run(contents)


def _check_name(folder: str, name: str) -> None:
    """Raise ``OSError`` for a name that does not mean a file in the folder itself."""
    if name in ("", os.curdir, os.pardir) or "\0" in name or os.path.basename(name) != name:
        raise OSError(errno.EINVAL, "it is no name of a file", join(folder, name))


class _Replacement:
    """One call of ``replace_all``, with all that it has made."""

    def __init__(self, folder: str, anchor: int | None) -> None:
        self._folder = folder
        self._anchor = anchor
        self._new: dict[str, str] = {}
        """The temporary names of the new files."""
        self._old: dict[str, str | None] = {}
        """The temporary names of what they replace; ``None`` where there was nothing."""

    def run(self, contents: Mapping[str, bytes]) -> None:
        try:
            for name, content in contents.items():
                self._refuse_folder(name)
                self._write(name, content)
            for name in contents:
                self._put_in_place(name)
        except BaseException:
            self._take_back()
            raise
        self._remove(*filter(None, self._old.values()))

    def _refuse_folder(self, name: str) -> None:
        with suppress(FileNotFoundError):
            found = os.stat(self._at(name), dir_fd=self._anchor, follow_symlinks=False)
            if S_ISDIR(found.st_mode):
                raise IsADirectoryError(errno.EISDIR, "it is a folder", join(self._folder, name))

    def _write(self, name: str, content: bytes) -> None:
        temporary = _temporary()
        file = os.open(self._at(temporary), _NEW, 0o666, dir_fd=self._anchor)
        self._new[name] = temporary
        with open(file, "wb") as stream:
            stream.write(content)

    def _put_in_place(self, name: str) -> None:
        """Rename a new file to its final name, and remember what was there."""
        kept = _temporary()
        with suppress(FileNotFoundError):
            self._link(name, kept)
            self._old[name] = kept
        self._old.setdefault(name, None)
        self._rename(self._new[name], name)

    def _link(self, name: str, kept: str) -> None:
        """Give a file a second name; where that is not possible, another one."""
        source, target = self._at(name), self._at(kept)
        places = {"src_dir_fd": self._anchor, "dst_dir_fd": self._anchor}
        try:
            os.link(source, target, follow_symlinks=False, **places)
        except FileNotFoundError:
            raise
        except (OSError, NotImplementedError):
            os.rename(source, target, **places)

    def _rename(self, source: str, target: str) -> None:
        places = {"src_dir_fd": self._anchor, "dst_dir_fd": self._anchor}
        os.replace(self._at(source), self._at(target), **places)

    def _take_back(self) -> None:
        """Have each name stand again for what it stood for before."""
        for name, kept in self._old.items():
            with suppress(OSError):
                if kept is not None:
                    self._rename(kept, name)
                elif self._was_renamed(name):
                    os.unlink(self._at(name), dir_fd=self._anchor)
        self._remove(*self._new.values())

    def _was_renamed(self, name: str) -> bool:
        """Whether the new file has its final name, also if that was the last thing to happen."""
        try:
            os.stat(self._at(self._new[name]), dir_fd=self._anchor, follow_symlinks=False)
        except FileNotFoundError:
            return True
        return False

    def _remove(self, *temporary: str) -> None:
        for name in temporary:
            with suppress(OSError):
                os.unlink(self._at(name), dir_fd=self._anchor)

    def _at(self, name: str) -> str:
        """A name as system calls take it: relative to the open folder, if there can be one."""
        return name if self._anchor is not None else join(self._folder, name)


def _temporary() -> str:
    """A name that nobody can have foreseen."""
    return f"{TEMPORARY}{os.urandom(8).hex()}"


@contextmanager
def _opened(folder: str) -> Iterator[int | None]:
    """The folder as an open file, which no other process writes into at the same time.

    Windows knows neither; there, the latest of two processes may find files of the other.
    """
    if not _ANCHORED:
        yield None
        return
    anchor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        _lock(anchor, folder)
        yield anchor
    finally:
        os.close(anchor)


def _lock(anchor: int, folder: str) -> None:
    """Lock an open folder, once nobody else has; the lock ends when the folder is closed."""
    from fcntl import LOCK_EX, LOCK_NB, flock

    give_up = time.monotonic() + PATIENCE
    while True:
        try:
            flock(anchor, LOCK_EX | LOCK_NB)
            return
        except BlockingIOError:
            if time.monotonic() > give_up:
                waited = f"another process has held this folder for {PATIENCE:.0f} seconds"
                raise TimeoutError(errno.ETIMEDOUT, waited, folder) from None
        except OSError as error:
            if error.errno in _NO_LOCKS:
                return
            raise
        time.sleep(0.005)

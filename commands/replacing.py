"""Replaces a set of files in a folder: readers find all of the old files or all of the new ones.

``output.py`` and ``results.py`` write everything with it that a command leaves in a folder. A file
system changes one name at a time, so a set of files needs a journal. It is a folder inside the
target folder, which exists only while somebody writes:

    .burnish-output-1000/     the number is the user's
        lock                  locked by the process that writes
        new/                  the new files
        whole                 made once each file in new/ is complete
        old/                  the files that the new ones replace, to take everything back

New files are renamed into place once ``whole`` exists, which takes microseconds. An error on the
way takes back what has been renamed. A process that is killed takes nothing back. But the system
releases its lock, so the next process that writes into the folder finds out that nobody owns the
journal. If ``whole`` exists, it renames what is left in ``new``; otherwise it drops all of it.
Neither depends on numbers of processes, which come again and mean nothing to other hosts.
"""

from __future__ import annotations

import errno
import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from os.path import join
from stat import S_ISDIR

ON_WINDOWS = os.name == "nt"
PATIENCE = 10.0
"""For how many seconds to wait for another process, which needs far less to write its files."""

_NO_LOCKS = frozenset({errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP})
"""What file systems say that cannot lock. There, processes should not write at the same time."""


def replace_all(folder: str, contents: Mapping[str, bytes]) -> None:
    """Write each content under its name into a folder, or raise ``OSError`` and change nothing.

    The folder is made if need be. A link that has one of the names is replaced, not followed.
    """
    for name in contents:
        if os.path.isdir(join(folder, name)):
            raise IsADirectoryError(errno.EISDIR, "it is a folder", join(folder, name))
    os.makedirs(folder, exist_ok=True)
    with _journal(folder) as journal:
        journal.store(contents)
        journal.put_in_place(contents)


class _Journal:
    """The journal of a folder, which this process has locked."""

    def __init__(self, folder: str, path: str) -> None:
        self._folder = folder
        self._new, self._old, self._whole = (join(path, name) for name in ("new", "old", "whole"))

    def store(self, contents: Mapping[str, bytes]) -> None:
        """Write the new files, and remember those that are there."""
        _make_private_folder(self._new)
        _make_private_folder(self._old)
        for name, content in contents.items():
            _write(join(self._new, name), content)
            _duplicate(join(self._folder, name), join(self._old, name))
        _write(self._whole, b"")

    def put_in_place(self, names: Mapping[str, bytes]) -> None:
        """Rename the new files to their final names; if that fails, take it back."""
        moved: list[str] = []
        try:
            for name in names:
                moved.append(name)
                os.replace(join(self._new, name), join(self._folder, name))
        except BaseException:
            os.unlink(self._whole)
            for name in moved:
                with suppress(OSError):
                    self._take_back(name)
            raise

    def _take_back(self, name: str) -> None:
        """Have a name stand again for what it stood for before."""
        if os.path.lexists(join(self._new, name)):
            return  # It was not renamed.
        try:
            os.replace(join(self._old, name), join(self._folder, name))
        except FileNotFoundError:
            os.unlink(join(self._folder, name))

    def settle(self) -> None:
        """Complete what a killed process has left, or drop it."""
        if os.path.lexists(self._whole):
            for name in _names(self._new):
                with suppress(OSError):
                    os.replace(join(self._new, name), join(self._folder, name))
        self.clear()

    def clear(self) -> None:
        """Remove the journal but for its lock."""
        with suppress(FileNotFoundError):
            os.unlink(self._whole)
        for part in (self._new, self._old):
            for name in _names(part):
                os.unlink(join(part, name))
            with suppress(FileNotFoundError):
                os.rmdir(part)


@contextmanager
def _journal(folder: str) -> Iterator[_Journal]:
    """The journal of a folder, empty; others that want to write there wait as long."""
    path = join(folder, f".burnish-output-{os.getuid() if hasattr(os, 'getuid') else 0}")
    lock = _locked(path)
    journal = _Journal(folder, path)
    try:
        journal.settle()
        try:
            yield journal
        finally:
            journal.clear()
            if not ON_WINDOWS:
                os.unlink(join(path, "lock"))
    finally:
        os.close(lock)
        with suppress(OSError):  # Whoever has waited may have made the next lock in it.
            if ON_WINDOWS:  # There nobody can delete a file that is open, not even its owner.
                os.unlink(join(path, "lock"))
            os.rmdir(path)


def _locked(path: str) -> int:
    """The file descriptor of the lock of the journal at ``path``, once nobody else has it."""
    give_up = time.monotonic() + PATIENCE
    while True:
        _make_own_folder(path)
        with suppress(FileNotFoundError):  # The journal was removed just now.
            lock = os.open(join(path, "lock"), os.O_RDWR | os.O_CREAT, 0o666)
            if _lock(lock) and _is_at(lock, join(path, "lock")):
                return lock
            os.close(lock)
        if time.monotonic() > give_up:
            waited = f"another process has been writing there for {PATIENCE:.0f} seconds"
            raise TimeoutError(errno.ETIMEDOUT, f"{waited}; if there is none, delete `{path}`")
        time.sleep(0.005)


def _make_own_folder(path: str) -> None:
    """Make a folder; if it exists, it has to be this user's.

    Somebody else could fill it with files to be put in place of ours.
    """
    try:
        _make_private_folder(path)
    except FileExistsError:
        with suppress(FileNotFoundError):
            found = os.lstat(path)
            owned = not hasattr(os, "getuid") or found.st_uid == os.getuid()
            if not S_ISDIR(found.st_mode) or not owned:
                reason = f"`{path}` is in the way, and is not a folder of this user"
                raise PermissionError(errno.EACCES, reason) from None


def _make_private_folder(path: str) -> None:
    """Make a folder that this user alone can enter, whatever the umask says.

    Where others could write there, they could add files; where the user cannot enter, no later
    process could clear it away.
    """
    os.mkdir(path, 0o700)
    os.chmod(path, 0o700)


def _lock(file: int) -> bool:
    """Lock an open file for this process, unless another one has locked it."""
    try:
        if ON_WINDOWS:
            _lock_on_windows(file)
        else:
            from fcntl import LOCK_EX, LOCK_NB, flock

            flock(file, LOCK_EX | LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    except OSError as error:
        if error.errno not in _NO_LOCKS:
            raise
    return True


def _lock_on_windows(file: int) -> None:
    """Lock an open file, or raise ``PermissionError``; the lock ends with the process as well."""
    from importlib import import_module

    system = import_module("msvcrt")
    locking: Callable[[int, int, int], None] = system.locking
    without_waiting: int = system.LK_NBLCK
    locking(file, without_waiting, 1)


def _is_at(file: int, path: str) -> bool:
    """Whether an open file is still the one at ``path``, and not one that was deleted."""
    try:
        return os.path.samestat(os.fstat(file), os.stat(path))
    except FileNotFoundError:
        return False


def _write(path: str, content: bytes) -> None:
    with open(path, "wb") as file:
        file.write(content)


def _duplicate(path: str, copy: str) -> None:
    """Give a file a second name; where the file system has no such names, copy it."""
    try:
        os.link(path, copy, follow_symlinks=False)
    except FileNotFoundError:
        return
    except (OSError, NotImplementedError):
        if os.path.isfile(path):
            with open(path, "rb") as file:
                _write(copy, file.read())


def _names(folder: str) -> list[str]:
    try:
        return os.listdir(folder)
    except FileNotFoundError:
        return []

"""Keeps data from one process to the next, in a folder that belongs to the user alone.

``commands/results.py`` keeps what ``burnish compile`` has written, by ``load`` and ``store``, and
``targets/runner/store.py`` keeps modules and pictures. A cache is only a convenience: if it cannot
be read or written, values are computed again. Files appear as a whole, so any number of processes
may share the folder or be killed while they write to it, and it may be full, read-only or missing.

What is found here decides what a compile writes. So nothing is kept that Python could execute, and
nothing is believed that another user could have put there: the folder and its files have to belong
to this user, nobody else may be able to write to them, and neither may be a link.

This module is loaded before anything else is, so it imports little.
"""

from __future__ import annotations

import os
import stat
import sys
from _imp import source_hash

KEPT = 256
"""The number of values of each name that stay when one is written."""
ROOM = 64 << 20
"""Bytes that the values of each name may take together."""

_DIGEST_SIZE = 8
_KEY = 0
"""The key of the hash: any number, but always the same."""
_BINARY = getattr(os, "O_BINARY", 0)
_OLD = os.O_RDONLY | _BINARY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
"""The flags that open files: neither follow a link nor wait for the other end of a pipe."""
_NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | _BINARY


def folder() -> str:
    """Burnish's folder at the platform's place for a user's caches.

    It is a path at which nothing can be where nobody knows the user's home.
    """
    platform: str = sys.platform
    if platform == "linux":
        # As platformdirs does on Linux, without the time that it takes to import.
        caches = os.environ.get("XDG_CACHE_HOME", "").strip()
        if not os.path.isabs(caches) and os.environ.get("HOME") != "":  # noqa: PTH117
            caches = os.path.expanduser("~/.cache")  # noqa: PTH111
        caches = os.path.join(caches, "burnish")  # noqa: PTH118
    else:
        from platformdirs import user_cache_path

        caches = str(user_cache_path("burnish"))
    return caches if os.path.isabs(caches) else os.path.join(os.devnull, "burnish")  # noqa: PTH117, PTH118


def private_folder() -> str:
    """The folder in which data are kept; ``BURNISH_CACHE`` says where. It need not be there.

    A relative path says nothing: it would name a folder of whatever the current folder is, which
    may have come from anywhere.
    """
    chosen = os.environ.get("BURNISH_CACHE", "")
    caches = chosen if os.path.isabs(chosen) else folder()  # noqa: PTH117
    return os.path.normpath(os.path.join(caches, "private"))  # noqa: PTH118


def digest(data: bytes) -> str:
    """The hash of Python's own cache files: 64 bits, and far cheaper to load than hashlib.

    ``importlib.util.source_hash`` would put the number of Python's byte code into it. Then nothing
    would be found that another version of Python has computed, such as the one that built a wheel.
    """
    return source_hash(_KEY, data).hex()


def load(name: str, key: str) -> bytes | None:
    """The value stored under a name and a key, if it is there, whole and undamaged.

    Names are of lower-case letters, keys are digests.
    """
    content = read_private(_path(name, key))
    if content is None:
        return None
    head, payload = content[:_DIGEST_SIZE], content[_DIGEST_SIZE:]
    return payload if digest(payload) == head.hex() else None


def store(name: str, key: str, payload: bytes) -> None:
    """Keeps ``payload`` under a name and a key, in place of an earlier value, if possible."""
    store_unpruned(name, key, payload)
    prune(name, KEPT, key)


def store_unpruned(name: str, key: str, payload: bytes) -> None:
    """Does so for one of many values; whoever stores them calls ``prune`` behind the last one."""
    try:
        write_private(_path(name, key), bytes.fromhex(digest(payload)) + payload)
    except OSError:
        return


def read_private(path: str) -> bytes | None:
    """The content of a file below ``private_folder``; ``None`` if it is not there or not ours."""
    try:
        _insist_on_folders(os.path.dirname(path))  # noqa: PTH120
        with open(os.open(path, _OLD), "rb") as file:  # noqa: PTH123
            _insist(os.fstat(file.fileno()), stat.S_IFREG)
            return file.read()
    except (OSError, ValueError):
        return None


def private_files(place: str) -> list[tuple[str, os.stat_result]]:
    """The paths of all files below ``private_folder``, with their properties.

    Raises ``OSError`` if the folder is not there or not ours, such as a link to another one.
    """
    _insist_on_folders(place)
    with os.scandir(place) as entries:
        return [(entry.path, entry.stat(follow_symlinks=False)) for entry in entries]


def write_private(path: str, content: bytes) -> None:
    """Write a file below ``private_folder``, or raise ``OSError``.

    The file is put in place in one step, so that no reader ever sees half of it.
    """
    _make_private(os.path.dirname(path))  # noqa: PTH120
    temporary = f"{path}.{os.urandom(8).hex()}.tmp"
    try:
        with open(os.open(temporary, _NEW, 0o600), "wb") as file:  # noqa: PTH123
            os.chmod(temporary, 0o600)  # noqa: PTH101 - the process's mask may forbid even that
            file.write(content)
        os.replace(temporary, path)  # noqa: PTH105
    except OSError:
        _delete(temporary)
        raise


def _make_private(place: str) -> None:
    """Make ``private_folder`` or a folder below it; raises ``OSError`` if it is not this user's."""
    above = os.path.dirname(place)  # noqa: PTH120
    if place == private_folder():
        os.makedirs(above, exist_ok=True)  # noqa: PTH103
    else:
        _make_private(above)
    if not os.path.lexists(place):
        try:
            os.mkdir(place, 0o700)  # noqa: PTH102
            os.chmod(place, 0o700)  # noqa: PTH101 - the process's mask may forbid even that
        except FileExistsError:
            pass  # Another process was faster.
    _insist(os.lstat(place), stat.S_IFDIR)


def _insist_on_folders(place: str) -> None:
    """Raise ``OSError`` unless ``place`` and all down to it from ``private_folder`` are ours."""
    _insist(os.lstat(place), stat.S_IFDIR)
    if place != private_folder():
        _insist_on_folders(os.path.dirname(place))  # noqa: PTH120


def _insist(status: os.stat_result, kind: int) -> None:
    """Raise ``PermissionError`` unless a file or folder of this kind belongs to this user alone.

    On Windows, a user's caches lie in the user's profile, which others cannot change.
    """
    private = os.name == "nt" or (
        status.st_uid == os.geteuid() and not stat.S_IMODE(status.st_mode) & 0o077
    )
    if stat.S_IFMT(status.st_mode) != kind or not private:
        raise PermissionError


def _path(name: str, key: str) -> str:
    return os.path.join(private_folder(), name, key)  # noqa: PTH118


def prune(name: str, most: int, latest: str = "") -> None:
    """Delete the values of a name that were written first, where there are too many of them.

    The one with the key ``latest`` stays even if a clock that went backwards says that others are
    later. Partly written files of killed processes are deleted in the same way. A value that is
    still in use is computed again, and so is new then.
    """
    last = _path(name, latest)
    try:
        found = private_files(os.path.dirname(last))  # noqa: PTH120
    except OSError:
        return
    found.sort(key=lambda each: (each[0] == last, each[1].st_mtime_ns), reverse=True)
    taken = 0
    for number, (path, status) in enumerate(found):
        taken += status.st_size
        if number >= most or taken > ROOM:
            _delete(path)


def _delete(path: str) -> None:
    try:
        os.unlink(path)  # noqa: PTH108
    except OSError:
        return

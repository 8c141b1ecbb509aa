"""Keeps values that take long to compute in files, from one process to the next.

``cached`` keeps the parser's tables, the syntax trees of the standard library and the precompiled
templates. ``load`` and ``store`` keep what ``burnish compile`` has written, for
``commands/results.py``. A cache is only a convenience: if it cannot be read or written, values are
computed again. Files appear as a whole, begin with a digest of the rest, and are deleted when newer
ones need their room. So any number of processes may share the folder or be killed while they write
to it, and it may be full, read-only or missing.

This module is loaded before anything else is, so it imports little.
"""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TypeVar

    T = TypeVar("T")

KEPT = 256
"""How many values of each name stay when one is written."""
ROOM = 64 << 20
"""Bytes that the values of each name may take together."""

_DIGEST_SIZE = 8


def folder() -> str:
    """Where cache files live: ``BURNISH_CACHE``, or the platform's place for a user's caches."""
    chosen = os.environ.get("BURNISH_CACHE")
    if chosen:
        return chosen
    platform: str = sys.platform
    if platform != "linux":
        from platformdirs import user_cache_path

        return str(user_cache_path("burnish"))
    # What platformdirs says of Linux, without the time that it takes to import.
    caches = os.environ.get("XDG_CACHE_HOME", "").strip()
    if not os.path.isabs(caches) and os.environ.get("HOME") != "":  # noqa: PTH117
        caches = os.path.expanduser("~/.cache")  # noqa: PTH111
    if not os.path.isabs(caches):  # noqa: PTH117
        # Nobody knows the user's home. Where no file can be, none is looked for in vain.
        caches = os.devnull
    return os.path.join(caches, "burnish")  # noqa: PTH118


def cached(name: str, ingredients: tuple[str, ...], compute: Callable[[], T]) -> T:
    """The value of ``compute``, remembered for as long as the ``ingredients`` stay the same.

    The value must be made of what ``marshal`` can write: numbers, texts, tuples, lists, dicts and
    code objects. Ingredients are everything the value depends on; the Python version is implied.
    """
    import marshal

    key = digest(marshal.dumps((sys.version, *ingredients), 2))
    stored = load(name, key)
    if stored is not None:
        found: T = marshal.loads(stored)
        return found
    value = compute()
    store(name, key, marshal.dumps(value))  # type: ignore[arg-type]
    return value


def digest(data: bytes) -> str:
    """The hash that Python's own cache files use: 64 bits, and far cheaper to load than hashlib."""
    from importlib.util import source_hash

    return source_hash(data).hex()


def load(name: str, key: str) -> bytes | None:
    """What was stored under a name and a key, if it is there, whole and undamaged.

    Names are of lower-case letters, keys are digests.
    """
    try:
        with open(_path(name, key), "rb") as file:  # noqa: PTH123
            content = file.read()
    except OSError:
        return None
    head, payload = content[:_DIGEST_SIZE], content[_DIGEST_SIZE:]
    return payload if digest(payload) == head.hex() else None


def store(name: str, key: str, payload: bytes) -> None:
    """Keep ``payload`` under a name and a key, in place of what was there before, if possible.

    The file is put in place in one step, so that no reader ever sees half of it.
    """
    path = _path(name, key)
    temporary = f"{path}.{os.getpid()}.tmp"
    try:
        place = os.path.dirname(path)  # noqa: PTH120
        os.makedirs(place, exist_ok=True)  # noqa: PTH103
        try:
            with open(temporary, "wb") as file:  # noqa: PTH123
                file.write(bytes.fromhex(digest(payload)) + payload)
            os.replace(temporary, path)  # noqa: PTH105
        except OSError:
            os.unlink(temporary)  # noqa: PTH108
            raise
        _prune(place, name, path)
    except OSError:
        return


def _path(name: str, key: str) -> str:
    return os.path.join(folder(), f"{name}-{key}.bin")  # noqa: PTH118


def _prune(place: str, name: str, latest: str) -> None:
    """Delete the values of a name that were written first, where there are too many of them.

    The latest one stays even if a clock that went backwards says that others are later. Partly
    written files of killed processes are deleted in the same way. A value that is still in use is
    computed again, and so is new then.
    """
    import re

    own = re.compile(re.escape(name) + r"-[0-9a-f]{16}\.bin(\.[0-9]+\.tmp)?")
    with os.scandir(place) as entries:
        found = [(entry.path, entry.stat()) for entry in entries if own.fullmatch(entry.name)]
    found.sort(key=lambda each: (each[0] == latest, each[1].st_mtime_ns), reverse=True)
    taken = 0
    for number, (path, status) in enumerate(found):
        taken += status.st_size
        if number >= KEPT or taken > ROOM:
            _delete(path)


def _delete(path: str) -> None:
    try:
        os.unlink(path)  # noqa: PTH108
    except OSError:
        return

"""Values that are costly to compute and never change: kept in files named after their content.

The parse tables, the compiled standard library and the precompiled templates all start here. A
cache is a convenience only: where it cannot be read or written, the value is computed again. What
an older compiler has left is deleted in time.
"""

from __future__ import annotations

import marshal
import os
import re
import sys
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

T = TypeVar("T")

KEPT = 256
"""Values that stay when one is written: those of about ten versions of the compiler."""

_DIGEST_SIZE = 8
_OWN = re.compile(r"[a-z]+-[0-9a-f]{16}\.bin(\.[0-9]+\.tmp)?")
"""Names of files that are written here: the folder may hold others."""


def folder() -> str:
    """Where cache files live: ``BURNISH_CACHE``, or the platform's place for a user's caches."""
    chosen = os.environ.get("BURNISH_CACHE")
    if chosen:
        return chosen
    from platformdirs import user_cache_path

    return str(user_cache_path("burnish"))


def cached(name: str, ingredients: tuple[str, ...], compute: Callable[[], T]) -> T:
    """The value of ``compute``, remembered for as long as the ``ingredients`` stay the same.

    The value must be made of what ``marshal`` can write: numbers, texts, tuples, lists, dicts and
    code objects. Ingredients are everything the value depends on; the Python version is implied.
    """
    path = os.path.join(folder(), f"{name}-{_key(ingredients)}.bin")  # noqa: PTH118
    found, value = _read(path)
    if found:
        return value  # type: ignore[return-value]
    value = compute()
    _write(path, value)
    return value


def _digest(data: bytes) -> bytes:
    """The hash that Python's own cache files use: 64 bits, and far cheaper to load than hashlib."""
    from importlib.util import source_hash

    return source_hash(data)


def _key(ingredients: tuple[str, ...]) -> str:
    parts = (sys.version, *ingredients)
    return _digest(marshal.dumps(parts, 2)).hex()


def _read(path: str) -> tuple[bool, object]:
    """Whether a whole, undamaged value lies at ``path``, and that value.

    ``marshal`` may crash on damaged data, so the digest in front is checked first.
    """
    try:
        with open(path, "rb") as file:  # noqa: PTH123
            content = file.read()
    except OSError:
        return False, None
    digest, payload = content[:_DIGEST_SIZE], content[_DIGEST_SIZE:]
    if _digest(payload) != digest:
        return False, None
    return True, marshal.loads(payload)


def _write(path: str, value: object) -> None:
    """Put ``value`` in place in one step, so that no reader ever sees half a file."""
    payload = marshal.dumps(value)  # type: ignore[arg-type]
    temporary = f"{path}.{os.getpid()}.tmp"
    try:
        os.makedirs(os.path.dirname(path), exist_ok=True)  # noqa: PTH103, PTH120
        with open(temporary, "wb") as file:  # noqa: PTH123
            file.write(_digest(payload) + payload)
        os.replace(temporary, path)  # noqa: PTH105
        _prune(os.path.dirname(path))  # noqa: PTH120
    except OSError:
        return


def _prune(place: str) -> None:
    """Delete the values that were written first, where there are too many, and halves of values.

    One that is still in use is computed again, and so is new then.
    """
    with os.scandir(place) as entries:
        own = [entry for entry in entries if _OWN.fullmatch(entry.name)]
    if len(own) <= KEPT:
        return
    newest_first = sorted(own, key=lambda entry: entry.stat().st_mtime_ns, reverse=True)
    for entry in newest_first[KEPT:]:
        with suppress(OSError):
            os.unlink(entry.path)  # noqa: PTH108

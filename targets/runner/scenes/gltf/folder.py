"""Reads what a glTF file refers to: data in the URI itself, or files in its own folder.

A glTF file may come from anywhere. So it can name no other file than those that lie beside it or
deeper: by no spelling of a path, and through no link. Nothing is fetched from a network.
"""

from __future__ import annotations

import binascii
import re
from pathlib import Path, PureWindowsPath
from urllib.parse import unquote_to_bytes

from ..records import SceneError

MAX_FILE = 2**29
"""The most bytes of one file: 512 MB."""
MAX_BYTES = 2**30
"""The most bytes of all that a file refers to: it can name one file again and again."""

_DATA = re.compile(r"data:[^,]{0,200};base64,")
_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")
_SHOWN = 60


class Folder:
    """The folder of a glTF file. It keeps no file that it has read."""

    def __init__(self, file: Path) -> None:
        self._folder = file.parent
        self._left = MAX_BYTES

    def read(self, uri: str, what: str) -> bytes:
        """The bytes that a URI means; ``what`` says in errors who asks. Raises ``SceneError``."""
        if uri.startswith("data:"):
            data = _data(uri, what)
        else:
            data = read_limited(self._place(uri, what), f"{what}: `{_short(uri)}`")
        self._left -= len(data)
        if self._left < 0:
            raise SceneError(f"{what}: all files together have more than {MAX_BYTES // 2**20} MB")
        return data

    def _place(self, uri: str, what: str) -> Path:
        """The file of a relative URI, where it really lies."""
        if _SCHEME.match(uri):
            raise _outside(uri, what)
        try:
            name = unquote_to_bytes(uri).decode()
        except UnicodeDecodeError:
            raise SceneError(f"{what}: `{_short(uri)}` is no UTF-8") from None
        parts = PureWindowsPath(name)
        if not name or "\0" in name:
            raise SceneError(f"{what}: `{_short(uri)}` names no file")
        if parts.anchor or ".." in parts.parts:
            raise _outside(uri, what)
        try:
            found = (self._folder / name).resolve(strict=True)
            inside = found.is_relative_to(self._folder.resolve())
        except (OSError, RuntimeError) as error:
            raise _unreadable(f"{what}: `{_short(uri)}`", error) from None
        if not inside:
            raise _outside(uri, what)
        return found


def read_limited(path: Path, name: str) -> bytes:
    """The bytes of a file that is not too large; ``name`` is what errors call it. Raises
    ``SceneError``."""
    try:
        if path.exists() and not path.is_file():
            raise SceneError(f"cannot read {name}: it is not a file")
        with path.open("rb") as file:
            data = file.read(MAX_FILE + 1)
    except (OSError, ValueError) as error:
        if isinstance(error, SceneError):
            raise
        raise _unreadable(name, error) from None
    if len(data) > MAX_FILE:
        raise SceneError(f"{name} has more than {MAX_FILE // 2**20} MB")
    return data


def _data(uri: str, what: str) -> bytes:
    head = _DATA.match(uri)
    if head is None:
        raise SceneError(f"{what}: a URI of data has to be in base64")
    try:
        return binascii.a2b_base64(uri[head.end() :], strict_mode=True)
    except (binascii.Error, ValueError):
        raise SceneError(f"{what}: the data in its URI is no base64") from None


def _unreadable(name: str, error: Exception) -> SceneError:
    reason = getattr(error, "strerror", None) or error
    return SceneError(f"cannot read {name}: {reason}")


def _outside(uri: str, what: str) -> SceneError:
    return SceneError(f"{what}: `{_short(uri)}` is not in the folder of the glTF file")


def _short(uri: str) -> str:
    """A URI as it is told in a message."""
    return uri if len(uri) <= _SHOWN else f"{uri[:_SHOWN]}…"

"""Reads the data to which a glTF file refers: in the URI itself, or in files of its own folder.

A glTF file may come from anywhere. So it can name no other file than those that lie beside it or
deeper: by no spelling of a path, and through no link. Nothing is fetched from a network.
"""

from __future__ import annotations

import binascii
import re
from pathlib import Path, PureWindowsPath
from urllib.parse import unquote_to_bytes

from .....compiler.budget import Tally
from ...files import FileError, read_file
from ..records import SceneError, short

_DATA = re.compile(r"data:[^,]{0,200};base64,")
_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")


class Folder:
    """The folder of a glTF file. It keeps no file that it has read."""

    def __init__(self, file: Path, memory: Tally) -> None:
        """``memory`` counts everything that is read: a file can be named again and again."""
        self._folder = file.parent
        self._memory = memory

    def read(self, uri: str, what: str) -> bytes:
        """The bytes that a URI means; ``what`` names the reader in errors.

        Raises ``SceneError``, and ``BudgetError`` if there are too many bytes.
        """
        if uri.startswith("data:"):
            self._memory.add(len(uri), passing=len(uri))
            return _data(uri, what)
        try:
            data = read_file(self._place(uri, what), f"{what}: `{short(uri)}`")
        except FileError as error:
            raise SceneError(str(error)) from None
        self._memory.add(len(data))
        return data

    def _place(self, uri: str, what: str) -> Path:
        """The real path of the file that a relative URI means."""
        if _SCHEME.match(uri):
            raise _outside(uri, what)
        try:
            name = unquote_to_bytes(uri).decode()
        except UnicodeDecodeError:
            raise SceneError(f"{what}: `{short(uri)}` is no UTF-8") from None
        parts = PureWindowsPath(name)
        if not name or "\0" in name:
            raise SceneError(f"{what}: `{short(uri)}` names no file")
        if parts.anchor or ".." in parts.parts:
            raise _outside(uri, what)
        try:
            found = (self._folder / name).resolve(strict=True)
            inside = found.is_relative_to(self._folder.resolve())
        except (OSError, RuntimeError) as error:
            reason = getattr(error, "strerror", None) or error
            raise SceneError(f"cannot read {what}: `{short(uri)}`: {reason}") from None
        if not inside:
            raise _outside(uri, what)
        return found


def _data(uri: str, what: str) -> bytes:
    head = _DATA.match(uri)
    if head is None:
        raise SceneError(f"{what}: a URI of data has to be in base64")
    try:
        return binascii.a2b_base64(uri[head.end() :], strict_mode=True)
    except (binascii.Error, ValueError):
        raise SceneError(f"{what}: the data in its URI is no base64") from None


def _outside(uri: str, what: str) -> SceneError:
    return SceneError(f"{what}: `{short(uri)}` is not in the folder of the glTF file")

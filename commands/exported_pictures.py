"""The files that a document of MaterialX names for textures; ``export.py`` asks for them.

They are those of ``--set``, or of the command in the file's comment, or of the texture's own
comment, in which importing has written it.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from ..materialx.pictures import FOLDER
from ..targets.runner.textures.kinds import without_prefix
from .comments import asked
from .render import render

if TYPE_CHECKING:
    from ..compiler.syntax import ast

_MOST = 1 << 20
"""The most letters of a file in which its comment is looked for."""
_NAMED = re.compile(r"`([^`]+)`")


class ExportedFiles:
    """The files of one export, by the paths that lead to them from the document's folder."""

    def __init__(
        self, file: Path, source: str, given: Iterable[tuple[str, str]], out: Path
    ) -> None:
        self._folder, self._out = file.parent, out
        wished = asked(source, file.name, file.parent.resolve(), 64, render).options
        self._wished = dict(wished.get("values", ()))
        self._given = dict(given)
        self.guessed: dict[str, str] = {}
        """The files of textures of which nothing is known, as the document names them."""
        self.unread = set(self._given)
        """The names of ``--set`` that are those of no texture yet."""

    def __call__(self, material: str, texture: ast.Texture) -> str:
        """The file of a material's texture."""
        name = texture.name.text
        for key in (f"{material}.{name}", name):
            if key in self._given:
                self.unread.discard(key)
                return self._from_out(Path(without_prefix(self._given[key])))
        for key in (f"{material}.{name}", name):
            if key in self._wished:
                return self._from_out(self._folder / without_prefix(self._wished[key]))
        told = _NAMED.search(texture.doc)
        for path in () if told is None else (f"{FOLDER}/{Path(told[1]).name}", told[1]):
            if (self._folder / path).is_file():
                return self._from_out(self._folder / path)
        self.guessed[name] = told[1] if told is not None else f"{name}.png"
        return self.guessed[name]

    def _from_out(self, path: Path) -> str:
        """The path of a file from the folder of the document, with slashes."""
        return Path(os.path.relpath(path, self._out)).as_posix()


def pictures_of(file: Path, given: Iterable[tuple[str, str]], out: Path) -> ExportedFiles:
    """The files for an export to the folder ``out``."""
    try:
        source = file.read_text(encoding="utf-8", errors="replace")[:_MOST]
    except (OSError, ValueError):
        source = ""  # Compiling tells it.
    return ExportedFiles(file, source, given, out)

"""Draws a file as the command in its own comment does, unless the command line says otherwise.

``render`` and ``view`` call it, so that a file shows its subject without any options. ``conform``
does not: its cases depend on declarations only. ``comments.py`` reads the comment, which may come
from anybody, and says what may be asked for.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple, Protocol

import click
from click.core import ParameterSource

from ..targets.runner.files import FileError, opened
from ..targets.runner.textures.kinds import without_prefix
from .comments import asked

_MOST = 1 << 20
"""The most bytes of a file in which its comment is looked for."""
_CHOOSING = frozenset(("material", "rig", "pass_", "target"))
"""The options that choose what is drawn. Where a command line has one of them, the comment has no
say in the others."""


class Request(Protocol):
    """The command line of a command that draws; the names are those of its options."""

    @property
    def file(self) -> Path:
        """The file that is drawn."""

    @property
    def plain(self) -> bool:
        """True if the comment has no say at all."""

    @property
    def scene(self) -> Path | None:
        """A file whose objects are drawn: the comment is about something else, then."""

    @property
    def values(self) -> tuple[tuple[str, str], ...]:
        """Values by name, as texts."""


class Wishes(NamedTuple):
    """The part of a file's comment that a command follows."""

    options: Mapping[str, Any]
    """Values of options, by the names that requests have for them; among them ``wished``, the
    values of parameters and textures."""
    note: str
    """A sentence about them; empty if there are none."""


def named_options(context: click.Context) -> frozenset[str]:
    """The names of the options that a command line has."""
    return frozenset(
        name for name in context.params
        if context.get_parameter_source(name) is not ParameterSource.DEFAULT
    )  # fmt: skip


def wishes(request: Request, named: frozenset[str], size: int, command: click.Command) -> Wishes:
    """The wishes of the file of a request, beside the options ``named`` on its command line.

    Pictures have ``size`` pixels on a side. ``command`` is ``burnish render``.
    """
    file = request.file
    source = "" if request.plain or request.scene is not None else _beginning(file)
    if not source:
        return Wishes({}, "")
    root = file.parent.resolve()
    found = asked(source, file.name, root, size, command)
    left_out = {*named, "values"} | (_CHOOSING if named & _CHOOSING else set())
    options = {name: value for name, value in found.options.items() if name not in left_out}
    given = {name for name, _text in request.values}
    values = found.options.get("values", ())
    wished = tuple((name, _placed(text, root)) for name, text in values if name not in given)
    if wished:
        options["wished"] = wished
    return Wishes(options, found.note or _said(options, file))


def _said(options: Mapping[str, Any], file: Path) -> str:
    return f"drawn as the comment of {file} asks; --plain does not" if options else ""


def _beginning(file: Path) -> str:
    """The beginning of a file; nothing of one that cannot be read, which compiling it reports."""
    try:
        with opened(file, str(file)) as stream:
            return stream.read(_MOST).decode(errors="replace")
    except (FileError, ValueError):
        return ""


def _placed(text: str, root: Path) -> str:
    """The text of a value that names files in a folder, by their whole paths; or else as it is."""
    names = without_prefix(text)
    parts = [part.strip() for part in names.split(",")]
    if not all(part and (root / part).is_file() for part in parts):
        return text
    return text.removesuffix(names) + ",".join(str(root / part) for part in parts)

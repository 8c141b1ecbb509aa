"""Finds the files that a gallery shows, and how their folder's README groups and describes them.

``command.py`` calls ``catalogue``. A table of the README has a row for each file: what it shows,
and a link to it. What no table lists comes last.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

README = "README.md"
OTHERS = "Others"
"""The heading of what no table lists."""

_HEADING = re.compile(r"^#{2,6} +(.+?)\s*$")
_ROW = re.compile(r"^\|\s*(.+?)\s*\|\s*\[[^\]]*\]\(([^)\s]+\.burnish)\)\s*\|\s*$")


class Listed(NamedTuple):
    """A file that the gallery shows."""

    path: Path
    name: str
    """Its path within the folder, with slashes."""
    what: str
    """What it shows, in the README's words; empty if these do not mention it."""


class Group(NamedTuple):
    """Files under one heading."""

    title: str
    intro: str
    """What stands between the heading and the table."""
    files: Sequence[Listed]


def catalogue(folder: Path) -> list[Group]:
    """The files of a folder and of those in it, in the order of its README."""
    found = {path.relative_to(folder).as_posix(): path for path in sorted(_files(folder))}
    groups = []
    for title, intro, rows in _tables(folder / README):
        files = [Listed(found.pop(n), n, what) for n, what in rows.items() if n in found]
        if files:
            groups.append(Group(title, intro, files))
    if found:
        rest = [Listed(path, name, "") for name, path in found.items()]
        groups.append(Group(OTHERS if groups else "", "", rest))
    return groups


def _files(folder: Path) -> Iterator[Path]:
    for path in folder.rglob("*.burnish"):
        hidden = any(part.startswith(".") for part in path.relative_to(folder).parts)
        if path.is_file() and not hidden:
            yield path


def _tables(readme: Path) -> Iterator[tuple[str, str, dict[str, str]]]:
    """The headings with their texts and tables: what each file shows, by its name."""
    try:
        lines = readme.read_text("utf-8").splitlines()
    except (OSError, UnicodeDecodeError):
        return
    title, intro, rows = "", [""], dict[str, str]()
    for line in [*lines, "## "]:
        heading = _HEADING.match(line) or (line == "## " and line)
        if heading:
            if rows:
                yield title, " ".join(filter(None, intro)), rows
            title = heading[1] if not isinstance(heading, str) else ""
            intro, rows = [], {}
        elif row := _ROW.match(line):
            rows.setdefault(row[2], row[1])
        elif not rows and not line.startswith("|"):
            intro.append(line.strip())

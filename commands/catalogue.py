"""Finds the files of a folder, and how its README groups and describes them.

``burnish gallery`` and ``burnish view`` show folders by it. A table of the README has a row for
each file: what it shows, and a link to it. What no table lists comes last.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from .folder import is_file_within

README = "README.md"
_LONGEST = 2**20
"""Characters of a README that are read."""
OTHERS = "Others"
"""The heading of what no table lists."""

_HEADING = re.compile(r"^#{1,6} +(.+?)\s*$")
_LINK = r"\[[^\]]*\]\(([^)\s]+\.burnish)\)"
_ROW = re.compile(rf"^\|\s*(?P<what>.+?)\s*\|\s*{_LINK}\s*\|\s*$")
_MENTION = re.compile(rf"{_LINK}(?:: (?P<what>[^.]+))?")
"""A link within a text, which may say behind a colon what the file shows."""


class Listed(NamedTuple):
    """A file that is shown."""

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
    """The files of a folder and of those in it, in the order of its README. What is hidden, no
    regular file, or a link that leads elsewhere, is none of them."""
    names = sorted(_files(folder), key=lambda name: name.split("/"))
    found = {name: folder / name for name in names}
    groups = []
    for title, intro, rows in _tables(folder / README):
        files = [Listed(found.pop(n), n, what) for n, what in rows.items() if n in found]
        if files:
            groups.append(Group(title, intro, files))
    if found:
        rest = [Listed(path, name, "") for name, path in found.items()]
        groups.append(Group(OTHERS if groups else "", "", rest))
    return groups


def _files(folder: Path) -> Iterator[str]:
    """The names of the files in a folder and in those in it. Links to folders are not followed;
    those to files count if they lead to one of the folder."""
    root, pending = folder.resolve(), [""]
    while pending:
        within = pending.pop()
        for entry in _entries(folder / within):
            name = within + entry.name
            if entry.name.startswith("."):
                continue
            if entry.is_dir(follow_symlinks=False):
                pending.append(f"{name}/")
            elif name.endswith(".burnish") and (
                entry.is_file(follow_symlinks=False)
                or (entry.is_symlink() and is_file_within(folder / name, root))
            ):
                yield name


def _entries(folder: Path) -> list[os.DirEntry[str]]:
    """What is in a folder; nothing if it cannot be read."""
    try:
        with os.scandir(folder) as entries:
            return list(entries)
    except OSError:
        return []


def title_of(folder: Path) -> str:
    """What the README calls the folder, or the folder's name."""
    for line in _lines(folder / README):
        if heading := _HEADING.match(line):
            return heading[1]
    return folder.resolve().name


def _lines(readme: Path) -> list[str]:
    """The lines of a README; none of one that cannot be read, or is no file of its folder."""
    try:
        if not is_file_within(readme, readme.parent.resolve()):
            return []
        with readme.open(encoding="utf-8") as file:
            return file.read(_LONGEST).splitlines()
    except (OSError, UnicodeDecodeError):
        return []


def _sections(readme: Path) -> Iterator[tuple[str, list[str]]]:
    """The headings of a text, each with the lines below it."""
    title, lines = "", list[str]()
    for line in _lines(readme):
        if heading := _HEADING.match(line):
            yield title, lines
            title, lines = heading[1], []
        else:
            lines.append(line.strip())
    yield title, lines


def _tables(readme: Path) -> Iterator[tuple[str, str, dict[str, str]]]:
    """The headings with their texts, and what each file shows that stands below, by its name."""
    for title, lines in _sections(readme):
        rows = {found[2]: found["what"] for line in lines if (found := _ROW.match(line))}
        begun = next((n for n, line in enumerate(lines) if line.startswith("|")), len(lines))
        intro = " ".join(filter(None, lines[:begun]))
        for found in _MENTION.finditer(intro):
            rows.setdefault(found[1], found["what"] or "")
        if rows:
            yield title, intro, rows

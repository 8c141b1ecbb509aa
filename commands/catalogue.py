"""Finds the files of a folder, with their groups and descriptions from its README.

``burnish gallery`` and ``burnish view`` show folders by it. A table of the README has a row for
each file: its description, and a link to it. Files that no table lists come last.

A folder may come from anybody, and the pages may be published. So only files of the folder are
read: no pipe or device, no hidden file, and no file elsewhere to which a link leads.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from ..compiler.budget import BudgetError
from ..targets.runner.files import FileError, opened

ENDING = ".burnish"
README = "README.md"
OTHERS = "Others"
"""The heading of files that no table lists."""

MOST_OF_README = 1 << 20
"""The most bytes of a README that is read."""

_HEADING = re.compile(r"#{1,6} +(.+)")
_LINK = re.compile(r"\[[^\[\]]*\]\(([^()\s]+\.burnish)\)")
_MENTION = re.compile(rf"{_LINK.pattern}(?:: (?P<what>[^.]+))?")
"""A link within a text; a description of the file may follow behind a colon."""


class Listed(NamedTuple):
    """A file that is shown."""

    path: Path
    name: str
    """The file's path within the folder, with slashes."""
    what: str
    """A description in the README's words; empty if the README does not mention the file."""


class Group(NamedTuple):
    """Files under one heading."""

    title: str
    intro: str
    """The text between the heading and the table."""
    files: Sequence[Listed]


def catalogue(folder: Path) -> list[Group]:
    """The files of a folder and its sub-folders, in the order of its README."""
    names = sorted(_files(folder), key=lambda name: name.split("/"))
    found = {name: folder / name for name in names}
    readme = _lines(folder)
    groups = []
    for title, intro, rows in _tables(readme):
        files = [Listed(found.pop(n), n, what) for n, what in rows.items() if n in found]
        if files:
            groups.append(Group(title, intro, files))
    if found:
        rest = [Listed(path, name, "") for name, path in found.items()]
        groups.append(Group(OTHERS if groups else "", "", rest))
    return groups


def is_shown(path: Path, root: Path, ending: str = "") -> bool:
    """True if a path leads to a visible file of the folder whose name has this ending.

    ``root`` is the folder's path without links. Links are followed as long as they stay in the
    folder.
    """
    try:
        real = os.path.realpath(path)
        inside = Path(real).relative_to(root)
        is_file = stat.S_ISREG(os.lstat(real).st_mode)
    except (OSError, ValueError):
        return False
    return is_file and real.endswith(ending) and not any(map(_is_hidden, inside.parts))


def _files(folder: Path) -> Iterator[str]:
    """The names of all files with the ending, in this folder and its sub-folders.

    Links to folders are left out.
    """
    root = folder.resolve()
    pending = [""]
    while pending:
        within = pending.pop()
        try:
            with os.scandir(folder / within) as entries:
                found = [entry for entry in entries if not _is_hidden(entry.name)]
        except OSError:
            continue  # Folders that may not be read are left out.
        for entry in found:
            name = within + entry.name
            if entry.is_dir(follow_symlinks=False):
                pending.append(f"{name}/")
            elif name.endswith(ENDING) and (
                entry.is_file(follow_symlinks=False) or is_shown(folder / name, root, ENDING)
            ):
                yield name


def _is_hidden(name: str) -> bool:
    return name.startswith(".")


def title_of(folder: Path) -> str:
    """The README's title, or the folder's name."""
    for line in _lines(folder):
        if heading := _HEADING.match(line):
            return heading[1].rstrip()
    return folder.resolve().name


def _lines(folder: Path) -> list[str]:
    """The lines of a folder's README; none if there is no such text, or a huge one."""
    readme = folder / README
    if not is_shown(readme, folder.resolve()):
        return []
    try:
        with opened(readme, README) as file:
            content = file.read(MOST_OF_README + 1)
            return [] if len(content) > MOST_OF_README else content.decode().splitlines()
    except (FileError, BudgetError, UnicodeDecodeError):
        return []


def _sections(readme: Sequence[str]) -> Iterator[tuple[str, list[str]]]:
    """The headings of a text, each with the lines below it."""
    title, lines = "", list[str]()
    for line in readme:
        if heading := _HEADING.match(line):
            yield title, lines
            title, lines = heading[1].rstrip(), []
        else:
            lines.append(line.strip())
    yield title, lines


def _tables(readme: Sequence[str]) -> Iterator[tuple[str, str, dict[str, str]]]:
    """The headings with their texts, and the descriptions of the files below, by file name."""
    for title, lines in _sections(readme):
        rows = dict(filter(None, map(_row, lines)))
        begun = next((n for n, line in enumerate(lines) if line.startswith("|")), len(lines))
        intro = " ".join(filter(None, lines[:begun]))
        for found in _MENTION.finditer(intro):
            rows.setdefault(found[1], found["what"] or "")
        if rows:
            yield title, intro, rows


def _row(line: str) -> tuple[str, str] | None:
    """The file of a table's row, and its description."""
    before, *cells, after = line.split("|") if line.count("|") > 2 else ("", "")
    found = _LINK.fullmatch(cells[-1].strip()) if cells and not before and not after else None
    what = "|".join(cells[:-1]).strip()
    return (found[1], what) if found and what else None

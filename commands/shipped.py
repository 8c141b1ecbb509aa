"""Finds what comes with Burnish beside its code: pages, examples, and files for build systems.

A wheel has these folders within the package, as a checkout has. ``burnish docs``, ``example`` and
``integration`` list what is in them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NoReturn

import click

from .answering import collector
from .console import say

_PACKAGE = Path(__file__).parents[1]
DOCS = _PACKAGE / "docs"
EXAMPLES = _PACKAGE / "examples"
INTEGRATIONS = _PACKAGE / "integrations"

_HEADING = re.compile(r"## +(.+)")
_ROW = re.compile(r"\| (?P<page>.+?) \| (?P<what>.+) \|")
_LINK = re.compile(r"\[[^\[\]]*\]\((?P<file>[^()\s]+)\.md\)")


def groups(folder: Path) -> dict[str, dict[str, str]]:
    """The pages that the README of a folder lists in its tables, below their headings.

    Each page's name, without its ending, has the row's other cell as a description.
    """
    found: dict[str, dict[str, str]] = {}
    title = ""
    for line in (folder / "README.md").read_text(encoding="utf-8").splitlines():
        if heading := _HEADING.fullmatch(line):
            title = heading[1]
        elif (row := _ROW.fullmatch(line)) and (link := _LINK.fullmatch(row["page"])):
            found.setdefault(title, {})[link["file"]] = row["what"].replace("`", "")
    return found


def chosen(what: str, name: str, known: Iterable[str], ending: str) -> str:
    """The known name that a person has written, with or without its folder and ending.

    Ends the command if there is none, or if there are several.
    """
    names = list(known)
    wanted = name.replace("\\", "/").removeprefix("./").removesuffix(ending).casefold()
    if wanted in names:
        return wanted
    last = [each for each in names if each.rpartition("/")[2].casefold() == wanted]
    if len(last) == 1:
        return last[0]
    return _unknown(what, name, wanted, last, names)


def say_groups(listed: Mapping[str, Mapping[str, str]]) -> None:
    """Print each name with its description, below headings."""
    if (collected := collector()) is not None:
        from ..compiler.documents.answer import ListAnswer

        pages = {name: what for rows in listed.values() for name, what in rows.items()}
        collected.find(ListAnswer(pages=pages))
        return
    width = max(len(name) for rows in listed.values() for name in rows)
    for title, rows in listed.items():
        say()
        say(f"{title}:")
        for name, what in rows.items():
            say(f"  {name:<{width}}  {what}".rstrip())


def _unknown(what: str, name: str, wanted: str, several: list[str], names: list[str]) -> NoReturn:
    from ..compiler.diagnostics.nearest import nearest

    if several:
        hint = f"there are {' and '.join(f'`{each}`' for each in several)}"
    else:
        lasts = {each.rpartition("/")[2]: each for each in names}
        near = nearest(wanted, names) or lasts.get(nearest(wanted, lasts) or "")
        hint = f"did you mean `{near}`?" if near else f"`burnish {what}` lists them"
    thing = "page" if what == "docs" else what
    raise click.UsageError(f"there is no {thing} `{name}`; {hint}")

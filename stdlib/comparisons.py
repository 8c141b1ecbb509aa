"""Names of other systems, as the pages for those who come from there have them.

The pages of ``docs`` whose names begin with ``coming_from`` compare systems in tables: names of
others on the left, and in the last column what is written here. An unknown name that has no row in
``other_names.txt`` and ``builtins/elsewhere.py`` is looked up in these tables, so that a message
says what the page says. The pages are read when the first message needs them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

from ..support.frozen import frozen

_DOCS = Path(__file__).parents[1] / "docs"
"""The documentation, which a wheel has within the package, too."""
_CELLS = re.compile(r"(?<!\\)\|")
_CODE = re.compile(r"`([^`]+)`")
_NAMED = re.compile(r"([A-Za-z_]\w*)(?:\(.*\))?;?")
"""A name alone, or one that is called."""


@frozen
class Compared:
    """What is written here for a name of another system."""

    here: str
    """The last cell of the row."""
    page: str
    """The name of the page, by which ``burnish docs`` prints it."""

    @property
    def hint(self) -> str:
        """The hint in the message about the unknown name."""
        return f"here it is {self.here}; more such names are told by `burnish docs {self.page}`"


@cache
def compared() -> Mapping[str, Compared]:
    """The names in all tables; of several rows with a name, the first one counts."""
    found: dict[str, Compared] = {}
    for path in sorted(_DOCS.glob("coming_from_*.md")):
        for name, here in names_in(path.read_text(encoding="utf-8")):
            found.setdefault(name, Compared(here, path.stem))
    return found


def names_in(page: str) -> Iterator[tuple[str, str]]:
    """The names of other systems in the tables of a page, each with what is written here."""
    for line in page.splitlines():
        if not line.startswith("| ") or line.startswith("| ---"):
            continue
        *others, here = (cell.strip() for cell in _CELLS.split(line.strip().strip("|")))
        for code in _CODE.findall(" ".join(others)):
            if named := _NAMED.fullmatch(code):
                yield named[1], here.replace("\\|", "|")

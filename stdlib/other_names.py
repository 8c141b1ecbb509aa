"""Names that other systems have, and what is written here: the rows of ``other_names.txt``.

Systems are shading languages, engines, node editors and collections of functions that people copy.
The hints for unknown functions and docs/builtins.md are made from this table, which is read when
the first message needs it. The words of other languages that are no functions are in
``builtins/elsewhere.py``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from types import MappingProxyType

from ..support.frozen import frozen

TEXTURE = "albedo"
"""The name of the texture in ``Instead.written``."""


@frozen
class Instead:
    """The replacement here for a name of another system."""

    written: tuple[str, ...] = ()
    """Expressions with the same meaning, one for each result.

    The head of the table says for which values their letters stand.
    """
    reason: str = ""
    """The reason why there is no such expression, or further advice."""

    @property
    def hint(self) -> str:
        """The hint in the message about the unknown name."""
        shown = " and ".join(f"`{expression}`" for expression in self.written)
        parts = [f"it is {shown} here" if shown else "", self.reason]
        return "; ".join(filter(None, parts))

    @property
    def is_read(self) -> bool:
        """True if the name is a function that reads a texture."""
        return any(expression.startswith(TEXTURE) for expression in self.written)

    def hint_for(self, texture: str) -> str:
        """The hint for somebody who reads this texture."""
        return self.hint.replace(TEXTURE, texture)


@frozen
class Meant:
    """The functions of one file of the library of which each may be meant by a name elsewhere."""

    path: str
    """The import path of the file, such as ``std.color``."""
    names: tuple[str, ...]
    advice: str = ""
    """The difference between the two, behind a ``where``, if a call needs more than a new name."""


def folded(name: str) -> str:
    """A name without upper case and underscores, in which the styles of systems differ."""
    return name.casefold().replace("_", "")


Row = tuple[tuple[str, ...], tuple[str, ...], str]
"""Names elsewhere, what is written here, and advice."""


def rows_of(table: str) -> dict[str, list[Row]]:
    """The rows of a table, by their sections."""
    sections: dict[str, list[Row]] = {}
    texts: dict[str, str] = {}
    rows: list[Row] = []
    for line in _joined(table):
        names, _, rest = line.partition(" = ")
        if line.startswith("["):
            rows = sections.setdefault(line.strip("[]"), [])
        elif line.startswith("$"):
            texts[names] = rest
        else:
            here, _, advice = f" {rest}".partition(" -- ")
            written = tuple(filter(None, here.strip().split(" ; ")))
            rows.append((tuple(names.split()), written, texts.get(advice, advice)))
    return sections


def _joined(table: str) -> list[str]:
    """The lines of a table without comments; those that go on with another one are joined to it."""
    found: list[str] = []
    for line in table.splitlines():
        if line.startswith(" "):
            found[-1] += f" {line.strip()}"
        elif line and not line.startswith("#"):
            found.append(line)
    return found


def _instead(rows: Iterable[Row]) -> Mapping[str, Instead]:
    """Names of a section whose rows have expressions."""
    found: dict[str, Instead] = {}
    for names, here, advice in rows:
        found.update(dict.fromkeys(names, Instead(here, advice)))
    return MappingProxyType(found)


def _meant(sections: Mapping[str, Iterable[Row]]) -> Mapping[str, Meant]:
    """Names of the sections whose rows have functions of the library."""
    found: dict[str, Meant] = {}
    for path, rows in sections.items():
        for names, here, advice in rows:
            found.update(dict.fromkeys(names, Meant(path, tuple(here[0].split()), advice)))
    return MappingProxyType(found)


_SECTIONS = rows_of(Path(__file__).with_suffix(".txt").read_text(encoding="utf-8"))

FUNCTIONS: Mapping[str, Instead] = _instead(_SECTIONS.pop("functions"))
"""Functions of other shading languages, by their names there."""
NODES: Mapping[str, Instead] = _instead(_SECTIONS.pop("nodes"))
"""Nodes of editors, and functions that people copy, which are a short expression here."""
NODES_BY_FOLDED: Mapping[str, Instead] = MappingProxyType(
    {folded(name): instead for name, instead in NODES.items()}
)
"""The same by folded names, as unknown ones are looked up."""
SYNONYMS: Mapping[str, Meant] = _meant(_SECTIONS)
"""By a name elsewhere: the function of the library, or several of one file to choose from."""
BY_FOLDED: Mapping[str, Meant] = MappingProxyType(
    {folded(name): meant for name, meant in SYNONYMS.items()}
)
"""The same by folded names, as unknown ones are looked up."""

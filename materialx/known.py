"""The definitions of MaterialX's own library, as records."""

from __future__ import annotations

from functools import cache

from .library import library
from .model import Definition
from .records import Records


def known(category: str) -> list[Definition]:
    """The definitions of a category; none if the library has no such node."""
    names = [found.getName() for found in library().getMatchingNodeDefs(category)]
    return [found for name in names if (found := _records().definition(name)) is not None]


def surface(category: str) -> Definition:
    """The definition of a category that documents mean who name no version."""
    found = library().getMatchingNodeDefs(category)
    usual = next((each for each in found if each.getDefaultVersion()), found[0])
    definition = _records().definition(usual.getName())
    assert definition is not None
    return definition


@cache
def categories() -> dict[str, list[str]]:
    """The categories of all nodes of the library, by their names as those of Burnish."""
    from .names import slot_name

    found: dict[str, list[str]] = {}
    for definition in library().getNodeDefs():
        rows = found.setdefault(slot_name(definition.getNodeString()), [])
        if definition.getNodeString() not in rows:
            rows.append(definition.getNodeString())
    return found


@cache
def _records() -> Records:
    return Records(library(), library(), {})

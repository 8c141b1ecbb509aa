"""Finds the languages of hosts: every folder beside this file that has a ``language.py``."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from . import __name__ as package

if TYPE_CHECKING:
    from .host_language import HostLanguage


@cache
def names() -> tuple[str, ...]:
    """The names of all languages, sorted; none of them is imported for this."""
    inside = Path(__file__).parent.iterdir()
    return tuple(sorted(each.name for each in inside if (each / "language.py").is_file()))


@cache
def load(name: str) -> HostLanguage:
    """The language called ``name``; ``KeyError`` if there is none."""
    if name not in names():
        raise KeyError(name)
    language: HostLanguage = import_module(f"{package}.{name}.language").LANGUAGE
    return language

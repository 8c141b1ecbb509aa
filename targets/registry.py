"""Finds the languages: every folder beside this file that has a ``language.py``."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pathlib import Path

from . import __name__ as package
from . import __path__ as folders
from .description.faults import check
from .description.profile import Profile
from .description.shading_language import Language


def names() -> tuple[str, ...]:
    """The names of all languages, sorted; none of them is imported for this."""
    return _names_in(tuple(folders))


@cache
def _names_in(places: tuple[str, ...]) -> tuple[str, ...]:
    """The folders are read once: to look for files takes longer than a whole pass."""
    inside = (folder for place in places for folder in Path(place).iterdir())
    return tuple(sorted(each.name for each in inside if (each / "language.py").is_file()))


def defaults() -> tuple[str, ...]:
    """The languages for which a material is compiled if no language is named."""
    return tuple(name for name in names() if not load(name).unproven)


@cache
def load(name: str) -> Language:
    """The language called ``name``.

    Raises ``KeyError`` if there is none, and ``LanguageError`` if its description has faults.
    """
    if name not in names():
        raise KeyError(name)
    language: Language = import_module(f"{package}.{name}.language").LANGUAGE
    check(language)
    return language


def select(text: str) -> tuple[Language, Profile]:
    """The language and profile that a user means by ``glsl`` or ``glsl:gl330``; or ``KeyError``."""
    name, _, profile = text.partition(":")
    language = load(name)
    return language, language.profile(profile)

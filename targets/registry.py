"""The targets there are: every folder beside this file that has a ``target.py``."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pathlib import Path

from . import __name__ as package
from . import __path__ as folders
from .emit.description import Profile, Target


def names() -> tuple[str, ...]:
    """The names of all targets, sorted; none of them is imported for this."""
    rows = (row for folder in folders for row in Path(folder).glob("*/target.py"))
    return tuple(sorted(row.parent.name for row in rows))


def defaults() -> tuple[str, ...]:
    """The names of those that a material is compiled for when no target is named."""
    return tuple(name for name in names() if not load(name).unproven)


@cache
def load(name: str) -> Target:
    """The target called ``name``; ``KeyError`` if there is none."""
    if name not in names():
        raise KeyError(name)
    target: Target = import_module(f"{package}.{name}.target").TARGET
    return target


def select(text: str) -> tuple[Target, Profile]:
    """The target and profile that a user means by ``glsl`` or ``glsl:gl330``; or ``KeyError``."""
    name, _, profile = text.partition(":")
    target = load(name)
    return target, target.profile(profile)

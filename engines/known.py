"""Finds the engines: every folder beside this file that has an ``engine.py``."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pathlib import Path

from . import __name__ as package
from . import __path__ as folders
from .engine import Engine


@cache
def names() -> tuple[str, ...]:
    """The names of all engines, sorted; none of them is imported for this."""
    inside = (folder for place in folders for folder in Path(place).iterdir())
    found = (each.name for each in inside if (each / "engine.py").is_file())
    return tuple(sorted(name.replace("_", "-") for name in found))


@cache
def load(name: str) -> Engine:
    """The engine called ``name``; ``KeyError`` if there is none."""
    if name not in names():
        raise KeyError(name)
    engine: Engine = import_module(f"{package}.{name.replace('-', '_')}.engine").ENGINE
    return engine

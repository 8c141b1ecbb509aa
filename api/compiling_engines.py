"""Compiles materials to the files of engines that light surfaces themselves.

``entry_points.py`` calls ``engine_files`` with everything that its caller has asked for.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..engines import registry
from ..engines.engine import Engine, Surface
from ..engines.inputs import offers
from ..support.frozen import EMPTY
from .compiling_functions import AskedFunctions, functions_of


def surfaces_of(
    source: str | Path,
    engine: Engine,
    *,
    material: str | None = None,
    search_path: tuple[Path, ...] = (),
    renamed: Mapping[str, str] = EMPTY,
) -> list[Surface]:
    """The materials of a file as functions for an engine. Raises ``CompileError``."""
    asked = AskedFunctions(
        (),
        source,
        search_path,
        material,
        None,
        (),
        False,
        None,
        (),
        offers=offers(renamed),
        chosen=(engine.language(),),
    )
    return [Surface(each.document, each.files[0].emission, renamed) for each in functions_of(asked)]


def engine_files(
    source: str | Path,
    engine: Engine,
    *,
    material: str | None = None,
    search_path: tuple[Path, ...] = (),
    renamed: Mapping[str, str] = EMPTY,
) -> dict[str, str]:
    """The files of an engine, by their names. Raises ``CompileError`` or ``EngineError``."""
    found = surfaces_of(source, engine, material=material, search_path=search_path, renamed=renamed)
    return {f"{each.name}.{engine.extension}": engine.write(each) for each in found}


__all__ = ["engine_files", "registry", "surfaces_of"]

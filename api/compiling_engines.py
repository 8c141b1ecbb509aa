"""Compiles materials to the files of engines that light surfaces themselves.

``entry_points.py`` calls ``engine_files`` with everything that its caller has asked for, and
``compiling_functions.py`` makes the functions that the files consist of.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..compiler.reflection.roles import scene_names
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
    """The materials of a file as functions for an engine. Raises ``CompileError``.

    A material without anything that an engine could light is left out.
    """
    asked = AskedFunctions(
        targets=(), source=source, search_path=search_path, material=material, rig=None, slots=(),
        together=False, prefix=None, values=(),
        offers=offers(renamed, scene_names()["slots"]), languages=(engine.language(),),
    )  # fmt: skip
    found = functions_of(asked)
    return [Surface(each.document, each.files[0].emission, renamed) for each in found]


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

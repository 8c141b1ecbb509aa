"""Compiles materials to the files of engines that light surfaces themselves.

``entry_points.py`` calls ``engine_files`` with everything that its caller has asked for, and
``compiling_functions.py`` makes the functions that the files consist of.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..compiler.diagnostics.diagnostic import CompileError, Report
from ..compiler.documents.functions import FunctionRow, Functions
from ..compiler.reflection.roles import scene_names
from ..engines.engine import Engine
from ..engines.inputs import offers
from ..support.frozen import EMPTY, changed, frozen
from ..targets.emit.functions import FunctionEmission
from ..targets.registry import select
from .compiling_functions import AskedFunctions, functions_of


@frozen
class ForEngine:
    """A material as functions in the languages that an engine takes."""

    document: Functions
    emissions: Mapping[str, FunctionEmission]


def functions_for(
    source: str | Path,
    engine: Engine,
    *,
    material: str | None = None,
    search_path: tuple[Path, ...] = (),
    named: Mapping[str, str] = EMPTY,
) -> list[ForEngine]:
    """The materials of a file as functions for an engine. Raises ``CompileError``.

    ``named`` are slots that a user has named for a value of the engine: ``stain`` for
    ``base_color``. A material without anything that an engine could light is left out.
    """
    languages = [select(name) for name in engine.targets]
    if engine.dialect is not None:
        languages.append(engine.dialect())
    asked = AskedFunctions(
        targets=(), source=source, search_path=search_path, material=material, rig=None, slots=(),
        together=False, prefix=None, values=(),
        offers=offers(scene_names()["slots"], named), languages=tuple(languages),
    )  # fmt: skip
    return [
        ForEngine(
            _with_roles(each.document, {slot: word for word, slot in named.items()}),
            {f"{file.target}:{file.profile}": file.emission for file in each.files},
        )
        for each in functions_of(asked)
    ]


def _with_roles(document: Functions, roles: Mapping[str, str]) -> Functions:
    """A document in which slots have the roles that a user gives them, and no others have these."""

    def row(function: FunctionRow) -> FunctionRow:
        slots = []
        for slot in function.slots:
            role = None if slot.role in roles.values() else slot.role
            slots.append(changed(slot, role=roles.get(slot.name, role)))
        return changed(function, slots=tuple(slots))

    return changed(document, functions=tuple(map(row, document.functions)))


def engine_files(
    source: str | Path,
    engine: Engine,
    *,
    material: str | None = None,
    search_path: tuple[Path, ...] = (),
    named: Mapping[str, str] = EMPTY,
) -> dict[str, str]:
    """The files of an engine, by their names. Raises ``CompileError``."""
    report, files = Report(), dict[str, str]()
    found = functions_for(source, engine, material=material, search_path=search_path, named=named)
    for each in found:
        files |= engine.write(each.document, each.emissions, report)
    if report.failed:
        raise CompileError(report.diagnostics)
    return files

"""Compiles materials to what an engine takes in a dialect of its own, which is no target.

``function_files.py`` calls ``functions_for`` for engines that light surfaces themselves, and
``shaders_for`` for those that take whole shaders.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import CompileError, Report
from ..compiler.diagnostics.nearest import suggestion
from ..compiler.documents.functions import FunctionRow, Functions, SlotRow
from ..compiler.ir.functions import Offer
from ..compiler.passes.pipeline import Options
from ..engines.engine import Engine
from ..engines.slot_table import INPUTS, left_to, offers
from ..support.frozen import EMPTY, changed
from ..targets.emit.emitter import EmitOptions
from .compiled import CompiledMaterial, CompileResult
from .compiled_functions import CompiledFunctions, FunctionsResult
from .compiling import Asked, result_of
from .compiling_functions import AskedFunctions, functions_of


def functions_for(
    engine: Engine,
    source: str | Path,
    *,
    material: str | None = None,
    rig: str | None = None,
    search_path: tuple[Path, ...] = (),
    prefix: str | None = None,
    values: tuple[tuple[str, str], ...] = (),
    named: Mapping[str, str] = EMPTY,
    only: Sequence[str] = (),
) -> FunctionsResult:
    """The materials of a file as functions that an engine takes. Raises ``CompileError``.

    ``named`` are slots that a user has named for a value of the engine: ``stain`` for
    ``base_color``; ``only`` are the slots to which others are not added, if there are any. A
    material without anything that an engine could light is left out.
    """
    _check_words(named)
    offered: tuple[Offer, ...] = ()
    slots: tuple[str, ...] = ()
    languages = () if engine.dialect is None else (engine.dialect(),)
    if languages:
        _check_places(engine, only)
    if engine.is_offered and (languages or not only):
        offered = offers(engine.name, named, only, engine.taken)
    elif only:  # Functions in a target may be of any slots, for users' own nodes.
        slots = (*only, *named.values())
    left = left_to(engine.name) if engine.by_hand else ()
    asked = AskedFunctions(
        targets=engine.targets, source=source, search_path=search_path, material=material, rig=rig,
        slots=slots, together=False, prefix=prefix, values=values, offers=offered,
        left=left, languages=languages,
    )  # fmt: skip
    found = functions_of(asked)
    _check_slots(found, (*named.values(), *(each.partition("@")[0] for each in only)))
    return changed(found, materials=tuple(_with_roles(each, named) for each in found))


def _check_places(engine: Engine, only: Sequence[str]) -> None:
    """Raise ``CompileError`` if somebody says for what such an engine computes a slot."""
    report = Report()
    for slot in only:
        if "@" in slot:
            reason = "it has a place of its own for each slot: leave out what follows `@`"
            report.add(rules.UNFIT_FOR_ENGINE, None, engine=engine.title, slot=slot, reason=reason)
    if report.failed:
        raise CompileError(report.diagnostics)


def _check_words(named: Mapping[str, str]) -> None:
    known = [row.name for row in INPUTS]
    report = Report()
    for word in named:
        if word not in known:
            hint = suggestion(word, known) or f"there are {', '.join(known)}"
            report.add(rules.NO_SUCH_VALUE, None, name=word, hint=hint)
    if report.failed:
        raise CompileError(report.diagnostics)


def _check_slots(found: FunctionsResult, wanted: Collection[str]) -> None:
    """Raise ``CompileError`` if no material has a slot that was named."""
    report = Report()
    functions = [row for each in found for row in each.document.functions]
    known = [slot.name for row in functions for slot in row.slots]
    names = "`, `".join(each.name for each in found)
    for slot in wanted:
        if slot not in known:
            report.add(
                rules.NO_SUCH_SLOT, None, name=names, slot=slot, hint=suggestion(slot, known)
            )
    if report.failed:
        raise CompileError(report.diagnostics)


def _with_roles(material: CompiledFunctions, named: Mapping[str, str]) -> CompiledFunctions:
    """A material whose slots have the roles that a user gives them; no others have these."""
    if not named:
        return material

    def role(slot: SlotRow) -> str | None:
        given = [word for word, name in named.items() if name == slot.name]
        own = None if slot.role in named else slot.role
        return slot.role if slot.role in given else own or next(iter(given), None)

    def row(function: FunctionRow) -> FunctionRow:
        slots = (changed(slot, role=role(slot)) for slot in function.slots)
        return changed(function, slots=tuple(slots))

    def document() -> Functions:
        made = material.document
        known = {slot.name for each in made.functions for slot in each.slots}
        own = {word: slot for word, slot in named.items() if slot in known}
        return changed(made, functions=tuple(map(row, made.functions)), named=own)

    return CompiledFunctions(material.name, material.files, document)


def shaders_for(
    engine: Engine,
    source: str | Path,
    *,
    material: str | None = None,
    rig: str | None = None,
    pass_: str | None = None,
    search_path: tuple[Path, ...] = (),
    values: tuple[tuple[str, str], ...] = (),
    hoist: bool = True,
) -> CompileResult:
    """The materials of a file as whole shaders in an engine's dialect. Raises ``CompileError``."""
    assert engine.dialect is not None
    asked = Asked(
        targets=(), source=source, search_path=search_path, material=material, rig=rig,
        pass_=pass_, options=Options(hoist), emit=EmitOptions(), partial=False,
        native_stages=False, keep_graphs=False, values=values, languages=(engine.dialect(),),
    )  # fmt: skip
    return result_of(asked)


def shader_files(engine: Engine, material: CompiledMaterial, report: Report) -> Mapping[str, str]:
    """The files of an engine for one material; what the engine lacks is reported."""
    assert engine.write_shaders is not None
    texts = {file.stage: file.text for file in material.files}
    return engine.write_shaders(material.reflection, texts, report)

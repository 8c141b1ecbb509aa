"""What an engine is given of a material: what it cannot take is told, and never lost in silence.

``function_files.py`` calls ``files`` for each material of ``--engine``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import Report
from ..compiler.documents.functions import Functions
from ..compiler.reflection.roles import scene_names
from ..support.frozen import changed
from ..targets.emit.functions import FunctionEmission
from .engine import Emissions, Engine
from .slot_table import INPUTS, Input, found, is_lit, misfit
from .surface import Surface

NOTHING_TAKEN = (
    "none of its slots is a value that the engine takes; name one, as in `--slots base_color=…`"
)


def files(
    engine: Engine, document: Functions, emissions: Emissions, report: Report
) -> Mapping[str, str]:
    """The engine's files of one material, by their names; none if something is wrong."""
    before = report.count
    _check_named(engine, document, report)
    for row in _lacking(engine, document):
        slot = found(document)[row.name].slots[0].name
        if row.is_needed:
            report.add(
                rules.UNFIT_FOR_ENGINE, None, engine=engine.title, slot=slot,
                reason="its materials have nothing of that kind",
            )  # fmt: skip
        else:
            report.add(
                rules.LEFT_TO_ENGINE, None, engine=engine.title, value=row.name, slot=slot,
                name=document.material,
            )  # fmt: skip
    if any(each.severity == "error" for each in report.since(before)):
        return {}
    written = engine.write(document, emissions, report)
    if written and not engine.by_hand and not engine.taken & found(document).keys():
        report.add(
            rules.UNFIT_FOR_ENGINE, None, engine=engine.title, slot=document.material,
            reason=NOTHING_TAKEN,
        )  # fmt: skip
        return {}
    if written and not engine.by_hand and _is_white(document):
        report.add(rules.WHITE_IN_ENGINE, None, engine=engine.title, name=document.material)
    return written


def _check_named(engine: Engine, document: Functions, report: Report) -> None:
    """Report slots that somebody has named for a value which they cannot be."""
    given = found(document)
    for row in INPUTS:
        if row.name in document.named and row.name in given:
            (slot,) = given[row.name].slots
            if reason := misfit(row.name, slot):
                report.add(
                    rules.UNFIT_FOR_ENGINE, None, engine=engine.title, slot=slot.name,
                    reason=reason,
                )  # fmt: skip


def _is_white(document: Functions) -> bool:
    """True if an engine lights a surface that says no colour of it."""
    given = found(document)
    return is_lit(given) and "base_color" not in given


def taken(engine: Engine, document: Functions, emission: FunctionEmission) -> Functions:
    """The document without the functions that the engine's files do not have."""
    if engine.by_hand:
        computed = tuple(each.row for each in Surface(document, emission).computed)
        return changed(document, functions=computed)
    given = found(document)
    others = {given[row.name].name for row in INPUTS if row.name in given} - {
        given[name].name for name in engine.taken if name in given
    }
    kept = tuple(row for row in document.functions if row.name not in others)
    return changed(document, functions=kept)


def _lacking(engine: Engine, document: Functions) -> Iterator[Input]:
    """The values that the material gives and the engine does not take, if they have an effect.

    A slot that moves the mesh is no such value where others follow from it that the engine takes.
    """
    given = found(document)
    moving = {full.rpartition(".")[2]: words for full, words in scene_names()["moving"].items()}
    for row in INPUTS:
        followed = moving.get(row.name, "").split()
        is_served = any(word in given and word in engine.taken for word in followed)
        has_effect = all(word in given for word in row.beside)
        if row.name in given and row.name not in engine.taken and has_effect and not is_served:
            yield row

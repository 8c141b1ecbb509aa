"""What three.js cannot do: ``module.py`` asks before it writes anything."""

from __future__ import annotations

from ...compiler.diagnostics import rules
from ...compiler.diagnostics.diagnostic import Report
from ...compiler.documents.functions import ArgumentRow, Functions, FunctionTextureRow
from .. import slot_table
from . import inputs
from .slots import PHYSICAL, SHARED, UNLIT

VALUES = frozenset(row.word for row in (*PHYSICAL, *UNLIT, *SHARED))
"""The values that become nodes."""


def fits(document: Functions, report: Report) -> bool:
    """True if three.js can call all functions; what it cannot do is reported with the slot."""
    arguments = {row.name: row for row in document.arguments}
    textures = {row.name: row for row in document.textures}
    for function in document.functions:
        lacking = [
            *(_lacking_argument(arguments[name]) for name in function.arguments),
            *(_lacking_texture(textures[name]) for name in function.textures),
        ]
        for reason in filter(None, lacking):
            report.add(
                rules.UNFIT_FOR_ENGINE, None, slot=function.name, engine="three.js", reason=reason
            )
            break
    for value, function in slot_table.found(document).items():
        (slot,) = function.slots
        if value in VALUES and (reason := slot_table.misfit(value, slot)):
            report.add(
                rules.UNFIT_FOR_ENGINE, None, slot=slot.name, engine="three.js", reason=reason
            )
    return not report.failed


def _lacking_argument(row: ArgumentRow) -> str:
    if row.source == "pipeline" and row.given not in inputs.PIPELINE:
        return f"no node has `{row.given}` as Burnish means it"
    is_set = row.source == "parameter" and not inputs.of_renderer(row)
    if is_set and inputs.uniform_type(row) not in inputs.VALUES:
        return f"no uniform is a {row.representation}, as `{row.given}` is"
    if row.source in ("attribute", "varying") and row.representation.startswith(("mat", "bool")):
        return f"no varying is a {row.representation}, as `{row.given}` is"
    return ""


def _lacking_texture(row: FunctionTextureRow) -> str:
    known = row.type in inputs.TEXTURES and row.sample == "float"
    return "" if known else f"functions take no {row.type}, as `{row.name}` is"

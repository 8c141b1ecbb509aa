"""Writes a material as an extension of Bevy's: ``engine.py`` has ``write`` in its row."""

from __future__ import annotations

from collections.abc import Mapping

from ...compiler.diagnostics import rules
from ...compiler.diagnostics.diagnostic import Report
from ...compiler.documents.functions import Functions
from ...targets.emit.functions import FunctionEmission
from ..surface import Surface, UnfitError
from .module import module_text
from .shader import shader_text
from .statements import Statements


def write(
    document: Functions, emissions: Mapping[str, FunctionEmission], report: Report
) -> Mapping[str, str]:
    """The shader and its module, by the names of their files; none if something is reported."""
    (emission,) = emissions.values()
    surface = Surface(document, emission)
    try:
        statements = Statements(surface)
        shader = shader_text(surface, statements)
        file = f"{surface.name}.wgsl"
        return {file: shader, f"{surface.name}.rs": module_text(surface, statements, shader, file)}
    except UnfitError as error:
        report.add(
            rules.UNFIT_FOR_ENGINE, None, engine="Bevy", slot=error.name, reason=error.reason
        )
        return {}

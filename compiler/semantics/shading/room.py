"""Decides if a compile may elaborate one more material, kernel or frame."""

from __future__ import annotations

from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ..inheritance.flattening import Records
from ..names.modules import Symbol
from ..work import MOST_NODES


def has_room(symbol: Symbol, records: Records, report: Report) -> bool:
    """True if the elaborations before have left room for this one.

    If not, that is reported of the first one without room.
    """
    work = records.work
    if work.is_spent and not work.is_told:
        work.is_told = True
        name, path = symbol.declaration.name, symbol.module.file.source.name
        most = f"{MOST_NODES:,}"
        report.add(rules.TOO_MUCH_TOGETHER, name.span, name=name.text, path=path, most=most)
    return not work.is_spent

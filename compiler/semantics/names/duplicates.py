"""Names that may be given once in one place."""

from __future__ import annotations

from collections.abc import Iterable

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...syntax import ast


def check_once(report: Report, names: Iterable[ast.Name], hint: str = "") -> None:
    """Report every name that stands a second time among ``names``, with a hint if need be."""
    seen: dict[str, ast.Name] = {}
    for name in names:
        first = seen.setdefault(name.text, name)
        if first is not name:
            labels = [Label(first.span, "first defined here")]
            report.add(rules.DUPLICATE_NAME, name.span, name=name.text, labels=labels, hint=hint)

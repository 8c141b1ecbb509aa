"""Gives a module the names that it imports from another module."""

from __future__ import annotations

from functools import partial

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...diagnostics.nearest import respelling
from ...diagnostics.source import Span
from ...syntax import ast
from .modules import Module, Symbol


def import_names(module: Module, wanted: ast.Import, found: Module | None, report: Report) -> None:
    """Give a module the names that it imports from one that was ``found``."""
    names = wanted.names
    if found is None:
        module.missing.update(name.text for name in names or ())
        module.incomplete |= names is None
        return
    if names is None:
        _import_whole(module, found, wanted.span, report)
        return
    for name in names:
        symbols = found.declared.get(name.text)
        if symbols is None:
            hint = respelling(name.text, name.span, found.declared)
            meant = "" if isinstance(hint, str) else hint.fixes[0].edits[0].text
            module.missing.update((name.text, meant or name.text))
            report.add(
                rules.UNKNOWN_EXPORT, name.span, name=name.text, path=found.file.source.name,
                hint=hint,
            )  # fmt: skip
        else:
            known = module.imported.setdefault(name.text, symbols)
            if known is not symbols:
                _report_ambiguous(known[0], name.span, report)
            module.chosen.add((found.path, name.text))


def _import_whole(module: Module, found: Module, span: Span, report: Report) -> None:
    """Everything a file declares; of two files with the same name, one has to be chosen."""
    for name, symbols in found.declared.items():
        known = module.imported.setdefault(name, symbols)
        other = known[0].module
        if other is found or name in module.declared or (other.path, name) in module.chosen:
            continue
        module.doubtful[name] = partial(_report_ambiguous, known[0], span, report)


def _report_ambiguous(other: Symbol, span: Span, report: Report) -> None:
    labels = [Label(other.declaration.name.span, "the other one")]
    report.add(
        rules.AMBIGUOUS_NAME, span, name=other.name, labels=labels,
        hint=f"ask for the one that is meant: `import ….{{{other.name}}}`",
    )  # fmt: skip

"""Diagnostics as records of the answer, for editors and build tools; see ``answering.py``."""

from __future__ import annotations

from ..compiler.diagnostics.diagnostic import Diagnostic
from ..compiler.diagnostics.fixes import Fix
from ..compiler.diagnostics.source import Source, Span
from ..compiler.documents.answer import (
    DiagnosticRow,
    EditRow,
    FixRow,
    LabelRow,
    PositionRow,
    SpanRow,
)


def diagnostic_row(diagnostic: Diagnostic) -> DiagnosticRow:
    """Everything a tool needs; lines and columns count from 1, offsets in characters from 0."""
    return DiagnosticRow(
        code=diagnostic.rule.code,
        severity=diagnostic.severity,
        message=diagnostic.message,
        span=_span(diagnostic.span) if diagnostic.span else None,
        caption=diagnostic.caption,
        labels=tuple(LabelRow(span=_span(e.span), text=e.text) for e in diagnostic.labels),
        hint=diagnostic.hint,
        fixes=tuple(map(_fix, diagnostic.fixes)),
        help=diagnostic.rule.help,
    )


def _fix(fix: Fix) -> FixRow:
    edits = (EditRow(span=_span(edit.span), text=edit.text) for edit in fix.edits)
    return FixRow(applicability=fix.applicability, edits=tuple(edits))


def _span(span: Span) -> SpanRow:
    return SpanRow(
        file=span.source.name,
        start=_position(span.source, span.start),
        end=_position(span.source, span.end),
    )


def _position(source: Source, offset: int) -> PositionRow:
    line, column = source.position(offset)
    return PositionRow(line=line, column=column, offset=offset)

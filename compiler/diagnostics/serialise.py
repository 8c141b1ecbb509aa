"""Diagnostics as JSON-ready data, for editors and build tools."""

from __future__ import annotations

from typing import Any

from .diagnostic import Diagnostic
from .fixes import Fix
from .source import Source, Span


def serialise(diagnostic: Diagnostic) -> dict[str, Any]:
    """Everything a tool needs; lines and columns count from 1, offsets in characters from 0."""
    return {
        "code": diagnostic.rule.code,
        "severity": diagnostic.severity,
        "message": diagnostic.message,
        "span": _span(diagnostic.span) if diagnostic.span else None,
        "caption": diagnostic.caption,
        "labels": [{"span": _span(label.span), "text": label.text} for label in diagnostic.labels],
        "hint": diagnostic.hint,
        "fixes": [_fix(fix) for fix in diagnostic.fixes],
        "help": diagnostic.rule.help,
    }


def _fix(fix: Fix) -> dict[str, Any]:
    edits = [{"span": _span(edit.span), "text": edit.text} for edit in fix.edits]
    return {"applicability": fix.applicability, "edits": edits}


def _span(span: Span) -> dict[str, Any]:
    return {
        "file": span.source.name,
        "start": _position(span.source, span.start),
        "end": _position(span.source, span.end),
    }


def _position(source: Source, offset: int) -> dict[str, int]:
    line, column = source.position(offset)
    return {"line": line, "column": column, "offset": offset}

"""Diagnostics as a log in SARIF 2.1.0, the format in which tools for code review take findings.

It follows https://docs.oasis-open.org/sarif/sarif/v2.1.0/sarif-v2.1.0.html. ``message_forms.py``
calls ``sarif``. Tests hold its logs against the schema of the standard.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from .. import __version__

if TYPE_CHECKING:
    from ..compiler.diagnostics.diagnostic import Diagnostic, Rule, Severity
    from ..compiler.diagnostics.fixes import Edit, Fix
    from ..compiler.diagnostics.source import Span

SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)
_PLACEHOLDER = re.compile(r"\{\w+\}")


def sarif(
    diagnostics: Sequence[Diagnostic],
    exit_code: int,
    remarks: Iterable[tuple[Severity, str]] = (),
) -> str:
    """The log of one run; ``remarks`` are about the run itself, and no place in a file."""
    import json

    rules = {each.rule.code: each.rule for each in diagnostics}
    numbers = {code: number for number, code in enumerate(rules)}
    run = {
        "tool": {
            "driver": {
                "name": "Burnish",
                "version": __version__,
                "rules": [_rule(rule) for rule in rules.values()],
            }
        },
        "columnKind": "unicodeCodePoints",
        "invocations": [_invocation(exit_code, remarks)],
        "results": [_result(each, numbers[each.rule.code]) for each in diagnostics],
    }
    log = {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}
    return json.dumps(log, indent=2, ensure_ascii=False) + "\n"


def _invocation(exit_code: int, remarks: Iterable[tuple[Severity, str]]) -> dict[str, Any]:
    found: dict[str, Any] = {"executionSuccessful": exit_code == 0, "exitCode": exit_code}
    if said := [{"level": level, "message": _message(text)} for level, text in remarks]:
        found["toolExecutionNotifications"] = said
    return found


def _rule(rule: Rule) -> dict[str, Any]:
    return {
        "id": rule.code,
        "shortDescription": _message(_PLACEHOLDER.sub("…", rule.message)),
        "help": _message(rule.help),
        "defaultConfiguration": {"level": rule.severity},
    }


def _result(found: Diagnostic, rule: int) -> dict[str, Any]:
    result: dict[str, Any] = {
        "ruleId": found.rule.code,
        "ruleIndex": rule,
        "level": found.severity,
        "message": _message(f"{found.message}: {found.hint}" if found.hint else found.message),
    }
    if found.span is not None:
        marked = {"message": _message(found.caption)} if found.caption else {}
        result["locations"] = [{"physicalLocation": _place(found.span), **marked}]
    if found.labels:
        result["relatedLocations"] = [
            {"id": number, "physicalLocation": _place(each.span), "message": _message(each.text)}
            for number, each in enumerate(found.labels, 1)
        ]
    if found.fixes:
        result["fixes"] = [_fix(each, found.hint) for each in found.fixes]
    return result


def _fix(fix: Fix, hint: str) -> dict[str, Any]:
    by_file: dict[str, list[Edit]] = {}
    for edit in fix.edits:
        by_file.setdefault(edit.span.source.name, []).append(edit)
    return {
        "description": _message(hint),
        "artifactChanges": [
            {
                "artifactLocation": _file(name),
                "replacements": [
                    {"deletedRegion": _region(edit.span), "insertedContent": {"text": edit.text}}
                    for edit in edits
                ],
            }
            for name, edits in by_file.items()
        ],
        "properties": {"applicability": fix.applicability},
    }


def _place(span: Span) -> dict[str, Any]:
    return {"artifactLocation": _file(span.source.name), "region": _region(span)}


def _region(span: Span) -> dict[str, int]:
    line, column = span.source.position(span.start)
    end_line, end_column = span.source.position(span.end)
    return {
        "startLine": line, "startColumn": column, "endLine": end_line, "endColumn": end_column,
        "charOffset": span.start, "charLength": span.end - span.start,
    }  # fmt: skip


def _file(name: str) -> dict[str, str]:
    """The address of a file: a relative one stays relative, whatever folder a log is made in."""
    path = Path(name)
    return {"uri": path.as_uri() if path.is_absolute() else quote(path.as_posix())}


def _message(text: str) -> dict[str, str]:
    return {"text": text}

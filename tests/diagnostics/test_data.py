"""Diagnostics as data: JSON form, suggestions and the table of rules."""

from __future__ import annotations

import json
import re

from burnish.commands.diagnostic_rows import diagnostic_row
from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import Diagnostic, Label, Rule
from burnish.compiler.diagnostics.fixes import Edit, Fix
from burnish.compiler.diagnostics.nearest import nearest, suggestion
from burnish.compiler.diagnostics.source import Source, Span
from burnish.compiler.documents.writing import to_text

RULES = {name: rule for name, rule in vars(rules).items() if isinstance(rule, Rule)}


def test_the_json_form_is_complete() -> None:
    source = Source("a.burnish", "a = 1\nb = tnt")
    span = Span(source, 10, 13)
    rule = Rule("B9999", "warning", "", "Help.")
    fixes = (Fix((Edit(span, "b"), Edit(Span(source, 0, 0), "b = 2\n")), "maybe-incorrect"),)
    diagnostic = Diagnostic(rule, "wrong", span, "here", (Label(span, "there"),), "mend it", fixes)
    place = {
        "file": "a.burnish",
        "start": {"line": 2, "column": 5, "offset": 10},
        "end": {"line": 2, "column": 8, "offset": 13},
    }
    begin = {"line": 1, "column": 1, "offset": 0}
    assert json.loads(to_text(diagnostic_row(diagnostic))) == {
        "code": "B9999",
        "severity": "warning",
        "message": "wrong",
        "span": place,
        "caption": "here",
        "labels": [{"span": place, "text": "there"}],
        "hint": "mend it",
        "fixes": [
            {
                "applicability": "maybe-incorrect",
                "edits": [
                    {"span": place, "text": "b"},
                    {
                        "span": {"file": "a.burnish", "start": begin, "end": begin},
                        "text": "b = 2\n",
                    },
                ],
            }
        ],
        "help": "Help.",
    }


def test_a_finding_without_place_has_no_span() -> None:
    assert diagnostic_row(Diagnostic(rules.MISSING_FILE, "gone")).span is None


def test_the_nearest_name_is_suggested() -> None:
    known = ["tint", "albedo", "normal", "Power"]
    assert nearest("tnt", known) == "tint"
    assert nearest("power", known) == "Power"
    assert nearest("xyzzy", known) is None
    assert suggestion("nomal", known) == "did you mean `normal`?"
    assert suggestion("xyzzy", known) == ""


def test_codes_are_unique_and_well_formed() -> None:
    codes = [rule.code for rule in RULES.values()]
    assert len(set(codes)) == len(codes)
    assert all(re.fullmatch(r"B0\d{3}", code) for code in codes)


def test_every_rule_teaches() -> None:
    for name, rule in RULES.items():
        assert rule.help.endswith("."), name
        assert rule.message, name
        assert rule.message[0].islower() or rule.message[0] in "`{B", name

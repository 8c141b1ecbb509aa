"""An edit that a message offers works: the message is gone once it is made."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from burnish.compiler.diagnostics.diagnostic import Diagnostic

from .kit import FOLDER, Case, cases, told

_OFFERS = re.compile(
    r"(?:write|read \d lanes:|read one lane, as in|say what the other lanes are:|did you mean)"
    r" `([^`…]+)`(?! (?:and|or) `)"
)
"""Hints of one text that stands in place of another."""
_DECLARES = re.compile(r" [:=] |^import ")
"""What is written for a whole line stands in place of more than the span."""
_OPERANDS = ("B0302", "B0305")
"""Rules about several operands, one of which is edited."""
_CONVERTED = re.compile(r"\w+\((.*)\)")
_SHORTENED = re.compile(r"\.[xyzw]+$")


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def edited(case: Case, found: Diagnostic) -> str | None:
    """The program with the edit that a message offers; None if it offers none in place."""
    offer = _OFFERS.match(found.hint)
    if offer is None or found.span is None or found.span.source.name != "m.burnish":
        return None
    if _DECLARES.search(offer[1]):
        return None
    text, start, end = case.program, found.span.start, found.span.end
    old, new = text[start:end], offer[1]
    if found.rule.code in _OPERANDS and found.hint.startswith("write"):
        new = _with_operand(old, new)
    return text[:start] + new + text[end:]


def _with_operand(written: str, edit: str) -> str:
    """An expression with one operand edited."""
    inside = _CONVERTED.fullmatch(edit)
    operand = inside[1] if inside and inside[1] in written else _SHORTENED.sub("", edit)
    before, _, behind = written.rpartition(operand)
    return before + edit + behind


def offers() -> Iterator[tuple[Case, Diagnostic, str]]:
    """All edits that are offered for the programs of this folder."""
    for path in sorted(FOLDER.glob("*.txt")):
        for case in cases(path):
            for found in told(case):
                if (text := edited(case, found)) is not None:
                    yield case, found, text


def test_what_is_offered_works() -> None:
    tried = 0
    for case, found, text in offers():
        assert found.span is not None
        tried += 1
        left = told(Case("edited", text, ""))
        same = [
            each
            for each in left
            if each.rule is found.rule and each.span and each.span.start == found.span.start
        ]
        assert same == [], (case.title, found.hint)
    assert tried > 100

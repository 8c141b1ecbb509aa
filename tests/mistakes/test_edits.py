"""An edit that a message offers works: the message is gone once it is made."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from contextlib import chdir

import pytest

from burnish.compiler.diagnostics.diagnostic import Diagnostic
from burnish.compiler.diagnostics.fixes import Edit, Fix

from .kit import FOLDER, Case, cases, told

_OFFERS = re.compile(r"(?:write|read \d lanes:|read one lane, as in|did you mean) `[^`…]+`")
"""Sentences that offer one text in place of another."""

Found = list[tuple[Case, tuple[Diagnostic, ...]]]


pytestmark = pytest.mark.xdist_group("edits")  # One process compiles the programs.


@pytest.fixture(scope="module", autouse=True)
def found(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Found]:
    """All that is said of the programs of this folder."""
    with chdir(tmp_path_factory.mktemp("programs")):
        paths = sorted(FOLDER.glob("*.txt"))
        yield [(case, told(case)) for path in paths for case in cases(path)]


def edited(text: str, edits: tuple[Edit, ...]) -> str:
    """A text with edits made, the last one first, so that the others' places stay."""
    for edit in sorted(edits, key=lambda edit: edit.span.start, reverse=True):
        text = text[: edit.span.start] + edit.text + text[edit.span.end :]
    return text


def fixes(found: Found) -> Iterator[tuple[Case, tuple[Diagnostic, ...], Diagnostic, Fix]]:
    """Each fix that is offered for a program, with everything else that is said of it."""
    for case, diagnostics in found:
        for diagnostic in diagnostics:
            for fix in diagnostic.fixes:
                yield case, diagnostics, diagnostic, fix


def _of_syntax(found: Iterable[Diagnostic]) -> list[Diagnostic]:
    return [diagnostic for diagnostic in found if diagnostic.rule.code.startswith("B01")]


def test_what_is_offered_works(found: Found) -> None:
    tried = 0
    for case, _, diagnostic, fix in fixes(found):
        assert diagnostic.span is not None
        assert all(edit.span.source is diagnostic.span.source for edit in fix.edits)
        tried += 1
        text = edited(case.program, fix.edits)
        same = [
            left
            for left in told(Case("edited", text, ""))
            if left.rule is diagnostic.rule and left.message == diagnostic.message
            and left.span and left.span.start == diagnostic.span.start
        ]  # fmt: skip
        assert same == [], (case.title, diagnostic.hint, text)
    assert tried > 100


def test_what_a_tool_may_do_unasked_brings_no_syntax_errors(found: Found) -> None:
    """Errors of other kinds may come to light, as nothing is said about what cannot be read."""
    tried = 0
    for case, diagnostics, diagnostic, fix in fixes(found):
        if fix.applicability == "machine-applicable":
            tried += 1
            left = told(Case("edited", edited(case.program, fix.edits), ""))
            others = [each for each in diagnostics if each is not diagnostic]
            assert len(_of_syntax(left)) <= len(_of_syntax(others)), (case.title, diagnostic.hint)
    assert tried > 20


def test_what_a_sentence_offers_is_an_edit(found: Found) -> None:
    """A reader may not be told to write something that a tool is not told."""
    offered = [
        (case.title, diagnostic.hint)
        for case, diagnostics in found
        for diagnostic in diagnostics
        if _OFFERS.match(diagnostic.hint) and diagnostic.span is not None and not diagnostic.fixes
    ]
    assert offered == []

"""The grammar, its tables and the words the rest of the parser relies on agree."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest
from lark import Lark, logger

from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.syntax import lalr_tables, parser
from burnish.compiler.syntax.builder import Builder
from burnish.compiler.syntax.lalr_tables import load_tables
from burnish.compiler.syntax.tokens import RESERVED, Docs

GRAMMAR = Path(parser.__file__).with_name("burnish.lark").read_text(encoding="utf-8")


def test_the_grammar_has_no_conflicts(caplog: pytest.LogCaptureFixture) -> None:
    logger.setLevel(logging.DEBUG)
    try:
        with caplog.at_level(logging.DEBUG, logger=logger.name):
            Lark(GRAMMAR, parser="lalr", lexer="basic", start="file", debug=True)
    finally:
        logger.setLevel(logging.CRITICAL)
    assert [line for line in caplog.messages if "onflict" in line] == []


def test_every_production_has_its_builder_method() -> None:
    builder = Builder(Docs(), Report())
    made = {p.method for p in load_tables().productions if p.method and not p.collapses}
    assert {name for name in made if builder.method(name) is None} == set()


def test_reserved_words_are_words_of_the_grammar() -> None:
    assert load_tables().literals >= RESERVED
    assert rules.RESERVED_WORD.help == f"Reserved are only: {', '.join(sorted(RESERVED))}."


def test_lark_is_not_needed_once_the_tables_are_cached(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))
    first = load_tables.__wrapped__()
    monkeypatch.setattr(lalr_tables, "_compute", lambda _: pytest.fail("computed again"))
    assert load_tables.__wrapped__() == first

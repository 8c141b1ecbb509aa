"""The grammar, its tables and the words the rest of the parser relies on agree."""

from __future__ import annotations

import logging
import re
from pathlib import Path

import pytest
from lark import Lark, logger

from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.syntax import parser
from burnish.compiler.syntax.ast import KINDS, MEMBERS, MemberKind
from burnish.compiler.syntax.builder import Builder, maker
from burnish.compiler.syntax.lalr_tables import load_tables
from burnish.compiler.syntax.machine import Machine
from burnish.compiler.syntax.tokens import RESERVED, Docs, Token

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
    made = {p.method for p in load_tables().productions if p.method and not p.collapses}
    assert {name for name in made if maker(name) is None} == set()


def test_the_table_of_member_kinds_is_that_of_the_grammar() -> None:
    (line,) = re.findall(r"^_member: (.*)$", GRAMMAR, re.MULTILINE)
    productions = load_tables().productions
    read = {p.method for p in productions if p.origin in line.split(" | ")}
    assert {name for kind in KINDS for name in kind.productions} == read


@pytest.mark.parametrize("kind", MEMBERS.values(), ids=MEMBERS)
def test_members_open_as_the_table_says(kind: MemberKind) -> None:
    machine = Machine(load_tables(), Builder(Docs(), Report()), Source("opening", ""))
    for symbol in ("pass", "NAME", "{", kind.word, *kind.opening):
        assert machine.feed(Token(symbol, symbol, 0, 0))


def test_reserved_words_are_words_of_the_grammar() -> None:
    assert load_tables().literals >= RESERVED
    assert (
        rules.RESERVED_WORD.help == f"Only these words are reserved: {', '.join(sorted(RESERVED))}."
    )

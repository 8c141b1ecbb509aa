"""The programs that ``burnish explain`` and docs/diagnostics.md show for each code."""

from __future__ import annotations

import pytest

import burnish
from burnish.commands.explain.command import told
from burnish.commands.explain.programs import ShownProgram, every_shown
from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import Rule
from burnish.compiler.diagnostics.render import render_all
from burnish.targets.selection import DEFAULT

RULES = [rule for rule in vars(rules).values() if isinstance(rule, Rule)]
ENTRIES = every_shown()
PROGRAMS = [entry for entry in ENTRIES if not entry.reason]

WITHOUT = {
    "B0001", "B0002", "B0003", "B0004", "B0005", "B0008", "B0009", "B0010", "B0011", "B0013",
    "B0014", "B0015", "B0016", "B0017", "B0018", "B0019", "B0020", "B0106", "B0111", "B0217",
    "B0389", "B0414", "B0450", "B0451", "B0452", "B0480", "B0504", "B0562", "B0703", "B0704",
    "B0705", "B0706", "B0708", "B0710", "B0711", "B0901", "B0902", "B0903", "B0904", "B0905",
    "B0906", "B0907", "B0908", "B0909", "B0910", "B0911", "B0912", "B0913",
}  # fmt: skip
"""The codes that no program shows. Take out what has got one; a new code needs programs."""


def test_every_code_is_shown_or_says_why_not() -> None:
    assert [entry.code for entry in ENTRIES] == [rule.code for rule in RULES]
    assert {entry.code for entry in ENTRIES if entry.reason} == WITHOUT


@pytest.mark.parametrize("entry", PROGRAMS, ids=lambda entry: entry.code)
def test_the_wrong_program_is_told_this_and_nothing_else(entry: ShownProgram) -> None:
    found = told(entry.wrong, entry.targets)
    assert [one.rule.code for one in found] == [entry.code], render_all(found)


@pytest.mark.parametrize("entry", PROGRAMS, ids=lambda entry: entry.code)
def test_the_right_program_compiles_and_is_told_nothing(entry: ShownProgram) -> None:
    found = burnish.check(entry.right) or told(entry.right, entry.targets or DEFAULT)
    assert not found, render_all(found)


@pytest.mark.parametrize("entry", PROGRAMS, ids=lambda entry: entry.code)
def test_programs_can_be_read_at_a_glance(entry: ShownProgram) -> None:
    for program in (entry.wrong, entry.right):
        assert len(program.splitlines()) <= 16
        assert all(len(line) <= 100 for line in program.splitlines())
    assert entry.wrong != entry.right

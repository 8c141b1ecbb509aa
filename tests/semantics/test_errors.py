"""The errors of wrong programs: every `broken/x.burnish` has its `broken/x.txt`.

A file that is named after a rule shows what the rule is for and nothing else. Remarks such as
``// B0203`` mark the lines about which something is said, which is said once.
After a deliberate change, run with ``BURNISH_UPDATE_GOLDEN=1`` and read the difference.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import pytest
from _pytest.mark import ParameterSet

import burnish
from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import Diagnostic, Rule
from burnish.compiler.diagnostics.render import render_all

FOLDER = Path(__file__).parent / "broken"
BROKEN = sorted(path.stem for path in FOLDER.glob("*.burnish"))
RULES = {name.lower(): rule for name, rule in vars(rules).items() if isinstance(rule, Rule)}
SECTIONS = ("B02", "B03", "B04", "B05", "B06", "B07", "B08")
NOT_OF_A_SOURCE = {
    "no_clip_position": "the library's `Surface` has one",
    "unsupported": "about an option of the command line, in tests/cli",
    "other_pass": "about an option of the command line, in tests/semantics/test_ties.py",
    "no_text_of_module": "about an option of the command line, in tests/cli",
    "not_optimised": "about an option of the command line, in tests/cli",
    "no_line_directives": "about an option of the command line, in tests/cli",
    "not_specialised": "about an option of the command line, in tests/cli",
    "too_large_to_draw": "what `burnish graph` says, in tests/cli",
    "rejected": "what a downstream compiler says, in tests/toolchain",
    "doubted": "what a downstream compiler says, in tests/toolchain",
    "tool_broke": "about a downstream compiler, in tests/toolchain",
    "tool_missing": "about a downstream compiler, in tests/toolchain",
    "binding_scheme": "about an option of the command line, in tests/cli",
}
ALSO = {"light_lacks_slot": {"B0201"}, "level_differs": {"B0201"}}
"""Codes that a rule's file shows for comparison."""

UNMARKED = ("no_material", "too_many", "asked_of_devices")
"""The sources whose findings belong to no line."""

_PASS = re.compile(r"^pass (\w+)", re.MULTILINE)
_MARK = re.compile(r"// (B\d{4})$")


def grouped(names: Iterable[str]) -> list[ParameterSet]:
    """A test for each source; one process runs all that ask for the same one."""
    return [pytest.param(name, marks=pytest.mark.xdist_group(f"error {name}")) for name in names]


@pytest.fixture(autouse=True)
def _among_the_sources(monkeypatch: pytest.MonkeyPatch) -> None:
    """Messages name files as they were given: without folders."""
    monkeypatch.chdir(FOLDER)


@cache
def told(name: str) -> tuple[Diagnostic, ...]:
    """All that is said of a source, which its own last pass draws; three tests ask for it."""
    path = Path(f"{name}.burnish")
    passes: list[str] = _PASS.findall(path.read_text(encoding="utf-8"))
    found = burnish.check(path, pass_=passes[-1] if passes else None)
    if found:
        return found
    try:
        return burnish.compile(path, ("wgsl",)).diagnostics
    except burnish.CompileError as error:
        return error.diagnostics


def marked(name: str) -> list[tuple[int, str]]:
    """The lines of which something is to be said, with its code."""
    lines = Path(f"{name}.burnish").read_text(encoding="utf-8").splitlines()
    found = ((number, _MARK.search(line)) for number, line in enumerate(lines, 1))
    return [(number, mark[1]) for number, mark in found if mark]


def place(found: Diagnostic) -> tuple[int, str]:
    """The line of a finding, with its code."""
    assert found.span is not None
    line, _ = found.span.source.position(found.span.start)
    return line, found.rule.code


@pytest.mark.parametrize("name", grouped(BROKEN))
def test_the_messages_are_the_expected_ones(name: str) -> None:
    rendered = render_all(told(name)) + "\n"
    expected = Path(f"{name}.txt")
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        expected.write_text(rendered, encoding="utf-8")
    assert rendered == expected.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", grouped(name for name in BROKEN if name not in UNMARKED))
def test_each_mistake_is_told_once_and_nothing_else(name: str) -> None:
    assert sorted(map(place, told(name))) == marked(name)


FRAMES = [name for name in BROKEN if name in RULES and RULES[name].code.startswith("B08")]


@pytest.mark.parametrize("name", FRAMES)
def test_checking_says_what_compiling_says(name: str) -> None:
    try:
        compiled = burnish.compile(Path(f"{name}.burnish"), ("wgsl",)).diagnostics
    except burnish.CompileError as error:
        compiled = error.diagnostics
    checked = burnish.check(Path(f"{name}.burnish"))
    of_errors = [found for found in checked if found.severity == "error"]
    assert render_all(of_errors or checked) == render_all(compiled)


@pytest.mark.parametrize("name", grouped(name for name in BROKEN if not name.startswith("many_")))
def test_a_rule_is_shown_alone(name: str) -> None:
    codes = {found.rule.code for found in told(name)}
    assert codes == {RULES[name].code} | ALSO.get(name, set())


def test_every_rule_is_shown() -> None:
    expected = {name for name, rule in RULES.items() if rule.code.startswith(SECTIONS)}
    assert expected - NOT_OF_A_SOURCE.keys() == {n for n in BROKEN if not n.startswith("many_")}
    assert expected.issuperset(NOT_OF_A_SOURCE)

"""Every kind of diagnostic can happen, and can be shown."""

from __future__ import annotations

import re
from pathlib import Path
from string import Formatter

import pytest

from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import Diagnostic, Rule
from burnish.compiler.diagnostics.render import render
from burnish.compiler.diagnostics.source import Source, Span

from .kit import ROOT, files

RULES = {name: rule for name, rule in vars(rules).items() if isinstance(rule, Rule)}


def test_every_rule_is_reported_somewhere() -> None:
    code = "\n".join(
        path.read_text("utf-8")
        for folder in ("api", "commands", "compiler", "engines", "targets")
        for path in files(ROOT / folder)
        if path.suffix == ".py"
    )
    reported = set(re.findall(r"\brules\.([A-Z_]+)\b", code))
    assert RULES.keys() - reported == set()
    assert reported - RULES.keys() == set()


def test_rules_stand_in_the_order_of_their_codes() -> None:
    codes = [rule.code for rule in RULES.values()]
    assert codes == sorted(set(codes))


def test_each_section_has_a_file_of_its_own() -> None:
    """No row stands in the file of another section, and none hides one of the same name."""
    found: dict[str, str] = {}
    for section in sorted(Path(rules.__file__).parent.glob("b0*.py")):
        names = re.findall(r"^([A-Z_]+) = ", section.read_text("utf-8"), re.MULTILINE)
        assert {RULES[name].code[:3] for name in names} == {section.name[:3].upper()}
        assert not found.keys() & names
        found |= dict.fromkeys(names, section.name)
    assert found.keys() == RULES.keys()


@pytest.mark.parametrize("rule", RULES.values(), ids=lambda rule: rule.code)
def test_rule_renders(rule: Rule) -> None:
    fields = {name for _, name, _, _ in Formatter().parse(rule.message) if name}
    message = rule.message.format(**dict.fromkeys(fields, "x"))
    span = Span(Source("a.burnish", "color = vec3(1)\n"), 8, 12)
    text = render(Diagnostic(rule, message, span, "here", hint="a hint"))
    assert text.startswith(f"{rule.severity}[{rule.code}]")
    assert "color = vec3(1)" in text
    assert "a hint" in text
    assert message in text

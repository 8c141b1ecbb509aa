"""The forms that messages show are Burnish themselves."""

from __future__ import annotations

import re

import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.syntax.ast import MEMBERS
from burnish.compiler.syntax.forms import DECLARATIONS
from burnish.compiler.syntax.parser import parse

_CODE = re.compile(r"`([^`]+)`")


def _forms(advice: str) -> list[str]:
    return [code.replace("…", "") for code in _CODE.findall(advice) if not code.startswith("…")]


@pytest.mark.parametrize("word", DECLARATIONS)
def test_forms_of_declarations_can_be_read(word: str) -> None:
    for form in _forms(DECLARATIONS[word]):
        report = Report()
        tree = parse(Source("form", form.replace(", }", " }")), report)
        assert not report.diagnostics, form
        assert len(tree.declarations) == 1


@pytest.mark.parametrize("word", MEMBERS)
def test_forms_of_members_can_be_read(word: str) -> None:
    for form in _forms(MEMBERS[word].form):
        report = Report()
        parse(Source("form", f"pass P {{ {form} }}"), report)
        assert not report.diagnostics, form


@pytest.mark.parametrize(
    "equation",
    [
        "total = sum i in 0..n up to m : i",
        "total = min i in 0..n from m : i",
        "total = iterate x from 1 up to 8 while go : 2 * x",
    ],
)
def test_a_name_may_end_the_head_of_a_loop_of_a_file(equation: str) -> None:
    """The name does not begin the next constant, unless it has a line of its own."""
    around = "m = 4\nn = 3\ngo = true\nto = 2\nlast = to\nother : int = 3\n"
    assert burnish.check(f"{around}{equation}\nmaterial M {{}}") == ()

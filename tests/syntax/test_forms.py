"""The forms that messages show are Burnish themselves."""

from __future__ import annotations

import re

import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.syntax.forms import DECLARATIONS, MEMBERS
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
    for form in _forms(MEMBERS[word]):
        report = Report()
        parse(Source("form", f"pass P {{ {form} }}"), report)
        assert not report.diagnostics, form

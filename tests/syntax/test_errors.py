"""The errors of broken texts: each ``broken/x.burnish`` is beside its ``broken/x.txt``.

After a deliberate change, run with ``BURNISH_UPDATE_GOLDEN=1`` and read the difference.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.syntax.parser import parse

from .dump import messages

BROKEN = sorted((Path(__file__).parent / "broken").glob("*.burnish"))


@pytest.mark.parametrize("path", BROKEN, ids=lambda path: path.stem)
def test_the_messages_are_the_expected_ones(path: Path) -> None:
    report = Report()
    parse(Source(path.name, path.read_text(encoding="utf-8")), report)
    rendered = render_all(report.diagnostics) + "\n"
    expected = path.with_suffix(".txt")
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        expected.write_text(rendered, encoding="utf-8")
    assert rendered == expected.read_text(encoding="utf-8")


def test_a_side_of_a_conflict_without_end_is_told() -> None:
    """Nothing of it is read, so a line that is left over must not hide the rest of a file."""
    assert messages("a = 1\n=======\nb = 2\n") == ["a merge conflict is left in this file"]

"""Links between the pages lead somewhere, and files that they name are there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from ..structure.kit import files
from .kit import PAGES, ROOT

LINK = re.compile(r"\]\((?!https?:)([^)#\s]*)(?:#([^)\s]*))?\)")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`\n]+`")
"""No link begins in it: it may be the notation ``swizzle[lanes](x)``."""


def anchors(page: Path) -> set[str]:
    """The anchors of a page's headings, as hosting sites make them."""
    headings = HEADING.findall(FENCED.sub("", page.read_text(encoding="utf-8")))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", [*PAGES, ROOT / "CHANGELOG.md"], ids=lambda page: page.name)
def test_links(page: Path) -> None:
    text = CODE.sub("", FENCED.sub("", page.read_text(encoding="utf-8")))
    for path, anchor in LINK.findall(text):
        target = page.parent / path if path else page
        assert target.exists(), path
        assert not anchor or anchor in anchors(target), anchor


NAMED_FILE = re.compile(r"`([\w/.]+\.(?:py|js|mjs|toml|j2|lark))`")
"""A file of this tree that a page names: its last parts may do."""
NOT_IN_THE_TREE = "generated/"
"""The folder of files that are made when the package is built."""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_files_that_are_named_are_there(page: Path) -> None:
    there = [f"/{path.relative_to(ROOT).as_posix()}" for path in files(ROOT)]
    named = dict.fromkeys(NAMED_FILE.findall(page.read_text(encoding="utf-8")))
    missing = [
        name
        for name in named
        if not name.startswith(NOT_IN_THE_TREE)
        and not any(path.endswith(f"/{name}") for path in there)
    ]
    assert not missing

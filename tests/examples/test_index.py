"""The index of the examples names every file, and only files that there are."""

from __future__ import annotations

import re

from .kit import FOLDER


def test_index() -> None:
    text = (FOLDER / "README.md").read_text("utf-8")
    linked = set(re.findall(r"\]\(([\w/]+\.burnish)\)", text))
    present = {path.relative_to(FOLDER).as_posix() for path in FOLDER.rglob("*.burnish")}
    assert linked == present

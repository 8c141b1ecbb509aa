"""The types of the page's modules, and the length of their lines."""

from __future__ import annotations

from pathlib import Path

from ..web_host.kit import TARGETS, checked, copied, too_long

FOLDER = TARGETS / "web_view"


def test_the_types_are_right(tmp_path: Path) -> None:
    copied(tmp_path)
    seen, wrong = checked(tmp_path / "web_view")
    assert not wrong
    assert {str(tmp_path / "web_view" / path.name) for path in FOLDER.glob("*.js")} <= seen


def test_lines_have_the_length_of_the_tree() -> None:
    assert not too_long(FOLDER)

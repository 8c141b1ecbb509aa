"""Texts in the tree that a person should see change."""

from __future__ import annotations

import os
from pathlib import Path


def assert_golden(text: str, path: Path) -> None:
    """The text is what the file holds; ``BURNISH_UPDATE_GOLDEN=1`` writes the file anew."""
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    assert text == path.read_text(encoding="utf-8")

"""Golden files: texts in the tree that tests compare with, so that people see each change."""

from __future__ import annotations

import os
from pathlib import Path


def assert_golden(text: str, path: Path) -> None:
    """Fail unless the file holds this text; ``BURNISH_UPDATE_GOLDEN=1`` writes the file instead."""
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    assert text == path.read_text(encoding="utf-8")

"""Judges of pictures in other test suites: one file for each language, which people copy.

``burnish judge --comparer`` prints a file. Each one compares a picture in memory with the bounds of
a golden folder, and needs nothing but its language's standard library. All have the same names and
the same structure, and say the same of the same picture: ``tests/comparers`` holds them together.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

_FILES = {
    "c++": "burnish_judge.hpp",
    "python": "burnish_judge.py",
    "rust": "burnish_judge.rs",
    "typescript": "burnish_judge.ts",
}

COMPARERS: Mapping[str, Path] = {
    language: Path(__file__).with_name(name) for language, name in _FILES.items()
}
"""The path of each comparer, by its language."""


def comparer(language: str) -> str:
    """The text of a comparer. Raises ``KeyError`` for a language that has none."""
    return COMPARERS[language].read_text(encoding="utf-8")

"""The words of a language that cannot be names in a text, read from its ``reserved.txt``."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

from ...support.frozen import frozen

_NEVER = "(?!)"
"""A pattern that matches nothing."""


@frozen(eq=False)
class Reserved:
    """Words, and a pattern of words, that cannot be names."""

    words: frozenset[str]
    pattern: re.Pattern[str]
    """Anchored at the start of a word."""

    def refuses(self, word: str) -> bool:
        """True if ``word`` cannot be a name."""
        return word in self.words or self.pattern.match(word) is not None


@cache
def read_reserved(path: Path, *patterns: str) -> Reserved:
    """Words from a text file (``#`` starts a comment), and regular expressions."""
    lines = path.read_text(encoding="utf-8").splitlines()
    words = frozenset(word for line in lines for word in line.partition("#")[0].split())
    return Reserved(words, re.compile("|".join(patterns) or _NEVER))

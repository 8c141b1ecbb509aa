"""Words that a language keeps for itself."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

from ...frozen import frozen


@frozen
class Reserved:
    """Words, and patterns of words, that cannot be names."""

    words: frozenset[str]
    patterns: tuple[re.Pattern[str], ...] = ()
    """Anchored at the start of a word."""

    def refuses(self, word: str) -> bool:
        """Whether ``word`` cannot be a name."""
        return word in self.words or any(pattern.match(word) for pattern in self.patterns)


@cache
def read_reserved(path: Path, *patterns: str) -> Reserved:
    """Words from a text file (``#`` starts a comment), and regular expressions."""
    lines = path.read_text(encoding="utf-8").splitlines()
    words = frozenset(word for line in lines for word in line.partition("#")[0].split())
    return Reserved(words, tuple(map(re.compile, patterns)))

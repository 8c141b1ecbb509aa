"""One edit of a text: what every mutant is made by, whatever it is a mutant of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import AnyStr


@dataclass(frozen=True, slots=True)
class Edit:
    """A part of a text, or of the bytes of a file, and what replaces it."""

    start: int
    """The offset of the first character, or byte, that is replaced."""
    end: int
    replacement: str

    def applied(self, text: AnyStr) -> AnyStr:
        """The text with the edit."""
        new = self.replacement if isinstance(text, str) else self.replacement.encode()
        return text[: self.start] + new + text[self.end :]

    def line(self, text: str | bytes) -> int:
        """The number of the line, from 1."""
        before = text[: self.start]
        return 1 + (before.count("\n") if isinstance(before, str) else before.count(b"\n"))

    def replaced(self, text: str | bytes) -> str:
        """The words that it replaces."""
        part = text[self.start : self.end]
        return part if isinstance(part, str) else part.decode()

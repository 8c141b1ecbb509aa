"""Source texts and spans within them."""

from __future__ import annotations

from bisect import bisect_right

from ...support.frozen import fresh, frozen, record


@record
class Compared:
    """A count of the comparisons that looked for the nearest names of unknown ones."""

    letters: int = 0
    """Pairs of letters, of which one is in the unknown name."""


@record
class Source:
    """One file (or string) of Burnish text; compared by identity.

    ``name`` is that in messages: a path as the user wrote it, or ``<text>``.
    """

    name: str
    text: str
    portable: str = ""
    """The name in outputs, whatever folder the compiler runs in.

    It is the path from the folder of the file that is compiled. Empty where that is ``name``.
    """
    compared: Compared = fresh(factory=Compared)
    """``nearest.py`` keeps count; all texts of a compile have the same one."""
    _line_starts: list[int] | None = None

    @property
    def name_in_outputs(self) -> str:
        """The name in source maps and line directives."""
        return self.portable or self.name

    @property
    def line_starts(self) -> list[int]:
        """Offset of the first character of every line."""
        if self._line_starts is None:
            starts = [0]
            starts += [i + 1 for i, character in enumerate(self.text) if character == "\n"]
            self._line_starts = starts
        return self._line_starts

    def position(self, offset: int) -> tuple[int, int]:
        """1-based line and column of ``offset``."""
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def line(self, number: int) -> str:
        """The text of 1-based line ``number``, without its line end."""
        starts = self.line_starts
        end = starts[number] - 1 if number < len(starts) else len(self.text)
        return self.text[starts[number - 1] : end].rstrip("\r")


@frozen
class Span:
    """Characters ``start`` to ``end`` (exclusive) of ``source``."""

    source: Source
    start: int
    end: int

    @property
    def text(self) -> str:
        """The text of the span."""
        return self.source.text[self.start : self.end]

    def is_before(self, other: Span) -> bool:
        """True if this begins before ``other``, in the same text."""
        return self.source is other.source and self.start < other.start

    def to(self, other: Span) -> Span:
        """The span from the start of this one to the end of ``other``."""
        return Span(self.source, self.start, other.end)

    def __str__(self) -> str:
        line, column = self.source.position(self.start)
        return f"{self.source.name}:{line}:{column}"

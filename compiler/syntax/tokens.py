"""The results of the lexer: tokens, and the doc comments between them."""

# Annotations are evaluated in this module: a named tuple compiles those that are texts, and to load
# Python's compiler for them would take a hundredth of a short compile.

from bisect import bisect_left
from operator import attrgetter
from typing import NamedTuple

RESERVED = frozenset(("and", "else", "false", "if", "mod", "not", "or", "then", "true"))
"""Words that are never names. The grammar's other words are names wherever it does not use them."""


class Token(NamedTuple):
    """One word, number, mark or literal.

    ``kind`` is the grammar's symbol: ``NAME``, ``NUMBER``, ``COLOR``, ``STRING``, or for reserved
    words and punctuation the text itself.
    """

    kind: str
    text: str
    start: int
    end: int


class Docs:
    """Doc comments, which the builder asks for by the place of the thing that they describe.

    A comment is a ``DOC`` token whose text is the line without ``///``.
    """

    def __init__(self) -> None:
        self.file: list[str] = []
        self._before: dict[int, list[Token]] = {}
        self._after: dict[int, list[Token]] = {}
        self._claimed: set[Token] = set()

    def add_before(self, start: int, line: Token) -> None:
        """A line of doc above whatever starts at ``start``."""
        self._before.setdefault(start, []).append(line)

    def add_after(self, end: int, line: Token) -> None:
        """A line of doc behind whatever ends at ``end``, on the same line of text."""
        self._after.setdefault(end, []).append(line)

    def of(self, start: int, end: int) -> str:
        """The doc of the member or declaration from ``start`` to ``end``."""
        lines = self._before.get(start, []) + self._after.get(end, [])
        self._claimed.update(lines)
        return "\n".join(line.text for line in lines)

    def above(self, start: int) -> int:
        """The place of the first comment above whatever starts at ``start``, or else ``start``."""
        return self._before[start][0].start if start in self._before else start

    def unclaimed(self) -> list[Token]:
        """The first line of each comment that describes nothing, because nobody asked for it."""
        groups = (*self._before.values(), *self._after.values())
        return [lines[0] for lines in groups if lines[0] not in self._claimed]


class Lexed(NamedTuple):
    """A whole text, lexed."""

    tokens: list[Token]
    docs: Docs
    passages: list[range]
    """Parts of the text over several lines in which nothing is read, such as long comments."""

    def is_read(self, place: int) -> bool:
        """True if a place lies in none of these parts."""
        before = bisect_left(self.passages, place, key=attrgetter("start"))
        return before == 0 or self.passages[before - 1].stop <= place

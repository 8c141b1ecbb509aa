"""Turns the text of a file into tokens, and reports text that cannot be one.

The parser calls ``lex`` once for each text that it reads: a file, or a section of one.
"""

from __future__ import annotations

import re
from functools import cache, partial

from ..diagnostics.diagnostic import Report
from ..diagnostics.source import Source, Span
from .lalr_tables import load_tables
from .malformed import MALFORMED, PERCENT, mend
from .tokens import RESERVED, Docs, Lexed, Token

_ORDER = ("BLANK", "NAME", "PUNCTUATION", "NUMBER", "COLOR", "STRING", "DOC", "FILE_DOC", "COMMENT")
"""The grammar's patterns in the order of trial: a doc comment would also be a comment."""

_NOT_BEFORE = {"NAME": r"(?!\w)", "NUMBER": rf"(?!\w|\.(?!\.)|{PERCENT})", "COLOR": r"(?!\w)"}
"""The pattern that must not follow a token; otherwise ``1.0f`` would be ``1.0`` and a name."""

_SEPARATORS = ";,"

_PUNCTUATION = r"[()\[\]{},;]"
"""Marks with which nothing else begins; they are frequent, and so tried early."""

_token = partial(tuple.__new__, Token)
"""Makes a token of its four parts; Python's own way through ``Token()`` takes twice as long."""


@cache
def token_pattern() -> re.Pattern[str]:
    """One expression for any token: proper ones first, then marks, then any malformed text.

    Blanks belong to the token before them, so that half as many matches are needed.
    """
    tables = load_tables()
    marks = sorted((m for m in tables.literals if not m.isidentifier()), key=len, reverse=True)
    patterns = {**tables.patterns, "PUNCTUATION": _PUNCTUATION}
    kinds = [(kind, patterns[kind] + _NOT_BEFORE.get(kind, "")) for kind in _ORDER]
    kinds += MALFORMED
    kinds.append(("MARK", "|".join(map(re.escape, marks))))
    kinds.append(("OTHER", r"[^\w\s!-~]+|[\s\S]"))
    either = "|".join(f"(?P<{kind}>{pattern})" for kind, pattern in kinds)
    return re.compile(f"(?:{either})(?:{tables.patterns['BLANK']})?")


def lex(source: Source, report: Report, begin: int = 0, until: int | None = None) -> Lexed:
    """All tokens from ``begin`` to ``until``, by default those of all of ``source``.

    What cannot be read is reported, and corrected or left out.
    """
    tokens: list[Token] = []
    passages: list[range] = []
    docs = _DocCollector(source.text, tokens)
    until = len(source.text) if until is None else until
    for match in token_pattern().finditer(source.text, begin, until):
        kind = match.lastgroup or ""
        if kind == "BLANK":
            continue
        word = match[kind]
        start, end = match.span(kind)
        if kind == "NAME":
            tokens.append(_token((word if word in RESERVED else kind, word, start, end)))
        elif kind in ("PUNCTUATION", "MARK"):
            tokens.append(_token((word, word, start, end)))
        elif kind in ("NUMBER", "COLOR", "STRING"):
            tokens.append(_token((kind, word, start, end)))
        elif kind in ("DOC", "FILE_DOC"):
            docs.add(kind, word, start)
        else:
            if "\n" in word:
                passages.append(range(start, end))
            mended = (
                None if kind == "COMMENT" else mend(kind, word, Span(source, start, end), report)
            )
            if mended:
                tokens.append(mended)
    return Lexed(tokens, docs.settled(), passages)


class _DocCollector:
    """Decides for each doc comment if it describes text that ends on its line, or what follows."""

    def __init__(self, text: str, tokens: list[Token]) -> None:
        self._found = Docs()
        self._text = text
        self._tokens = tokens
        """The tokens before the place that the lexer has reached."""
        self._searched = 0
        """The number of tokens that ``_end_before`` has looked at."""
        self._end = -1
        """The end of the last of these that is no separator."""
        self._waiting: list[tuple[int, Token]] = []
        """Comments, each with the number of tokens before it: it describes the next declaration."""

    def settled(self) -> Docs:
        """All doc comments, once the lexer has reached the end."""
        for before, line in self._waiting:
            after = self._tokens[before].start if before < len(self._tokens) else len(self._text)
            self._found.add_before(after, line)
        return self._found

    def add(self, kind: str, comment: str, start: int) -> None:
        """A doc comment, beginning at ``start``."""
        text = comment[3:].removeprefix(" ").rstrip()
        line = Token("DOC", text, start, start + len(comment.rstrip()))
        if kind == "FILE_DOC":
            self._found.file.append(text)
            return
        end = self._end_before()
        if end >= 0 and "\n" not in self._text[end:start]:
            self._found.add_after(end, line)
        else:
            self._waiting.append((len(self._tokens), line))

    def _end_before(self) -> int:
        """The end of the last token that is no separator; -1 if there is none."""
        for index in range(len(self._tokens) - 1, self._searched - 1, -1):
            if self._tokens[index].kind not in _SEPARATORS:
                self._end = self._tokens[index].end
                break
        self._searched = len(self._tokens)
        return self._end

"""Turns the text of a file into tokens, and reports what cannot be one.

``parse`` calls ``lex`` once for each file.
"""

from __future__ import annotations

import re
from functools import cache

from ..diagnostics.diagnostic import Report
from ..diagnostics.source import Source, Span
from .lalr_tables import load_tables
from .malformed import MALFORMED, PERCENT, mend
from .tokens import RESERVED, Docs, Lexed, Token

_ORDER = ("BLANK", "NAME", "NUMBER", "COLOR", "STRING", "DOC", "FILE_DOC", "COMMENT")
"""The grammar's patterns in the order of trial: a doc comment would also be a comment."""

_NOT_BEFORE = {"NAME": r"(?!\w)", "NUMBER": rf"(?!\w|\.(?!\.)|{PERCENT})", "COLOR": r"(?!\w)"}
"""What must not follow a token; otherwise ``1.0f`` would be read as ``1.0`` and a name."""

_SEPARATORS = ";,"


@cache
def _pattern() -> re.Pattern[str]:
    """One expression for any token: proper ones first, then marks, then whatever is malformed."""
    tables = load_tables()
    marks = sorted((m for m in tables.literals if not m.isidentifier()), key=len, reverse=True)
    kinds = [(kind, tables.patterns[kind] + _NOT_BEFORE.get(kind, "")) for kind in _ORDER]
    kinds += MALFORMED
    kinds.append(("MARK", "|".join(map(re.escape, marks))))
    kinds.append(("OTHER", r"[^\w\s!-~]+|[\s\S]"))
    return re.compile("|".join(f"(?P<{kind}>{pattern})" for kind, pattern in kinds))


def lex(source: Source, report: Report) -> Lexed:
    """All tokens of ``source``. What cannot be read is reported, and corrected or left out."""
    tokens: list[Token] = []
    docs = _DocCollector(source.text)
    for match in _pattern().finditer(source.text):
        kind = match.lastgroup or ""
        if kind in ("BLANK", "COMMENT"):
            continue
        start, end = match.span()
        word = match.group()
        if kind == "NAME":
            token = Token(word if word in RESERVED else kind, word, start, end)
        elif kind == "MARK":
            token = Token(word, word, start, end)
        elif kind in ("DOC", "FILE_DOC"):
            docs.add(kind, word, start)
            continue
        elif kind in ("NUMBER", "COLOR", "STRING"):
            token = Token(kind, word, start, end)
        else:
            mended = mend(kind, word, Span(source, start, end), report)
            if not mended:
                continue
            token = mended
        tokens.append(token)
        docs.passed(token)
    docs.settle(len(source.text))
    return Lexed(tokens, docs.found)


class _DocCollector:
    """Decides for each doc comment what it describes: what ends on its line, or what follows."""

    def __init__(self, text: str) -> None:
        self.found = Docs()
        self._text = text
        self._waiting: list[Token] = []
        self._end = -1

    def passed(self, token: Token) -> None:
        """The lexer has moved past ``token``."""
        if self._waiting:
            self.settle(token.start)
        if token.kind not in _SEPARATORS:
            self._end = token.end

    def settle(self, start: int) -> None:
        """The comments seen last describe what begins at ``start``."""
        for line in self._waiting:
            self.found.add_before(start, line)
        self._waiting.clear()

    def add(self, kind: str, comment: str, start: int) -> None:
        """A doc comment, beginning at ``start``."""
        text = comment[3:].removeprefix(" ").rstrip()
        line = Token("DOC", text, start, start + len(comment.rstrip()))
        if kind == "FILE_DOC":
            self.found.file.append(text)
        elif self._end >= 0 and "\n" not in self._text[self._end : start]:
            self.found.add_after(self._end, line)
        else:
            self._waiting.append(line)

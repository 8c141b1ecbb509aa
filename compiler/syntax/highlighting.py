"""Cuts a text into pieces of one kind each, for pages that show it in colours.

``burnish gallery`` calls ``pieces``. Nothing is reported: unreadable text is a piece, too.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from .lalr_tables import load_tables
from .lexer import token_pattern
from .tokens import RESERVED

Kind = Literal["comment", "doc", "word", "name", "number", "color", "string", "mark", "blank"]

_KINDS: dict[str, Kind] = {
    "COMMENT": "comment", "DOC": "doc", "FILE_DOC": "doc", "NUMBER": "number", "COLOR": "color",
    "STRING": "string", "NAME": "name", "BLANK": "blank",
}  # fmt: skip


def pieces(text: str) -> Iterator[tuple[Kind, str]]:
    """The pieces of a text in order; together they are the text.

    The grammar's words are names wherever it does not use them. No name is read here but where it
    stands behind a point or before a sign of equality, which is right nearly everywhere.
    """
    words = {word for word in load_tables().literals if word.isidentifier()}
    at = 0
    for match in token_pattern().finditer(text):
        kind = _KINDS.get(match.lastgroup or "", "mark")
        start, end = match.span(match.lastgroup or 0)
        if at < start:
            yield "blank", text[at:start]
        piece = text[start:end]
        if kind == "name" and piece in words | RESERVED and not _is_name(text, start, end):
            kind = "word"
        yield kind, piece
        at = end
    if at < len(text):
        yield "blank", text[at:]


def _is_name(text: str, start: int, end: int) -> bool:
    before, after = text[:start].rstrip(" "), text[end : end + 40].lstrip(" ")
    return before.endswith(".") or (after.startswith("=") and not after.startswith("=="))

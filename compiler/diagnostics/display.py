"""Text as a terminal shows it: one character may be wide, narrow, or better not shown as itself."""

from __future__ import annotations

import unicodedata

_TAB = 4
_HARMFUL = frozenset(("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"))
"""Categories that move the cursor, reorder text, or show nothing: written as their number."""


def harmless(text: str) -> str:
    """``text`` with everything that could disturb a terminal written out."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(map(_shown, text))


def cells(text: str) -> list[str]:
    """What each character of a line is shown as; tabs reach to the next stop."""
    shown: list[str] = []
    column = 0
    for character in text:
        cell = " " * (_TAB - column % _TAB) if character == "\t" else _shown(character)
        column += width(cell)
        shown.append(cell)
    return shown


def width(text: str) -> int:
    """How many columns ``text`` takes."""
    if text.isascii():
        return len(text)
    return sum(map(_columns, text))


def _shown(character: str) -> str:
    if " " <= character <= "~":
        return character
    if unicodedata.category(character) in _HARMFUL:
        return f"<U+{ord(character):04X}>"
    return character


def _columns(character: str) -> int:
    if unicodedata.combining(character):
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1

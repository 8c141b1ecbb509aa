"""Prepares texts for a terminal: characters may be wide, combine, or have to be escaped."""

from __future__ import annotations

import re
import unicodedata

from .file_names import readable

_TAB = 4
_HARMFUL = frozenset(("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"))
"""Unicode categories that move the cursor, reorder text or are invisible: they are escaped."""


_LINES_AND_TABS = re.compile("([\n\t])")


def harmless(text: str) -> str:
    """``text`` with every character escaped that could disturb a terminal."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(map(_shown, text))


def harmless_lines(text: str) -> str:
    """Makes a text of several lines harmless, and keeps their ends and tabs."""
    pieces = _LINES_AND_TABS.split(text)
    pieces[::2] = map(harmless, pieces[::2])
    return "".join(pieces)


def harmless_message(text: str) -> str:
    """Makes a message harmless whose further lines are indented.

    The end of a line without an indented line behind it comes from a name. It is shown, as the rest
    would look like another message.
    """
    return "\n  ".join(map(harmless, text.split("\n  ")))


def cells(text: str) -> list[str]:
    """The characters of a line as they are shown; a tab extends to the next tab stop."""
    shown: list[str] = []
    column = 0
    for character in text:
        cell = " " * (_TAB - column % _TAB) if character == "\t" else _shown(character)
        column += width(cell)
        shown.append(cell)
    return shown


def width(text: str) -> int:
    """The number of columns that ``text`` takes."""
    if text.isascii():
        return len(text)
    return sum(map(_columns, text))


def _shown(character: str) -> str:
    if " " <= character <= "~":
        return character
    category = unicodedata.category(character)
    if category == "Cs":
        return readable(character)  # Of a file's name, it stands for a byte.
    return f"<U+{ord(character):04X}>" if category in _HARMFUL else character


def _columns(character: str) -> int:
    if unicodedata.combining(character):
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1

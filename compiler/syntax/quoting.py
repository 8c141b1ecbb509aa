"""Expressions as messages quote them."""

from __future__ import annotations

from ..diagnostics.source import Span
from . import ast

LONGEST = 60


def quoted(expression: ast.Expression) -> str:
    """The expression as it is written, where that is short; otherwise ``…``."""
    return spanned(expression.span)


def spanned(span: Span) -> str:
    """The text at a place, where that is short; otherwise ``…``."""
    return shortened(span.text)


def shortened(text: str) -> str:
    """A text if it is short enough for a message; otherwise ``…``."""
    return text if len(text) <= LONGEST and "\n" not in text else "…"


def operand(span: Span) -> str:
    """The expression at a place as something can be written behind it: ``(a + b)``, ``f(x)``."""
    return closed(spanned(span))


def closed(text: str) -> str:
    """The text of an expression as something can be written behind it."""
    return text if _is_closed(text) else f"({text})"


def _is_closed(text: str) -> bool:
    """True if a text is a name, a number, or a call or the like that ends in brackets."""
    depth, opened = 0, False
    for character in text:
        if character in "([":
            depth, opened = depth + 1, True
        elif character in ")]":
            depth -= 1
        elif not depth and not (character.isalnum() or character in "_.#…"):
            return False
    return not opened or not text.startswith("(")


def counted(count: int | str, thing: str) -> str:
    """``1 argument``, ``no arguments``, ``2 or 3 arguments``."""
    return f"{count or 'no'} {thing}" + ("" if str(count) == "1" else "s")

"""Expressions as messages quote them."""

from __future__ import annotations

from ..syntax import ast

LONGEST = 40

_TIGHT = (
    ast.Reference, ast.Call, ast.Field, ast.Index, ast.Number, ast.Color, ast.Ascription,
)  # fmt: skip
"""What needs no parentheses before a word."""


def quoted(expression: ast.Expression) -> str:
    """The expression as it is written, where that is short; otherwise ``…``."""
    span = expression.span
    text = span.source.text[span.start : span.end]
    return text if len(text) <= LONGEST and "\n" not in text else "…"


def tight(expression: ast.Expression) -> str:
    """The same where a word follows: in parentheses, if need be."""
    text = quoted(expression)
    return text if isinstance(expression, _TIGHT) or text == "…" else f"({text})"


def counted(count: int | str, thing: str) -> str:
    """``1 argument``, ``no arguments``, ``2 or 3 arguments``."""
    return f"{count or 'no'} {thing}" + ("" if str(count) == "1" else "s")

"""What is nearly a token: named for what it is, and mended so that the rest still parses."""

from __future__ import annotations

from ..diagnostics import rules
from ..diagnostics.diagnostic import Report
from ..diagnostics.source import Span
from .tokens import Token

MALFORMED = [
    ("BAD_NAME", r"[^\W\d]\w*"),
    ("BAD_NUMBER", r"(?:[0-9]+(?:\.(?!\.)[0-9]*)?|\.[0-9]+)(?:[eE][+-][0-9]+)?\w*"),
    ("BAD_COLOR", r"#\w*"),
    ("BAD_STRING", r'"[^"\n]*'),
    ("BAD_COMMENT", r"/\*[\s\S]*"),
    ("FOREIGN", r"&&|\|\||\+\+|\*\*|(?:[-+*/%&|^]|<<|>>)=|::|=>|!(?!=)|[%?]"),
]
"""Tried after the proper patterns, before the marks."""

_SIMPLE = {
    "BAD_NAME": (rules.BAD_NAME, "NAME", ""),
    "BAD_COLOR": (rules.BAD_COLOR, "COLOR", "#000"),
    "BAD_STRING": (rules.UNFINISHED_TEXT, "STRING", '""'),
}
"""The rule that is broken, and the token put in place."""

_INSTEAD = {"&&": "and", "||": "or", "!": "not", "%": "mod"}

_HINTS = {
    "?": "write `if condition then a else b`",
    "=>": "an equation is written `name = expression`",
    "**": "a power is written `pow(x, y)`",
    "++": "nothing changes its value: an equation gives a new name to `x + 1`",
    **dict.fromkeys(
        ("+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="),
        "nothing changes its value: an equation `name = expression` gives a new name to it",
    ),
}


def mend(kind: str, word: str, span: Span, report: Report) -> Token | None:
    """Report the slip; the token that was probably meant, or None to leave it out."""
    if kind == "BAD_NUMBER":
        return _number(word, span, report)
    if kind == "FOREIGN":
        return _foreign(word, span, report)
    if kind == "BAD_COMMENT":
        report.add(rules.UNFINISHED_COMMENT, Span(span.source, span.start, span.start + 2))
        return None
    if kind not in _SIMPLE:
        report.add(rules.UNKNOWN_CHARACTER, span, character=_character(word[0]))
        return Token("FOREIGN", word, span.start, span.end)
    rule, symbol, instead = _SIMPLE[kind]
    report.add(rule, span, text=word)
    return Token(symbol, instead or word, span.start, span.end)


def _number(word: str, span: Span, report: Report) -> Token:
    digits = word.rstrip("fFhHlL")
    better = f"{digits}0" if digits.endswith(".") else digits
    proper = better.replace(".", "", 1).isdigit()
    report.add(rules.BAD_NUMBER, span, text=word, hint=f"write `{better}`" if proper else "")
    return Token("NUMBER", better if proper else "0", span.start, span.end)


def _foreign(word: str, span: Span, report: Report) -> Token:
    instead = _INSTEAD.get(word, "")
    hint = f"write `{instead}`" if instead else _HINTS.get(word, "")
    report.add(rules.FOREIGN_OPERATOR, span, operator=word, hint=hint)
    return Token(instead or "FOREIGN", instead or word, span.start, span.end)


def _character(character: str) -> str:
    """The character as a reader can tell it: its number, and itself where that is harmless."""
    number = f"U+{ord(character):04X}"
    return f"`{character}` ({number})" if character.isprintable() else number

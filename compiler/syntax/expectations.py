"""Words for the message of a syntax error: the expected symbols, and the one found instead."""

from __future__ import annotations

from collections.abc import Set

from .ast import MEMBERS
from .forms import DECLARATIONS, FOLDS
from .lalr_tables import END
from .tokens import Token

_EXPRESSION = {
    "NAME", "NUMBER", "COLOR", "true", "false", "(", "-", "~", "@", "not", "if", "[", *FOLDS,
}  # fmt: skip
_MEMBER = {"NAME", *MEMBERS}
_DECLARATION = {"NAME", "burnish", *DECLARATIONS}
_OPERATORS = {
    "+", "-", "*", "/", "mod", "&", "|", "^", "<<", ">>", "==", "!=", "<", "<=", ">", ">=",
    "and", "or", "(", "[", ".", "with", "in", "as",
}  # fmt: skip
_SEPARATORS = {";", ","}
_WORDS = {
    "NAME": "a name",
    "NUMBER": "a number",
    "STRING": "a quoted text",
    END: "the end of the file",
}


def may_begin_member(expected: Set[str]) -> bool:
    """True if a member may stand where the parser accepts these symbols."""
    return not expected.isdisjoint(MEMBERS)


def may_begin_declaration(expected: Set[str]) -> bool:
    """True if a declaration may stand where the parser accepts these symbols."""
    return "material" in expected


def describe_expected(expected: Set[str]) -> str:
    """The symbols that the grammar accepts, in words that a reader of the text knows."""
    left = set(expected) - (_SEPARATORS if ";" in expected else set())
    kinds = []
    if "NUMBER" in left and "NAME" in left:
        kinds.append("an expression")
        left -= _EXPRESSION
    elif may_begin_declaration(left):
        kinds.append("a declaration")
        left -= _DECLARATION | {END}
    elif may_begin_member(left):
        kinds.append("a member")
        left -= _MEMBER
    if left & {"+", "or"} or {".", "["} <= left:
        left -= _OPERATORS
        kinds = kinds or ["an operator"]
    kinds += sorted(_WORDS.get(symbol, f"`{symbol}`") for symbol in left)
    return _either(kinds)


def describe_found(token: Token) -> str:
    """The token that was found instead."""
    return "the end of the file" if token.kind == END else f"`{token.text}`"


def _either(kinds: list[str]) -> str:
    if len(kinds) < 2:
        return "".join(kinds)
    return f"{', '.join(kinds[:-1])} or {kinds[-1]}"

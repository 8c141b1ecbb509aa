"""Puts a syntax error into words: what was expected, and what was found instead."""

from __future__ import annotations

from .lalr_tables import END
from .tokens import Token

_EXPRESSION = {
    "NAME", "NUMBER", "COLOR", "true", "false", "(", "-", "~", "@", "not", "if", "sum", "product",
    "min", "max", "any", "all", "iterate", "[",
}  # fmt: skip
_MEMBER = {"NAME", "param", "map", "attribute", "target", "discard"}
_DECLARATION = {
    "NAME", "import", "abstract", "material", "light", "pass", "mixin", "fn", "term", "rig",
    "struct", "extern", "space", "burnish",
}  # fmt: skip
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


def describe_expected(expected: set[str]) -> str:
    """The symbols that would do, in words a reader of the text knows."""
    left = expected - _SEPARATORS if ";" in expected else set(expected)
    kinds = []
    if "NUMBER" in left and "NAME" in left:
        kinds.append("an expression")
        left -= _EXPRESSION
    elif "material" in left:
        kinds.append("a declaration")
        left -= _DECLARATION | {END}
    elif "param" in left:
        kinds.append("a member")
        left -= _MEMBER
    if left & {"+", "or"} or {".", "["} <= left:
        left -= _OPERATORS
        kinds = kinds or ["an operator"]
    kinds += sorted(_WORDS.get(symbol, f"`{symbol}`") for symbol in left)
    return _either(kinds)


def describe_found(token: Token) -> str:
    """What stands there instead."""
    return "the end of the file" if token.kind == END else f"`{token.text}`"


def _either(kinds: list[str]) -> str:
    if len(kinds) < 2:
        return "".join(kinds)
    return f"{', '.join(kinds[:-1])} or {kinds[-1]}"

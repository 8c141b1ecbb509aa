"""Choices as other languages write them: ``if`` statements and ``c ? a : b``."""

from __future__ import annotations

from ..diagnostics.fixes import Hint, fix_it
from ..diagnostics.source import Span
from .quoting import shortened
from .token_view import TokenView

STATEMENTS = frozenset(("if", "else", "then"))
"""Reserved words with which other languages begin statements."""

_CHOICE = "there are no statements: choose a value by `name = if condition then a else b`"
UNFINISHED_IF = "every `if` needs both branches: `if condition then a else b`"
_PATTERN = "a choice is written `if condition then a else b`"
_ELSE_IFS = frozenset(("elif", "elsif", "elseif"))
"""Words of other languages for ``else if``."""
_OPENING, _CLOSING = "([{", ")]}"
_FAR = 200
"""The number of characters around a ``?``, or of tokens around an ``if``, that are looked at.

It is limited, so that the work does not grow with the file.
"""


def statement_hint(view: TokenView, index: int) -> Hint:
    """About an ``if``, ``else`` or ``then`` at ``index`` that begins a statement."""
    if view.text(index) == "then":
        return UNFINISHED_IF
    if view.token(index + 1).kind != "(":
        return _CHOICE
    closing = view.closing(index + 1)
    condition = view.written(index + 2, closing) if view.token(closing).kind == ")" else ""
    if not condition:
        return _CHOICE
    body = closing + 1
    in_braces = view.token(body).kind == "{"
    if view.text(body + in_braces) == "discard":
        from ...stdlib.builtins.foreign_words import HIDDEN

        slot = f"{HIDDEN} = {condition}"
        said = f"a material says it by `{slot}`, a pass by `discard when {condition}`"
        return view.replace(said, index, view.value_end(body) - 1, slot)
    name, then, behind = _assignment(view, body)
    if not name or view.text(behind) != "else":
        return _CHOICE
    other, otherwise, end = _assignment(view, behind + 1)
    if name != other:
        return _CHOICE
    written = f"{name} = if {condition} then {then} else {otherwise}"
    return view.replace(f"there are no statements: write `{written}`", index, end - 1, written)


def unfinished_if(view: TokenView, index: int, expected: set[str]) -> Hint:
    """About an ``if`` in an expression that lacks ``then`` or ``else`` in front of ``index``."""
    if view.text(index) in _ELSE_IFS and "else" in expected:
        return view.replace("a further choice is `else if`", index, index, "else if")
    if view.text(index) == "is":
        return view.replace("equality is `==`", index, index, "==")
    first = if_before(view, index)
    if "then" not in expected or first < 0:
        return UNFINISHED_IF
    condition = _condition(view, first + 1, index)
    if not condition:
        return UNFINISHED_IF
    if view.token(index).kind == "{":
        return _in_braces(view, first, index, condition)
    otherwise = _else_behind(view, index)
    if otherwise < 0 or "then" in view.kinds(index, otherwise - index):
        return UNFINISHED_IF
    then, end = view.quoted(index, otherwise), view.value_end(otherwise + 1)
    other = view.quoted(otherwise + 1, end)
    said = f"`then` follows the condition: `if {shortened(condition)} then {then} else {other}`"
    return view.replace(said, first, index - 1, f"if {condition} then")


def if_before(view: TokenView, index: int) -> int:
    """The ``if`` to which a token belongs, in the same brackets; -1 if none is near."""
    depths = view.outline.depths
    for first in range(index - 1, max(index - _FAR, 0) - 1, -1):
        if depths[first] < depths[index]:
            return -1
        if depths[first] == depths[index] and view.token(first).kind == "if":
            return first
    return -1


def _condition(view: TokenView, first: int, behind: int) -> str:
    """The condition between two tokens, without the parentheses that stand around all of it."""
    if view.token(first).kind == "(" and view.closing(first) == behind - 1:
        first, behind = first + 1, behind - 1
    return view.written(first, behind)


def _else_behind(view: TokenView, index: int) -> int:
    """The ``else`` behind a token, in the same brackets; -1 if the expression has none."""
    depths = view.outline.depths
    for behind in range(index, min(index + _FAR, len(view.tokens))):
        if depths[behind] < depths[index]:
            return -1
        if depths[behind] == depths[index] and view.token(behind).kind == "else":
            return behind
    return -1


def _in_braces(view: TokenView, first: int, opening: int, condition: str) -> Hint:
    """About ``if c { a } else { b }`` as a value, of which the first brace is at ``opening``."""
    closing = view.closing(opening)
    other = closing + 2
    if view.kinds(closing, 3) != ["}", "else", "{"]:
        return UNFINISHED_IF
    end = view.closing(other)
    then, otherwise = view.written(opening + 1, closing), view.written(other + 1, end)
    if not then or not otherwise:
        return UNFINISHED_IF
    written = f"if {condition} then {then} else {otherwise}"
    return view.replace(f"a choice has no braces: `{shortened(written)}`", first, end, written)


def _assignment(view: TokenView, first: int) -> tuple[str, str, int]:
    """The name and the value that a branch assigns, and the token behind it; or empty texts."""
    in_braces = view.token(first).kind == "{"
    name = first + in_braces
    if view.kinds(name, 2) != ["NAME", "="]:
        return "", "", first
    end = view.value_end(name + 2)
    value = view.written(name + 2, end)
    end += view.token(end).kind == ";"
    if in_braces:
        if view.token(end).kind != "}":
            return "", "", first
        end += 1
    return (view.text(name), value, end) if value else ("", "", first)


def ternary_hint(span: Span) -> Hint:
    """About the ``?`` at ``span``, by the text of its line: the lexer knows no more yet."""
    text = span.source.text
    colon = _forward(text, span.end, ":")
    if colon < 0:
        return _PATTERN
    start, end = _backward(text, span.start), _forward(text, colon + 1, "")
    condition, then, otherwise = (
        Span(span.source, *_stripped(text, *part))
        for part in ((start, span.start), (span.end, colon), (colon + 1, end))
    )
    parts = [part.text for part in (condition, then, otherwise)]
    if not all(parts) or any("?" in part for part in parts):
        return _PATTERN
    written = f"if {parts[0]} then {parts[1]} else {parts[2]}"
    return fix_it(f"write `{written}`", (condition.to(otherwise), written))


def _forward(text: str, start: int, wanted: str) -> int:
    """The end of an expression from ``start`` on.

    It is -1 if the expression has to end with ``wanted`` and does not. Otherwise the expression
    ends with its line, in front of a separator, a comment, or a bracket that it did not open.
    """
    depth, limit = 0, min(len(text), start + _FAR)
    for index in range(start, limit):
        character = text[index]
        depth += (character in _OPENING) - (character in _CLOSING)
        if depth == 0 and character == wanted:
            return index
        if depth < 0 or (depth == 0 and (character in ",;\n" or text.startswith("//", index))):
            return -1 if wanted else index
    return -1 if wanted else limit


def _backward(text: str, end: int) -> int:
    """The start of an expression that goes on at ``end``."""
    depth = 0
    for index in range(end - 1, max(end - _FAR, 0) - 1, -1):
        character = text[index]
        depth += (character in _CLOSING) - (character in _OPENING)
        assigns = character == "=" and not {text[index - 1], text[index + 1]} & set("=!<>")
        if depth < 0 or (depth == 0 and (assigns or character in ",;\n")):
            return index + 1
    return max(end - _FAR, 0)


def _stripped(text: str, start: int, end: int) -> tuple[int, int]:
    """The place without the blanks at its ends."""
    part = text[start:end]
    return start + len(part) - len(part.lstrip()), start + len(part.rstrip())

"""Breaks lines that are too long, at brackets, commas and operators, in any language.

Skeletons write each statement and each row in one line, and ``writing`` has long ones folded. So
nobody has to know beforehand how long a name, a table's row or an expression will be.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator
from itertools import pairwise

from ..support.frozen import frozen

WIDTH = 100
_OPEN, _CLOSE = "([{", ")]}"
_OPERATOR = re.compile(r" (?:\+|-|\*|/|\?|:|&&|\|\||if|else|and|or) ")
_STRENGTH = {"?": 0, ":": 0, "if": 0, "else": 0, "or": 1, "||": 1, "and": 2, "&&": 2,
             "+": 3, "-": 3, "*": 4, "/": 4}  # fmt: skip


@frozen(kw_only=True)
class Style:
    """How a language breaks its lines."""

    comments: tuple[str, ...]
    """What comments begin with that take a whole line."""
    docstrings: bool = False
    """True if a line in triple quotes is a comment."""
    in_parentheses: bool = False
    """True if only what is in brackets may go on in the next line."""
    last_comma: bool = False
    """True if the last part of a list that is broken has a comma, too."""
    indent: str = "    "


def folded(text: str, style: Style) -> str:
    """The text with its long lines broken."""
    return "\n".join(line for each in text.split("\n") for line in _lines(each, style))


def _lines(line: str, style: Style) -> Iterator[str]:
    if len(line) <= WIDTH:
        yield line
        return
    inner = line.lstrip()
    margin = line[: len(line) - len(inner)]
    if style.docstrings and inner.startswith('"""') and inner.endswith('"""'):
        yield from _docstring(inner[3:-3], margin)
        return
    for comment in style.comments:
        if inner.startswith(f"{comment} "):
            prefix = f"{margin}{comment} "
            yield from textwrap.wrap(
                inner[len(comment) + 1 :], WIDTH, initial_indent=prefix, subsequent_indent=prefix,
                break_long_words=False, break_on_hyphens=False,
            )  # fmt: skip
            return
    yield from _statement(inner, margin, style)


def _docstring(text: str, margin: str) -> Iterator[str]:
    words = textwrap.wrap(
        text, WIDTH - 3, initial_indent=f'{margin}"""', subsequent_indent=margin,
        break_long_words=False, break_on_hyphens=False,
    )  # fmt: skip
    yield from words
    yield f'{margin}"""'


def _statement(text: str, margin: str, style: Style, *, inside: bool = False) -> Iterator[str]:
    """A statement, or ``inside`` of brackets a part of a list, over as many lines as it takes."""
    if len(margin) + len(text) <= WIDTH:
        yield f"{margin}{text}"
        return
    operators = _operators(text)
    brackets = _last_brackets(text)
    assigned = _assigned(text)
    if operators and (inside or not style.in_parentheses or assigned is not None):
        if style.in_parentheses and not inside and assigned is not None:
            yield f"{margin}{text[:assigned]}("
            yield from _operands(text[assigned:], margin + style.indent, style, first="")
            yield f"{margin})"
            return
        first = "" if inside and style.in_parentheses else style.indent
        yield from _operands(text, margin, style, first)
        return
    if brackets is None:
        yield f"{margin}{text}"
        return
    start, end = brackets
    parts = _parts(text[start + 1 : end])
    inner = margin + style.indent
    yield f"{margin}{text[: start + 1]}"
    for number, part in enumerate(parts):
        is_last = number == len(parts) - 1
        comma = "," if not is_last or (style.last_comma and len(parts) > 1) else ""
        yield from _statement(part + comma, inner, style, inside=True)
    yield f"{margin}{text[end:]}"


def _operands(text: str, margin: str, style: Style, first: str) -> Iterator[str]:
    """The operands of the weakest operators, each in a line that begins with its operator."""
    found = _operators(text)
    weakest = min(strength for _, strength in found)
    places = [0, *(at + 1 for at, strength in found if strength == weakest), len(text)]
    for number, (start, end) in enumerate(pairwise(places)):
        indent = margin if number == 0 else margin + first
        yield from _operand(text[start:end].rstrip(), indent, style)


def _operand(text: str, margin: str, style: Style) -> Iterator[str]:
    if len(margin) + len(text) <= WIDTH:
        yield f"{margin}{text}"
    elif _operators(text):
        yield from _operands(text, margin, style, first=style.indent)
    else:
        yield from _statement(text, margin, style, inside=True)


def _assigned(text: str) -> int | None:
    """Where the value of an assignment, or of a return, begins; ``None`` for anything else."""
    if text.startswith("return "):
        return len("return ")
    for at, _ in _outside(text):
        if text.startswith(" = ", at):
            return at + 3
    return None


def _outside(text: str) -> Iterator[tuple[int, str]]:
    """The characters that are in no brackets and in no text, with their places."""
    depth, quote = 0, ""
    escaped = False
    for at, character in enumerate(text):
        if quote:
            if not escaped and character == quote:
                quote = ""
            escaped = character == "\\" and not escaped
        elif character in "\"'`":
            quote = character
        elif character in _OPEN:
            depth += 1
        elif character in _CLOSE:
            depth -= 1
        elif depth == 0:
            yield at, character


def _operators(text: str) -> list[tuple[int, int]]:
    """The places of operators between the outermost operands, with their strengths."""
    found = []
    for at, character in _outside(text):
        match = _OPERATOR.match(text, at) if character == " " else None
        if match is not None:
            found.append((at, _STRENGTH[match[0].strip()]))
    return found


def _last_brackets(text: str) -> tuple[int, int] | None:
    """The last outermost pair of brackets that has something in it."""
    outside = dict(_outside(text))
    found, start, depth, quote, escaped = None, 0, 0, "", False
    for at, character in enumerate(text):
        if quote:
            if not escaped and character == quote:
                quote = ""
            escaped = character == "\\" and not escaped
        elif character in "\"'`":
            quote = character
        elif character in _OPEN:
            start = at if depth == 0 else start
            depth += 1
        elif character in _CLOSE:
            depth -= 1
            if depth == 0 and at > start + 1:
                found = start, at
    return found if outside or found else None


def _parts(text: str) -> list[str]:
    """The parts of a list, between its commas."""
    places = [at for at, character in _outside(text) if character == ","]
    starts, ends = [0, *(at + 1 for at in places)], [*places, len(text)]
    parts = [text[start:end].strip() for start, end in zip(starts, ends, strict=True)]
    return parts if parts[-1] else parts[:-1]

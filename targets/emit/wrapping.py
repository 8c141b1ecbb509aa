"""Breaks long lines in the places where a person would break them.

The emitter calls ``wrapped`` on a finished text. A line is broken at its loosest operators outside
of brackets, and each of them opens a new line. If it has none, it is broken at its widest pair of
brackets: what they enclose is indented between two lines, and arguments fill lines as words do.
Comments are broken between words, and a comment behind a declaration moves above it. Operators and
brackets are those of C, in every language.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import TypeAlias, TypeVar

from .precedence import INFIX, Binding

WIDTH = 110
STEP = 4
"""The indentation of each level, in spaces."""

_BINDINGS = {
    **{symbol: rule.result for symbol, rule in INFIX.items()},
    "?": Binding.CHOICE,
    ":": Binding.CHOICE,
}
_TOKEN = re.compile(
    r"""(?=[](){}<>[,;|&=!+*/%^?:-])  # Many times faster than to try all of them everywhere.
      (?: (?P<open>[(\[]|\{(?!$)|(?<=\w)<)
        | (?P<close>[)\]}]|(?<![ -])>)
        | (?P<separator>[,;])
        | (?<=\ )(?P<operator>\|\||&&|[=!<>]=|<<|>>|[-+*/%<>&|^?:])(?=\ )
      )""",
    re.VERBOSE,
)
"""A bracket, a separator or an operator. Operators have blanks around them; ``<`` of a type has
not, nor has a sign or ``->``. A brace at the end opens a block."""
_COMMENT = re.compile(r"(?P<mark>///?) (?P<text>.*)")
_WORD_END = re.compile(r"(?<![\\\s]) +")
"""Not behind a backslash, which would swallow the next line."""

Place = TypeVar("Place")
Breaks: TypeAlias = Mapping[int, int]
"""For each line that was too long (counted from 1, in order), the number of lines that it
became."""


def wrapped(text: str) -> tuple[str, Breaks]:
    """``text`` with its long lines broken, and into how many lines each of them was."""
    lines = text.split("\n")
    if max(map(len, lines)) <= WIDTH:
        return text, {}
    breaks: dict[int, int] = {}
    for place, line in enumerate(lines):
        if len(line) > WIDTH:
            parts = _known(line)
            breaks[place + 1] = len(parts)
            lines[place] = "\n".join(parts)
    return "\n".join(lines), breaks


def moved(places: Mapping[int, Place], breaks: Breaks) -> dict[int, Place]:
    """Renumber ``places`` of lines, which are in ascending order, for the wrapped text.

    All lines that were made of one line get its place.
    """
    found: dict[int, Place] = {}
    pending = deque(breaks.items())
    further = 0
    for number, place in places.items():
        while pending and pending[0][0] < number:
            further += pending.popleft()[1] - 1
        first = number + further
        found.update(dict.fromkeys(range(first, first + breaks.get(number, 1)), place))
    return found


@lru_cache(maxsize=1024)
def _known(line: str) -> Sequence[str]:
    """A long line that is broken once for all texts that have it, as those of an editor do."""
    return broken(line)


def broken(line: str) -> list[str]:
    """A long line as several lines, as few of them too long as possible."""
    if line.startswith("#"):
        return [line]
    text = line.lstrip(" ")
    indent = len(line) - len(text)
    comment = _COMMENT.search(text)
    if comment is None:
        return _layout(text, indent, indent + STEP)
    opening = f"{' ' * indent}{comment['mark']} "
    words = _filled_lines(_WORD_END.split(comment["text"]), WIDTH - len(opening))
    lines = [opening + line for line in words]
    code = text[: comment.start()].rstrip()
    return [*lines, *_layout(code, indent, indent + STEP)] if code else lines


def _layout(text: str, indent: int, column: int) -> list[str]:
    """``text`` in lines: the first starts at ``indent``, and the others at ``column``.

    It calls itself for parts, which the scheduler does not let nest deeply.
    """
    if indent + len(text) <= WIDTH:
        return [" " * indent + text]
    operands = _operands(text)
    if len(operands) > 1:
        return _chain(operands, indent, column)
    return _enclosed(text, 0, indent, column)


def _chain(operands: Sequence[str], indent: int, column: int) -> list[str]:
    """A line for each operand; factors fill lines as words do."""
    binding = _BINDINGS[operands[1].split(" ", 1)[0]]
    if binding == Binding.PRODUCT or len(operands) == 2:
        around = _around_bracket(operands, indent, column)
        if around:
            return around
    if binding == Binding.PRODUCT:
        operands = list(_filled_lines(operands, WIDTH - column))
    lines = _layout(operands[0], indent, column + STEP)
    for operand in operands[1:]:
        lines += _layout(operand, column, column + STEP)
    return lines


def _around_bracket(operands: Sequence[str], indent: int, column: int) -> list[str]:
    """Lines for operands of which only one is too long: it is broken at its brackets.

    The other operands stand in the lines of the brackets. Empty if that does not work.
    """
    starts = [indent, *(column for _ in operands[1:])]
    wide = [k for k, start in enumerate(starts) if start + len(operands[k]) > WIDTH]
    if len(wide) != 1 or len(_operands(operands[wide[0]])) > 1:
        return []
    start = sum(len(operand) + 1 for operand in operands[: wide[0]])
    lines = _enclosed(" ".join(operands), start, indent, max(column, indent + STEP))
    return lines if max(len(lines[0]), len(lines[-1])) <= WIDTH else []


def _enclosed(text: str, start: int, indent: int, column: int) -> list[str]:
    """``text`` broken in the widest bracket from ``start`` on."""
    bracket = _widest_bracket(text[start:])
    if bracket is None:
        return [" " * indent + text]
    opened, closed = start + bracket[0] + 1, start + bracket[1]
    head, inside, tail = text[:opened], text[opened:closed].strip(), text[closed:]
    items, operands = _items(inside), _operands(inside)
    if len(items) > 1:
        lines = _arguments(items, column)
    elif len(operands) > 1 and column + len(inside) > WIDTH:
        lines = _chain(operands, column, column)
    else:
        lines = _layout(inside, column, column + STEP)
    return [" " * indent + head, *lines, " " * (column - STEP) + tail]


def _arguments(items: Iterable[str], column: int) -> list[str]:
    """Lines with as many arguments as fit; a broken argument shares its lines with no other."""
    lines: list[str] = []
    for line in _filled_lines(items, WIDTH - column):
        lines += _layout(line, column, column + STEP)
    return lines


def _filled_lines(words: Iterable[str], room: int) -> Iterator[str]:
    """Words in lines of at most ``room``, unless a single word is longer."""
    line = ""
    for word in words:
        if line and len(line) + 1 + len(word) > room:
            yield line
            line = word
        else:
            line = f"{line} {word}" if line else word
    yield line


def _operands(text: str) -> list[str]:
    """``text`` split in front of each of its loosest operators; each part begins with its own."""
    found = [
        (token[0], token.start()) for token in _outermost(text) if token.lastgroup == "operator"
    ]
    symbols = {symbol for symbol, _start in found}
    if "?" not in symbols:
        symbols.discard(":")
    if not symbols:
        return [text.strip()]
    loosest = min(_BINDINGS[symbol] for symbol in symbols)
    breaking = {symbol for symbol in symbols if _BINDINGS[symbol] == loosest}
    starts = [start for symbol, start in found if symbol in breaking]
    bounds = zip([0, *starts], [*starts, len(text)], strict=True)
    return [text[first:last].strip() for first, last in bounds]


def _items(text: str) -> list[str]:
    """The parts between separators, each with the separator behind it."""
    ends = [token.end() for token in _outermost(text) if token.lastgroup == "separator"]
    bounds = zip([0, *ends], [*ends, len(text)], strict=True)
    return [text[first:last].strip() for first, last in bounds]


def _widest_bracket(text: str) -> tuple[int, int] | None:
    """The places of that outermost pair of brackets that encloses the most."""
    brackets: list[tuple[int, int]] = []
    opened = 0
    for token in _outermost(text):
        if token.lastgroup == "open":
            opened = token.start()
        elif token.lastgroup == "close" and text[opened] != "<":
            brackets.append((opened, token.start()))
    return max(brackets, key=lambda bracket: bracket[1] - bracket[0], default=None)


@lru_cache(maxsize=64)
def _outermost(text: str) -> Sequence[re.Match[str]]:
    """The tokens outside of brackets, and the outermost brackets themselves."""
    found: list[re.Match[str]] = []
    depth = 0
    for token in _TOKEN.finditer(text):
        depth -= token.lastgroup == "close"
        if depth == 0:
            found.append(token)
        depth += token.lastgroup == "open"
    return found

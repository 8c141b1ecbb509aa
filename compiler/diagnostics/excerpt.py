"""Lines of source text with marks under them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from .diagnostic import Severity
from .display import cells, harmless, width
from .source import Source, Span
from .style import Style

_WIDEST = 100
_LEAD = 30
"""The number of columns of a long line that are shown before its mark."""


class Mark(NamedTuple):
    """A place to mark in the excerpt."""

    span: Span
    text: str
    primary: bool


class _Underline(NamedTuple):
    """The part of a mark that falls on one line, as columns counted from 0."""

    line: int
    start: int
    end: int
    text: str
    primary: bool


def excerpt(marks: list[Mark], severity: Severity, style: Style) -> tuple[str, list[str]]:
    """The margin that line numbers need, and the output lines for all marks, file by file."""
    underlines: dict[Source, list[_Underline]] = {}
    for mark in marks:
        underlines.setdefault(mark.span.source, []).extend(_parts(mark))
    last = max((part.line for parts in underlines.values() for part in parts), default=0)
    margin = " " * len(str(last))
    lines: list[str] = []
    for source, parts in underlines.items():
        arrow = ":::" if lines else "-->"
        place = next(str(mark.span) for mark in marks if mark.span.source is source)
        lines.append(f"{margin}{style.gutter(arrow)} {harmless(place)}")
        lines.append(f"{margin} {style.gutter('|')}")
        lines += _file_lines(source, parts, margin, severity, style)
    return margin, lines


def _parts(mark: Mark) -> Iterator[_Underline]:
    """The underlines of a mark: one, or for several lines those of its first and last."""
    source, start, end = mark.span.source, mark.span.start, mark.span.end
    first, column = source.position(start)
    last, end_column = source.position(max(start, end))
    if last > first and end_column == 1:
        last -= 1
        end_column = len(source.line(last)) + 1
    if last == first:
        yield _Underline(first, column - 1, end_column - 1, mark.text, mark.primary)
        return
    ending = source.line(last)
    indent = len(ending) - len(ending.lstrip())
    yield _Underline(first, column - 1, len(source.line(first)), "", mark.primary)
    yield _Underline(last, min(indent, end_column - 1), end_column - 1, mark.text, mark.primary)


def _file_lines(
    source: Source, parts: list[_Underline], margin: str, severity: Severity, style: Style
) -> Iterator[str]:
    previous = 0
    for number in sorted({part.line for part in parts}):
        if previous and number > previous + 1:
            yield style.gutter("...")
        previous = number
        here = sorted((p for p in parts if p.line == number), key=lambda p: not p.primary)
        shown, offset = _window(cells(source.line(number)), here[0])
        gutter = style.gutter(f"{number:>{len(margin)}} |")
        yield f"{gutter} {''.join(shown)}".rstrip()
        for part in here:
            yield f"{margin} {style.gutter('|')} {_underline(shown, offset, part, severity, style)}"


def _window(shown: list[str], around: _Underline) -> tuple[list[str], int]:
    """The cells of a line that fit, and how many were left out before them."""
    if width("".join(shown)) <= _WIDEST:
        return shown, 0
    start = max(0, around.start - _LEAD) if around.start > _WIDEST - _LEAD else 0
    end, room = start, _WIDEST
    while end < len(shown) and width(shown[end]) <= room:
        room -= width(shown[end])
        end += 1
    visible = shown[start:end]
    if end < len(shown):
        visible.append("…")
    return (["…", *visible], start - 1) if start else (visible, 0)


def _underline(
    shown: list[str], offset: int, part: _Underline, severity: Severity, style: Style
) -> str:
    """Carets for the primary mark, dashes for others, with the mark's text behind."""
    start = min(max(part.start - offset, 0), len(shown))
    end = min(max(part.end - offset, start), len(shown))
    indent = " " * width("".join(shown[:start]))
    length = max(1, width("".join(shown[start:end])))
    marked = f"{('^' if part.primary else '-') * length} {part.text}".rstrip()
    colored = style.severity(severity, marked) if part.primary else style.gutter(marked)
    return f"{indent}{colored}"

"""Puts ``#line`` directives into texts, so that downstream compilers name lines of the material.

``compiling.py`` calls ``directed`` for each finished text if the user wants directives. Where a
language numbers its files, 0 is the text itself, and a comment at its end lists the others.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from ...compiler.diagnostics.source import Source, Span
from ...support.frozen import frozen
from .comments import comment_line

_NEUTRAL = r"[{}\s]*(else[{}\s]*)?$"
"""A pattern of lines about which no compiler complains."""


@frozen
class Directed:
    """A text with directives, and its source map."""

    text: str
    spans: Mapping[int, Span]
    sources: tuple[Source, ...]
    """The files that the directives name. Languages that number them count from 1."""


def directed(text: str, spans: Mapping[int, Span], form: str, name: str) -> Directed:
    """``text``, called ``name``, with ``form`` before each line where the numbering changes.

    ``form`` is a template of a ``line`` and either a file's ``name`` or its ``number``.
    """
    sources = tuple({span.source.name_in_outputs: span.source for span in spans.values()}.values())
    numbers = {source.name_in_outputs: number for number, source in enumerate(sources, start=1)}
    lines: list[str] = []
    moved: dict[int, Span] = {}
    expected: tuple[str, int] = ("", 1)
    for number, line in enumerate(text.split("\n"), start=1):
        span = spans.get(number)
        if span is not None:
            wanted = (span.source.name_in_outputs, span.source.position(span.start)[0])
        elif not expected[0] or re.match(_NEUTRAL, line):
            wanted = expected
        else:
            wanted = ("", len(lines) + 2)
        if wanted != expected:
            file, place = wanted
            number_of_file = numbers.get(file, 0)
            lines.append(form.format(line=place, name=plain(file or name), number=number_of_file))
        lines.append(line)
        if span is not None:
            moved[len(lines)] = span
        expected = (wanted[0], wanted[1] + 1)
    if "{number}" in form:
        lines[-1:] = [*_list(sources), lines[-1]]
    return Directed("\n".join(lines), moved, sources)


def _list(sources: tuple[Source, ...]) -> Iterator[str]:
    yield ""
    yield "// The files that #line numbers; 0 is this text."
    for number, source in enumerate(sources, start=1):
        yield comment_line(f"{number} {source.name_in_outputs}", "//")


def plain(name: str) -> str:
    """A file's name as it may stand between quotation marks."""
    return "".join(c if c.isprintable() and c != '"' else "?" for c in name.replace("\\", "/"))

"""Refuses texts with directives that Burnish does not emit, before compilers get them.

A text may come from a file, such as the plan of a frame. There, ``#include`` would have a compiler
read any other file, or wait for a pipe for ever, and a few lines of ``#define`` can stand for more
code than fits into memory.

Compilers differ about the ends of comments, strings and lines. So this module looks for anything
that some compiler could take for the beginning of a directive, even within a comment, if Burnish
emits nothing like it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

_BEGINNING = re.compile(r"#|%:|\?\?=")
_SPLICE = re.compile(r"(\\|\?\?/)\s*$")
"""The end of a line that continues in the next one; some compilers allow spaces there."""
_SEEN = re.compile(r"[\x21-\x7e]")
_HARMLESS = re.compile(r"#(version|line|extension)\b")
"""The directives that Burnish emits. There are extensions with which texts include files."""


def foreign_directive(text: str, headers: Sequence[str] = ()) -> tuple[int, str] | None:
    """The first directive that Burnish does not emit, with its line; or ``None``.

    ``headers`` are those that may be included.
    """
    includes = {f"#include <{header}>" for header in headers}
    for number, line in _lines(text):
        for start in _foreign(line):
            directive = line[start:].strip()
            if directive not in includes:
                return number, directive
    return None


def _foreign(line: str) -> Iterator[int]:
    """The beginnings of directives that Burnish does not emit.

    A line may be very long, and have many beginnings.
    """
    last_include = line.lower().rfind("include")
    for start in _beginnings(line):
        found = _HARMLESS.match(line, start)
        if found is None or (found[1] == "extension" and start < last_include):
            yield start


def _beginnings(line: str) -> Iterator[int]:
    """The places where directives may begin: after blanks only, or after the end of a comment."""
    seen = _SEEN.search(line)
    first = seen.start() if seen else 0
    closed = line.find("*/")
    for found in _BEGINNING.finditer(line):
        if found.start() <= first or 0 <= closed < found.start():
            yield found.start()


def _lines(text: str) -> Iterator[tuple[int, str]]:
    """The numbered lines as they are, and joined with the next ones where they continue."""
    joined, first = "", 1
    for number, line in enumerate(re.split(r"\r\n|\n|\r", text), start=1):
        yield number, line
        first = first if joined else number
        splice = _SPLICE.search(line)
        joined += line[: splice.start()] if splice else line
        if not splice:
            if joined != line:
                yield first, joined
            joined = ""
    if joined:
        yield first, joined

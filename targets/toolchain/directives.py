"""Refuses texts with directives that Burnish does not emit, before compilers get them.

A text may come from a file, such as the plan of a frame. There, ``#include`` would have a compiler
read any other file, or wait for a pipe for ever, and a few lines of ``#define`` can stand for more
code than fits into memory.

Compilers differ in what they take for a comment, a string or the end of a line. So this looks for
whatever some compiler could take for the beginning of a directive, even within a comment, where
Burnish has nothing like it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

_BEGINNING = re.compile(r"#|%:|\?\?=")
_SPLICE = re.compile(r"(\\|\?\?/)\s*$")
"""The end of a line that goes on in the next one; some compilers allow spaces there."""
_FIRST = re.compile(r"[^\x21-\x7e]*|.*\*/.*", re.DOTALL)
"""What may stand in front of a directive: nothing that is seen, or the end of a comment."""
_HARMLESS = re.compile(r"#(version|line|extension(?i:(?!.*include)))\b.*", re.DOTALL)
"""What Burnish emits. There are extensions with which texts include files."""


def foreign_directive(text: str, headers: Sequence[str] = ()) -> tuple[int, str] | None:
    """The line of the first directive that Burnish does not emit, and the directive; or ``None``.

    ``headers`` are what may be included.
    """
    includes = {f"#include <{header}>" for header in headers}
    for number, line in _lines(text):
        for found in _BEGINNING.finditer(line):
            directive = line[found.start() :].strip()
            if (
                _FIRST.fullmatch(line[: found.start()])
                and directive not in includes
                and not _HARMLESS.fullmatch(directive)
            ):
                return number, directive
    return None


def _lines(text: str) -> Iterator[tuple[int, str]]:
    """The numbered lines, as they are and, where they go on in others, joined with these."""
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

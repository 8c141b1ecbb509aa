"""Reads pages of tests: markdown with programs in which marks stand beside the lines.

``test_pages.py`` reads each page of this folder. A mark is the comment at the end of a line:

    turned = rotate(v, a)   // : vec2              the type of this equation
    total  = dot(v, v)      // = 25                its value
    root   = sqrt(2)        // : float = 1.4142…   both; the value goes on after these digits
    wrong  = uv.z           // B0304               the diagnostic reported here

All comments of a page's programs are marks: what is meant for readers stands between the programs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

_FENCE = re.compile(r"^```([^\n]*)\n(.*?)(^```$|\Z)", re.MULTILINE | re.DOTALL)
_COMMENT = re.compile(r"//.*")
_MARK = re.compile(
    r"//(?=.)(?: : (?P<type>[^=]+?))?(?: = (?P<value>.+))?|// (?P<codes>B\d{4}(?:, B\d{4})*)"
)


class BadPageError(Exception):
    """A page that cannot be tested as it is written; the message begins with the place."""


@dataclass(frozen=True)
class Mark:
    """The claims beside one line of a program; those that it does not make are empty."""

    line: int
    """The line of the program, from 1."""
    type: str
    value: str
    codes: tuple[str, ...]


@dataclass(frozen=True)
class Program:
    """A fenced block of a page: a whole file of the language, with at least one mark."""

    page: str
    """The name of the page, for messages."""
    first_line: int
    """The line of the page on which the program begins, from 1."""
    text: str
    marks: tuple[Mark, ...]

    def place(self, line: int) -> str:
        """A line of the program as a place on the page: ``values.md:12``."""
        return f"{self.page}:{self.first_line + line - 1}"


def programs(page: Path) -> list[Program]:
    """The programs of a page, in order.

    Raises ``BadPageError`` for a page without programs, a block that is no program, is not closed
    or has no mark, and a comment that is no mark.
    """
    text = page.read_text(encoding="utf-8")
    found = [_program(page.name, text, fence) for fence in _FENCE.finditer(text)]
    if not found:
        raise BadPageError(f"{page.name}: there is no program on this page")
    return found


def _program(page: str, text: str, fence: re.Match[str]) -> Program:
    first_line = text.count("\n", 0, fence.start(2)) + 1
    place = f"{page}:{first_line - 1}"
    if not fence[3]:
        raise BadPageError(f"{place}: this block is never closed")
    if fence[1] != "burnish":
        raise BadPageError(f"{place}: the blocks of a page are marked `burnish`, not `{fence[1]}`")
    marks = tuple(_marks(page, first_line, fence[2]))
    if not marks:
        raise BadPageError(f"{place}: this program has no mark, so nothing of it would be tested")
    return Program(page, first_line, fence[2], marks)


def _marks(page: str, first_line: int, program: str) -> Iterator[Mark]:
    for number, line in enumerate(program.splitlines(), 1):
        if (comment := _COMMENT.search(line)) is None:
            continue
        written = comment[0].rstrip()
        mark = _MARK.fullmatch(written)
        if mark is None:
            place = f"{page}:{first_line + number - 1}"
            like = "`// : vec3`, `// = 7` or `// B0302`"
            raise BadPageError(f"{place}: `{written}` is no mark such as {like}")
        codes = tuple(mark["codes"].split(", ")) if mark["codes"] else ()
        yield Mark(number, mark["type"] or "", mark["value"] or "", codes)

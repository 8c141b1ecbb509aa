"""Cuts a text into sections that can be read one by one, without reading all of it before.

A section reaches from one header of a declaration, such as ``material Name {``, to the next one at
the left margin; comments and empty lines right above a header belong to it. Behind the last
declaration without a mistake nothing is open, so a section is read as it would be in the whole
file, if those before it have no mistake. ``incremental.py`` asks for the sections.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache

from ...support.frozen import frozen
from .forms import DECLARATIONS
from .outline import HEADER_ENDS, TWO_WORDS


@frozen
class Section:
    """Characters ``start`` to ``end`` of a text, and the header that follows."""

    start: int
    end: int
    ahead: tuple[int, int]
    """The place of the next header, down to the mark or word behind the name.

    Whoever reads a section never looks at more of what follows.
    """


def sections(text: str) -> Iterator[Section]:
    """The sections of a text, in order; the first one may begin with anything."""
    start = behind = 0
    for header in _header().finditer(text):
        place = _above(text, header.start(), behind)
        if place > start:
            yield Section(start, place, header.span())
        start, behind = place, header.end()
    yield Section(start, len(text), (len(text), len(text)))


@cache
def _header() -> re.Pattern[str]:
    """The header of a declaration at the left margin, in the form that nearly everybody writes."""
    words = "|".join(sorted(DECLARATIONS.keys() - TWO_WORDS - {"import"}))
    ends = "|".join(sorted(filter(str.isidentifier, HEADER_ENDS)))
    first = rf"(?:(?:{'|'.join(sorted(TWO_WORDS))}) +)?(?:{words}|block)"
    return re.compile(rf"(?m)^{first} +[^\W\d]\w* *(?:[{{(]|[:<](?=[ \w])|(?:{ends})\b)")


def _above(text: str, start: int, least: int) -> int:
    """The start of the first of the comments and empty lines that stand right above a line."""
    while start > least:
        line = text.rfind("\n", least, start - 1) + 1
        above = text[line:start].strip()
        if (least and not line) or (above and not above.startswith("//")):
            break
        start = line
    return start

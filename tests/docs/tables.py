"""Pages as texts: where a page is made, and tables and lists of code in it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"

NOTE = "<!-- Made by `python -m tests.docs.generate`; do not edit. -->"
"""The first line of a page that is generated as a whole."""


def spliced(page: str, name: str, text: str) -> str:
    """The page with ``text`` between its marks ``<!-- name -->`` and ``<!-- end -->``."""
    marked = re.compile(f"(?<=<!-- {name} -->\n).*?(?=<!-- end -->)", re.DOTALL)
    return marked.sub(lambda _: text, page, count=1)


def table(heading: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    """A table of Markdown."""
    lines = (heading, ("---",) * len(heading), *rows)
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


def codes(texts: Iterable[str], between: str = ", ") -> str:
    """Texts as code, one after the other."""
    return between.join(f"`{cell(text)}`" for text in texts)


def cell(text: str) -> str:
    """A text as a cell of a table."""
    return text.replace("|", "\\|")

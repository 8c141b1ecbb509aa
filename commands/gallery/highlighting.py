"""Shows texts in colours: Burnish by its own lexer, shaders by their language's reserved words.

``pages.py`` calls both functions. They return HTML with the text escaped, a line in each ``span``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from html import escape
from itertools import chain

from markupsafe import Markup

from ...compiler.diagnostics.display import harmless_lines
from ...compiler.syntax.highlighting import pieces
from ...targets import registry

_PLAIN = frozenset(("name", "mark", "blank"))
"""Kinds of pieces that are shown without a colour."""
_SHADER = re.compile(
    r"(?P<comment>//[^\n]*)|(?P<doc>^[ \t]*#[^\n]*)|(?P<number>\b\d[\w.]*)|(?P<name>[A-Za-z_]\w*)",
    re.MULTILINE,
)


def burnish_text(text: str) -> Markup:
    """A text in Burnish; colours are shown beside the numbers that mean them."""
    return _lines(chain.from_iterable(_swatched(kind, piece) for kind, piece in pieces(text)))


def shader_text(text: str, language: str) -> Markup:
    """A text in another language."""
    return _lines(_shader_pieces(text, language))


def _swatched(kind: str, piece: str) -> Iterator[tuple[str, str]]:
    if kind == "color":
        yield "swatch", piece
    yield kind, piece


def _shader_pieces(text: str, language: str) -> Iterator[tuple[str, str]]:
    words = registry.load(language).reserved().words
    at = 0
    for match in _SHADER.finditer(text):
        if at < match.start():
            yield "mark", text[at : match.start()]
        kind = match.lastgroup or "mark"
        yield "word" if kind == "name" and match[0] in words else kind, match[0]
        at = match.end()
    yield "mark", text[at:]


def _lines(found: Iterable[tuple[str, str]]) -> Markup:
    line: list[str] = []
    lines = [line]
    for kind, piece in found:
        if kind == "swatch":
            line.append(f'<svg class="swatch"><rect fill="{escape(piece)}"/></svg>')
            continue
        for number, part in enumerate(piece.split("\n")):
            if number:
                line = []
                lines.append(line)
            if part:
                shown = escape(harmless_lines(part))
                line.append(shown if kind in _PLAIN else f'<b class="{kind}">{shown}</b>')
    while lines and not lines[-1]:
        lines.pop()
    return Markup("\n".join(f"<span>{''.join(line)}</span>" for line in lines))

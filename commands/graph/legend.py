"""Draws the legend of a picture: the kinds of boxes, arrows and marks that it has."""

from __future__ import annotations

from collections.abc import Iterator

from .boxes import shield
from .kinds import ArrowKind, Kind, shade
from .lanes import drawn_mark
from .model import Picture
from .shapes import FAINT, TEXT_SIZE, WHITE, dashed, text, width_of

SWATCH, GAP, LINE = 22.0, 15.0, 22.0
PARTS = ((0.01, "1% of the error"), (0.25, "25%"), (1.0, "all of it"))
"""The shades of boxes in a picture of a pixel's error."""


def legend(picture: Picture, width: float) -> Iterator[tuple[str, float, float]]:
    """The entries in rows, each with its position."""
    x = y = 0.0
    for swatch, words in _entries(picture):
        length = SWATCH + 7 + width_of(words, TEXT_SIZE) + GAP
        if x and x + length > width:
            x, y = 0.0, y + LINE
        yield swatch + text(SWATCH + 7, 11, words, TEXT_SIZE, FAINT), x, y
        x += length


def _entries(picture: Picture) -> Iterator[tuple[str, str]]:
    kinds = {box.kind for box in picture.boxes}
    has_parts = any(box.part is not None for box in picture.boxes)
    for kind in Kind:
        if kind in kinds:
            yield _swatch(WHITE if has_parts else kind.fill, kind.line), kind.words
    if has_parts:
        yield from ((_swatch(shade(part), "#8a8a8a"), words) for part, words in PARTS)
    if any(box.guarded for box in picture.boxes):
        yield shield(6, 0), "a guard stays"
    arrows = {arrow.kind for arrow in picture.arrows}
    for arrow in ArrowKind:
        if arrow in arrows and arrow.words:
            looks = f'stroke="#5b6570" stroke-width="{arrow.width:g}"{dashed(arrow.dash)}'
            yield f'<path d="M0 7H{SWATCH:g}" {looks}/>', arrow.words
    for mark in picture.time_line.used if picture.time_line is not None else ():
        yield drawn_mark(mark, SWATCH / 2, 7), mark.words


def _swatch(fill: str, line: str) -> str:
    return f'<rect width="{SWATCH:g}" height="13" rx="4" fill="{fill}" stroke="{line}"/>'

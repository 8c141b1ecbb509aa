"""Draws the legend of a frame's picture: the kinds of boxes, arrows and marks that it has."""

from __future__ import annotations

from collections.abc import Iterator

from ..shapes import FAINT, TEXT_SIZE, text, width_of
from .lanes import drawn_mark
from .looks import ARROWS, COLORS
from .model import KINDS, MARKS, FramePicture

SWATCH, GAP, LINE = 22.0, 15.0, 22.0


def legend(picture: FramePicture, width: float) -> Iterator[tuple[str, float, float]]:
    """The entries in rows, each with its position."""
    x = y = 0.0
    for swatch, words in _entries(picture):
        length = SWATCH + 7 + width_of(words, TEXT_SIZE) + GAP
        if x and x + length > width:
            x, y = 0.0, y + LINE
        yield swatch + text(SWATCH + 7, 11, words, TEXT_SIZE, FAINT), x, y
        x += length


def _entries(picture: FramePicture) -> Iterator[tuple[str, str]]:
    kinds = {box.kind for box in picture.boxes}
    for kind, words in KINDS.items():
        if kind in kinds:
            fill, line, _ = COLORS[kind]
            yield (
                f'<rect width="{SWATCH:g}" height="13" rx="4" fill="{fill}" stroke="{line}"/>',
                words,
            )
    arrows = {arrow.kind for arrow in picture.arrows}
    for arrow, look in ARROWS.items():
        if arrow in arrows:
            dash = f' stroke-dasharray="{look.dash}"' if look.dash else ""
            yield (
                f'<path d="M0 7H{SWATCH:g}" stroke="#5b6570" stroke-width="{look.width:g}"{dash}/>',
                look.words,
            )
    marks = {mark for row in picture.rows for mark in row.marks.values()}
    for mark, words in MARKS.items():
        if mark in marks:
            yield drawn_mark(mark, SWATCH / 2, 7), words

"""Draws the time line of a frame: a row for each texture, a column for each step."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from .kinds import Mark, texture_color
from .model import Column, Life, Row, TimeLine
from .shapes import (
    FAINT,
    INK,
    NAME_SIZE,
    ONCE,
    TEXT_SIZE,
    WHITE,
    cut,
    dashed,
    escaped,
    rectangle,
    text,
    titled,
    width_of,
)

CELL, HEIGHT, BAR = 30.0, 26.0, 18.0
LONG = 8
"""The number of an equation's steps above which those in the middle are left out."""
BEFORE, AFTER = 4, 2
"""The numbers of its first and last steps that are shown then."""
SLOPE = math.radians(45)
LONGEST = 26
"""The most letters of a step's name."""
HOLDS = 64
"""The most letters of the names of a texture's results."""
TITLE = 26.0


class Lanes:
    """A time line with the places of its columns."""

    def __init__(self, line: TimeLine) -> None:
        self._line = line
        self._shown, self._place = _columns(line.columns)
        titles = [f"{row.title}  {row.what}" for row in line.rows]
        self._left = max((width_of(title, TEXT_SIZE) for title in titles), default=0.0) + 40
        names = [width_of(cut(c.name, LONGEST), TEXT_SIZE) if c else 0.0 for c in self._shown]
        self._top = TITLE + max(names, default=0.0) * math.sin(SLOPE) + 16
        self._right = self._left + CELL * len(self._shown)
        leaning = [
            self._left + CELL * (number + 0.5) + width * math.cos(SLOPE) + 12
            for number, width in enumerate(names)
        ]
        held = max((len(cut(row.holds, HOLDS)) for row in line.rows), default=0)
        self.width = max([self._right + 36 + width_of("x" * held, TEXT_SIZE), *leaning])
        self.height = self._top + HEIGHT * len(line.rows) + 6

    def shapes(self) -> Iterator[str]:
        """The heading, the columns, and above them the rows."""
        yield text(0, 12, "Textures and buffers, from step to step", NAME_SIZE, FAINT, bold=True)
        for number, column in enumerate(self._shown):
            yield from self._heading(number, column)
        for number, row in enumerate(self._line.rows):
            yield from self._row(row, self._top + HEIGHT * number)

    def _heading(self, number: int, column: Column | None) -> Iterator[str]:
        x, height = self._left + CELL * number, self.height - 6 - self._top
        fill = "#f7f9fa" if number % 2 else "#f0f3f6"
        yield rectangle(x, self._top, CELL, height, f'fill="{fill}"')
        middle, y = x + CELL / 2, self._top - 7
        if column is None:
            yield text(middle - 4, y, "…", NAME_SIZE, FAINT)
            return
        if column.only_first:
            looks = f'fill="none" stroke="#8b97a3"{dashed(ONCE)}'
            yield rectangle(x + 1, self._top, CELL - 2, height, looks)
        name = cut(column.name, LONGEST)
        yield f'<g transform="translate({middle:.1f} {y:.1f}) rotate(-45)">'
        yield text(0, 4, name, TEXT_SIZE, INK, bold=not column.group) + "</g>"

    def _row(self, row: Row, y: float) -> Iterator[str]:
        middle, color = y + HEIGHT / 2, texture_color(row.texture)
        yield rectangle(0, middle - 5, 10, 10, f'rx="2" fill="{color}"')
        yield text(17, middle + 4, f"{row.title}  {row.what}", TEXT_SIZE, INK)
        yield (
            f'<path d="M0 {y + HEIGHT:.1f}H{self._right + 14:.1f}" stroke="#e2e7ec" fill="none"/>'
        )
        for number, life in enumerate(row.ordered):
            if not self._is_left_out(life):
                later, opacity = row.ordered[number + 1 :], 0.30 + 0.22 * (number % 2)
                yield self._bar(life, later, middle, color, opacity)
        for number, mark in row.marks.items():
            if self._shown[self._place[number]] is not None:
                x = self._left + CELL * (self._place[number] + 0.5)
                words = f"{self._line.columns[number].name}: {mark.words}"
                yield titled(words, drawn_mark(mark, x, middle))
        held = cut(row.holds, HOLDS)
        yield titled(row.holds, text(self._right + 30, middle + 4, held, TEXT_SIZE, FAINT))

    def _is_left_out(self, life: Life) -> bool:
        """True if all steps that need a result are among those that are not shown."""
        first, last = self._place[life.first], self._place[life.last]
        return first == last and self._shown[first] is None

    def _bar(
        self, life: Life, later: Sequence[Life], middle: float, color: str, opacity: float
    ) -> str:
        """The bar of a result, from its first to its last step.

        If the next result begins in the step in which this one ends, the bars meet in the middle.
        """
        begin = 0.0 if life.before else CELL * self._place[life.first] + 4
        end = CELL * (self._place[life.last] + 1) - 4
        if later and later[0].first == life.last:
            end = CELL * (self._place[life.last] + 0.5) - 1
        if any(other.first <= life.first < other.last for other in later):
            begin += CELL / 2
        end = max(end, begin + 6)
        if life.after:
            end = CELL * len(self._shown) + 4
        top, left = middle - BAR / 2, self._left + begin
        right = self._left + end
        point = f"l8 {BAR / 2:.1f} l-8 {BAR / 2:.1f}" if life.after else f"v{BAR:.1f}"
        dent = f"l8 {-BAR / 2:.1f} z" if life.before else "z"
        words = f"{life.result}{' of the last frame' if life.before else ''}"
        return (
            f'<path d="M{left:.1f} {top:.1f} H{right:.1f} {point} H{left:.1f} {dent}" '
            f'fill="{color}" fill-opacity="{opacity:.2f}"><title>{escaped(words)}</title></path>'
        )


def drawn_mark(mark: Mark, x: float, y: float) -> str:
    """The small shape for a step's use of a texture."""
    if mark is Mark.READ:
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{WHITE}" stroke="{INK}"/>'
    if mark is Mark.DROPPED:
        shape = f"M{x - 4:.1f} {y - 4:.1f}l8 8m0 -8l-8 8"
        return f'<path d="{shape}" stroke="{INK}" stroke-width="1.6" fill="none"/>'
    if mark is Mark.WRITTEN:
        return rectangle(x - 4, y - 4, 8, 8, f'fill="{INK}"')
    dot = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" fill="{INK}"/>'
    if mark is Mark.DRAWN_OVER:
        dot += f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.8" fill="{WHITE}"/>'
    return dot


def _columns(columns: Sequence[Column]) -> tuple[list[Column | None], dict[int, int]]:
    """The columns to show, and for each step the position of its column.

    ``None`` stands for several columns that are left out.
    """
    sizes: dict[str, int] = {}
    for column in columns:
        sizes[column.group] = sizes.get(column.group, 0) + 1
    shown: list[Column | None] = []
    place: dict[int, int] = {}
    group, at = "", 0
    for column in columns:
        group, at = column.group, at + 1 if group == column.group else 0
        is_long = column.group != "" and sizes[column.group] > LONG
        if is_long and BEFORE <= at < sizes[column.group] - AFTER:
            if shown[-1] is not None:
                shown.append(None)
        else:
            shown.append(column)
        place[column.number] = len(shown) - 1
    return shown, place

"""Draws boxes: a name, lines below it, and rows of results, on the colour of the kind."""

from __future__ import annotations

from collections.abc import Iterator

from .kinds import Mark, texture_color
from .layout import Item
from .model import Box, Port
from .shapes import (
    FAINT,
    FAINT_ON_DARK,
    INK,
    NAME_SIZE,
    ONCE,
    TEXT_SIZE,
    WHITE,
    cut,
    dashed,
    rectangle,
    text,
    titled,
    width_of,
)

HEAD, LINE, ROW = 25.0, 14.0, 19.0
"""The heights of a box's name, of a line below it, and of the row of a result."""
STACK = 4.0
"""The distance by which the boxes behind a repeated step stand out."""
GUARD = "#d1570b"
"""The colour of guards."""


def size_of(box: Box) -> tuple[float, float]:
    """The width and height of a box, with those that stand out behind it."""
    widths = [width_of(cut(box.heading), NAME_SIZE)]
    widths += [width_of(cut(line), TEXT_SIZE) for line in box.below]
    widths += [width_of(_row(port), TEXT_SIZE) + 17 for port in box.ports]
    widths += [width_of(cut(each.text), TEXT_SIZE) + 6 for each in box.inputs]
    guard = 16.0 if box.guarded else 0.0
    rows = len(box.ports) + len(box.inputs)
    height = _head(box) + ROW * rows + (5 if rows else 4)
    return max(widths) + 20 + guard + _stack(box), height + _stack(box)


def start_of(box: Box, item: Item, port: str) -> tuple[float, float]:
    """The place where an arrow begins: on the right, at the height of a row if there are any."""
    right = item.x + item.width - _stack(box)
    for number, each in enumerate(box.ports):
        if each.key == port:
            return right, item.y + _head(box) + ROW * (number + 0.5)
    return right, item.middle


def end_of(box: Box, item: Item, row: int | None) -> float:
    """The height at which an arrow ends: that of a row if it leads to one."""
    return item.middle if row is None else item.y + _head(box) + ROW * (row + 0.5)


def drawn_box(box: Box, item: Item) -> str:
    """The shapes of a box, with its facts for those who point at it."""
    stack = _stack(box)
    width, height = item.width - stack, item.height - stack
    is_round = box.kind.is_round and not box.inputs
    corner = min(height / 2, 14.0) if is_round else 6.0
    line, thickness = (GUARD, 1.8) if box.guarded else (box.kind.line, 1.1)
    looks = f'rx="{corner:.1f}" fill="{box.fill}" stroke="{line}" stroke-width="{thickness}"'
    looks += dashed(ONCE if box.only_first or box.kind.is_dashed else "")
    behind = (2 * STACK, STACK, 0.0) if stack else (0.0,)
    shapes = [rectangle(item.x + by, item.y + by, width, height, looks) for by in behind]
    shapes += _words(box, item)
    if box.ports:
        shapes += _ports(box, item, width)
    shapes += _inputs(box, item, width)
    if box.guarded:
        shapes.append(shield(item.x + item.width - 17, item.y + 6))
    return titled(_tooltip(box), *shapes)


def shield(x: float, y: float) -> str:
    """The sign of a guard."""
    shape = "l5 -1.8 l5 1.8 v5 c0 3 -2.4 5 -5 6.2 c-2.6 -1.2 -5 -3.2 -5 -6.2 z"
    return f'<path d="M{x:.1f} {y + 1.5:.1f} {shape}" fill="{GUARD}"/>'


def _stack(box: Box) -> float:
    """The distance by which the last of the boxes behind a box stands out."""
    return 2 * STACK if box.repeated else 0.0


def _head(box: Box) -> float:
    """The height of a box above the rows of its results."""
    return HEAD + LINE * len(list(box.below)) + (6 if box.ports or box.inputs else 2)


def _row(port: Port) -> str:
    return f"{port.name}: {port.what}{' · dropped' * (port.mark is Mark.DROPPED)}"


def _words(box: Box, item: Item) -> Iterator[str]:
    ink, faint = (WHITE, FAINT_ON_DARK) if box.is_dark else (INK, FAINT)
    x = item.x + 10
    yield text(x, item.y + 18, cut(box.heading), NAME_SIZE, ink, bold=True)
    for number, line in enumerate(box.below):
        yield text(x, item.y + HEAD + 8 + LINE * number, cut(line), TEXT_SIZE, faint)


def _ports(box: Box, item: Item, width: float) -> Iterator[str]:
    """The results of a step: one row each, with the colour of its texture."""
    top, height = item.y + _head(box), ROW * len(box.ports) + 4
    yield rectangle(item.x + 1, top - 1, width - 2, height, f'rx="4" fill="{WHITE}"')
    for number, port in enumerate(box.ports):
        y, color = top + ROW * number, texture_color(port.texture)
        fill, ink = ("none", "#8b97a3") if port.mark is Mark.DROPPED else (color, INK)
        looks = f'rx="2" fill="{fill}" stroke="{color}"'
        yield rectangle(item.x + 10, y + 5, 10, 10, looks)
        yield text(item.x + 27, y + 14, _row(port), TEXT_SIZE, ink)


def _inputs(box: Box, item: Item, width: float) -> Iterator[str]:
    """What a box reads: one row each, with a point, which is filled where an arrow ends."""
    if not box.inputs:
        return
    top, height = item.y + _head(box), ROW * len(box.inputs) + 4
    yield rectangle(item.x + 1, top - 1, width - 2, height, f'rx="4" fill="{WHITE}"')
    for number, each in enumerate(box.inputs):
        y = end_of(box, item, number)
        line = box.kind.line
        fill = line if each.is_read else WHITE
        looks = f'r="3" fill="{fill}" stroke="{line}"'
        yield f'<circle cx="{item.x:.1f}" cy="{y:.1f}" {looks}/>'
        yield text(item.x + 12, y + 4, cut(each.text), TEXT_SIZE, INK)


def _tooltip(box: Box) -> str:
    rows = [f"{port.key} in texture #{port.texture}" if port.texture is not None else port.key
            for port in box.ports]  # fmt: skip
    return "\n".join(dict.fromkeys([box.heading, *box.below, *box.facts, *rows]))

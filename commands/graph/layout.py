"""A layered layout: boxes in columns from left to right, so that every arrow points right.

It has the classic three steps (Sugiyama, Tagawa, Toda 1981): columns by longest paths, an order
within columns that avoids crossings (barycentres), and heights that straighten arrows. If an arrow
passes a column, it has a place of its own there, so that it never runs under a box. The time is
linear in boxes, arrows and places, multiplied by a fixed number of sweeps.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

SWEEPS = 8
"""The number of times that the order of columns is improved, and then the heights."""
COLUMN_GAP = 44.0
ROW_GAP = 14.0
PASSAGE = 6.0
"""The height of the place where an arrow passes a column."""


@dataclass(slots=True)
class Item:
    """A box, or a place where an arrow passes a column."""

    width: float
    height: float
    column: int = 0
    x: float = 0.0
    y: float = 0.0
    """The upper left corner."""
    left: list[Item] = field(default_factory=list)
    right: list[Item] = field(default_factory=list)
    """The neighbours in the columns on both sides."""

    @property
    def middle(self) -> float:
        """The height at which arrows begin and end."""
        return self.y + self.height / 2


@dataclass(slots=True)
class Layout:
    """The positions of all boxes and arrows."""

    items: dict[str, Item]
    paths: dict[tuple[str, str], list[Item]]
    """The items on the way of an arrow, both ends included, by these ends."""
    width: float
    height: float


def laid_out(sizes: Mapping[str, tuple[float, float]], edges: Iterable[tuple[str, str]]) -> Layout:
    """Place boxes of these sizes, given operands first, and the arrows between them."""
    items = {key: Item(*size) for key, size in sizes.items()}
    arrows = list(edges)
    _assign_columns(items, arrows)
    columns: list[list[Item]] = [
        [] for _ in range(1 + max((i.column for i in items.values()), default=0))
    ]
    for item in items.values():
        columns[item.column].append(item)
    paths = {arrow: _path(items[arrow[0]], items[arrow[1]], columns) for arrow in arrows}
    for _ in range(SWEEPS):
        _reorder(columns)
    _stack(columns)
    for _ in range(SWEEPS):
        _straighten(columns)
    width, height = _settle(columns)
    return Layout(items, paths, width, height)


def _assign_columns(items: Mapping[str, Item], arrows: Sequence[tuple[str, str]]) -> None:
    """Put users to the right of their operands.

    Items without operands are just left of their first user.
    """
    users: dict[str, list[str]] = {key: [] for key in items}
    uses: dict[str, list[str]] = {key: [] for key in items}
    for source, target in arrows:
        users[source].append(target)
        uses[target].append(source)
    for key, item in items.items():
        item.column = max((items[source].column + 1 for source in uses[key]), default=0)
    for key in reversed(list(items)):
        if users[key] and not uses[key]:
            items[key].column = min(items[target].column for target in users[key]) - 1


def _path(source: Item, target: Item, columns: list[list[Item]]) -> list[Item]:
    path = [source]
    for column in range(source.column + 1, target.column):
        passage = Item(0.0, PASSAGE, column)
        columns[column].append(passage)
        path.append(passage)
    path.append(target)
    for one, other in pairwise(path):
        one.right.append(other)
        other.left.append(one)
    return path


def _reorder(columns: list[list[Item]]) -> None:
    """Sort each column by the mean position of its neighbours, once from each side."""
    place: dict[int, float] = {}
    for column in columns:
        place |= {id(item): float(i) for i, item in enumerate(column)}
    for side, wanted in (("left", columns), ("right", columns[::-1])):
        for column in wanted:
            mean = {
                id(item): _mean([place[id(n)] for n in neighbours])
                if neighbours
                else place[id(item)]
                for item in column
                for neighbours in (getattr(item, side),)
            }
            column.sort(key=lambda item: mean[id(item)])
            place |= {id(item): float(i) for i, item in enumerate(column)}


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)


def _stack(columns: list[list[Item]]) -> None:
    x = 0.0
    for column in columns:
        width = max((item.width for item in column), default=0.0)
        y = 0.0
        for item in column:
            item.x, item.y = x, y
            if item.width == 0:
                item.width = width  # an arrow passes the whole column in a straight line
            y += item.height + ROW_GAP
        x += width + COLUMN_GAP


def _straighten(columns: list[list[Item]]) -> None:
    """Move items to the mean height of their neighbours, as far as their order allows."""
    for side in ("left", "right"):
        for column in columns if side == "left" else columns[::-1]:
            wanted = []
            for item in column:
                neighbours: list[Item] = getattr(item, side)
                middle = _mean([n.middle for n in neighbours]) if neighbours else item.middle
                wanted.append(middle - item.height / 2)
            _place(column, wanted)


def _place(column: list[Item], wanted: list[float]) -> None:
    """Heights as close to the wanted ones as the order of the column allows (isotonic regression).

    Without their own heights, items only have to keep their order: those that would change it are
    moved together to their mean.
    """
    offsets = [0.0]
    for item in column[:-1]:
        offsets.append(offsets[-1] + item.height + ROW_GAP)
    groups: list[tuple[float, int]] = []
    for want, offset in zip(wanted, offsets, strict=False):
        total, count = want - offset, 1
        while groups and groups[-1][0] / groups[-1][1] >= total / count:
            before, number = groups.pop()
            total, count = total + before, count + number
        groups.append((total, count))
    position = 0
    for total, count in groups:
        for item, offset in zip(
            column[position : position + count], offsets[position:], strict=False
        ):
            item.y = total / count + offset
        position += count


def _settle(columns: list[list[Item]]) -> tuple[float, float]:
    """Move everything to the origin of the picture; returns its width and height."""
    items = [item for column in columns for item in column]
    top = min((item.y for item in items), default=0.0)
    for item in items:
        item.y -= top
    width = max((item.x + item.width for item in items), default=0.0)
    return width, max((item.y + item.height for item in items), default=0.0)

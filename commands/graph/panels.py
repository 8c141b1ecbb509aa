"""Draws panels: boxes with a layout of their own, and the arrows between them.

A cluster with a border has a panel for itself; all clusters without borders share one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .boxes import drawn_box, end_of, size_of, start_of
from .kinds import ArrowKind, texture_color
from .layout import laid_out
from .model import Arrow, Box, Cluster, Picture
from .shapes import (
    FAINT,
    NAME_SIZE,
    curve,
    dashed,
    rectangle,
    text,
    titled,
    width_of,
)

PADDING, TITLE = 16.0, 30.0
"""The room within a border, and the height of the title of a cluster."""
LANE = 12.0
"""The distance between the arrows to the next frame."""


def panels_of(picture: Picture) -> list[Panel]:
    """The panels of a picture, which have no places yet."""
    shared = [box for cluster in picture.clusters if not cluster.has_border
              for box in cluster.boxes]  # fmt: skip
    clusters = [cluster for cluster in picture.clusters if cluster.has_border]
    if shared:
        clusters.append(Cluster("", shared, has_border=False, is_stage=True))
    filled = [cluster for cluster in clusters if cluster.boxes]
    number = {box.key: i for i, cluster in enumerate(filled) for box in cluster.boxes}
    inner: list[list[Arrow]] = [[] for _ in filled]
    for arrow in picture.arrows:
        if number[arrow.source] == number[arrow.target]:
            inner[number[arrow.source]].append(arrow)
    return [Panel(cluster, arrows) for cluster, arrows in zip(filled, inner, strict=True)]


def arrows_between(picture: Picture, panels: Sequence[Panel]) -> Iterator[str]:
    """The arrows from one panel to another, under the boxes."""
    homes = {key: panel for panel in panels for key in panel.boxes}
    for arrow in picture.arrows:
        home, other = homes[arrow.source], homes[arrow.target]
        if home is not other:
            x, y = home.start(arrow)
            left, middle = other.end(arrow)
            path = [f"M{x:.1f} {y:.1f}", curve(x, y, left, middle, least=30.0)]
            yield _drawn_arrow(arrow, home.boxes[arrow.source], path, left, middle)


class Panel:
    """A cluster with its layout, at some place in the picture."""

    def __init__(self, cluster: Cluster, arrows: Sequence[Arrow]) -> None:
        self.boxes: dict[str, Box] = {box.key: box for box in cluster.boxes}
        self.is_stage = cluster.is_stage
        self.x = self.y = 0.0
        self._cluster = cluster
        self._back = [arrow for arrow in arrows if arrow.kind is ArrowKind.BACK]
        self._forward = [arrow for arrow in arrows if arrow.kind is not ArrowKind.BACK]
        ends = ((arrow.source, arrow.target) for arrow in self._forward)
        sizes = {key: size_of(box) for key, box in self.boxes.items()}
        self._layout = laid_out(sizes, dict.fromkeys(ends))
        self._edges: dict[int, float] = {}
        """The ends of the widest boxes of each column: before them, arrows run straight."""
        for item in self._layout.items.values():
            edge = self._edges.get(item.column, 0.0)
            self._edges[item.column] = max(edge, item.x + item.width)
        self._left, self._top = (PADDING, TITLE + PADDING) if cluster.has_border else (0.0, 0.0)
        lanes = LANE * (len(self._back) + 1) if self._back else 0.0
        inner = max(self._layout.width + lanes, width_of(cluster.title, NAME_SIZE))
        self.width = inner + 2 * self._left
        self.height = self._layout.height + LANE * len(self._back) + self._top + self._left

    @property
    def origin(self) -> tuple[float, float]:
        """The place of the layout in the picture."""
        return self.x + self._left, self.y + self._top

    def start(self, arrow: Arrow) -> tuple[float, float]:
        """The place in the picture where an arrow to another panel begins."""
        (left, top), (x, y) = self.origin, self._start(arrow)
        return left + x, top + y

    def end(self, arrow: Arrow) -> tuple[float, float]:
        """The place in the picture where an arrow from another panel ends."""
        (left, top), item = self.origin, self._layout.items[arrow.target]
        return left + item.x, top + end_of(self.boxes[arrow.target], item, arrow.row)

    def border(self) -> Iterator[str]:
        """The background and the title, in the picture."""
        if not self._cluster.has_border:
            return
        looks = 'rx="10" fill="#f0f3f6" stroke="#c3ccd5"'
        looks += dashed("" if self.is_stage else "5 4")
        yield rectangle(self.x, self.y, self.width, self.height, looks)
        title = self._cluster.title
        yield text(self.x + PADDING, self.y + 21, title, NAME_SIZE, FAINT, bold=True)

    def contents(self) -> Iterator[str]:
        """The arrows, and the boxes above them, relative to the origin."""
        for number, arrow in enumerate(self._back):
            yield self._loop(arrow, number)
        for arrow in self._forward:
            yield self._arrow(arrow)
        for key, box in self.boxes.items():
            yield drawn_box(box, self._layout.items[key])

    def _start(self, arrow: Arrow) -> tuple[float, float]:
        return start_of(self.boxes[arrow.source], self._layout.items[arrow.source], arrow.port)

    def _arrow(self, arrow: Arrow) -> str:
        """A smooth line through the places that an arrow passes."""
        first, *others = self._layout.paths[arrow.source, arrow.target]
        begin, y = self._start(arrow)
        x = self._edges[first.column]
        path = [f"M{begin:.1f} {y:.1f} H{x:.1f}"]
        for item in others:
            end = item.middle
            if item is others[-1]:
                end = end_of(self.boxes[arrow.target], item, arrow.row)
            path.append(curve(x, y, item.x, end))
            x, y = item.x, end
            if item is not others[-1]:
                x += item.width
                path.append(f"L{x:.1f} {y:.1f}")
        return _drawn_arrow(arrow, self.boxes[arrow.source], path, x, y)

    def _loop(self, arrow: Arrow, number: int) -> str:
        """An arrow back to the left, below all boxes: to the contents that the next frame finds."""
        source, target = self._layout.items[arrow.source], self._layout.items[arrow.target]
        (begin, start), end = self._start(arrow), target.middle
        right = self._edges[source.column] + 8 + 5 * number
        left = target.x - 14 - 5 * number
        below = self._layout.height + LANE * (number + 1)
        path = [
            f"M{begin:.1f} {start:.1f} H{right - 6:.1f} q6 0 6 6 V{below - 6:.1f} q0 6 -6 6",
            f"H{left + 6:.1f} q-6 0 -6 -6 V{end + 6:.1f} q0 -6 6 -6 H{target.x:.1f}",
        ]
        return _drawn_arrow(arrow, self.boxes[arrow.source], path, target.x, end)


def _drawn_arrow(arrow: Arrow, source: Box, path: Sequence[str], x: float, y: float) -> str:
    """A line along a path, with the head of an arrow at its end, in the colour of its kind, of
    the texture that is passed on, or of the box where it begins."""
    kind = arrow.kind
    textures = [port.texture for port in source.ports if port.key == arrow.port]
    color = kind.color or (texture_color(textures[0]) if textures else source.kind.line)
    head = f"M{x - 6:.1f} {y - 3:.1f} L{x:.1f} {y:.1f} L{x - 6:.1f} {y + 3:.1f}"
    line = f'fill="none" stroke="{color}" stroke-width="{kind.width}"'
    shape = f'<path d="{" ".join(path)} {head}" {line}/>'
    if not kind.words:
        return shape
    words = f"{arrow.port or arrow.source}: {kind.words}"
    return titled(words, shape, looks=dashed(kind.dash))

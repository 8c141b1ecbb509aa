"""Writes the graph of a frame as an SVG picture: steps and arrows, and a time line below them."""

from __future__ import annotations

from collections.abc import Iterator

from ..layout import Item, Layout, laid_out
from ..shapes import (
    FAINT,
    INK,
    NAME_SIZE,
    TEXT_SIZE,
    Colors,
    begun,
    cut,
    escaped,
    stroke,
    text,
    width_of,
)
from .lanes import drawn_lanes
from .legend import legend
from .looks import ARROWS, COLORS, ONCE, texture_color
from .model import STEPS, Arrow, Box, FramePicture, Port

MARGIN = 24.0
HEAD, LINE, ROW = 25.0, 14.0, 19.0
"""The heights of a box's name, of a line below it, and of the row of a result."""
STACK = 4.0
"""The distance by which the boxes behind a repeated step stand out."""
LANE = 12.0
"""The distance between the arrows to the next frame."""
NARROWEST = 620.0


def drawn(picture: FramePicture) -> str:
    """The whole picture."""
    flow = _Flow(picture)
    top = MARGIN + 46
    lanes, lanes_width, lanes_height = drawn_lanes(picture)
    lanes_top = top + flow.height + 34
    width = max(flow.width, lanes_width, NARROWEST) + 2 * MARGIN
    key = list(legend(picture, width - 2 * MARGIN))
    key_top = lanes_top + lanes_height + 30
    height = key_top + max(y for _, _, y in key) + 2 * MARGIN
    facts = f"{len(picture.columns)} steps · {picture.shared}"
    heading = f"{picture.doc.splitlines()[0]} · {facts}" if picture.doc else facts
    lines = [
        *begun(picture.title, width, height),
        text(MARGIN, MARGIN + 10, picture.title, 16, INK, bold=True),
        text(MARGIN, MARGIN + 30, cut(heading, int(width / (TEXT_SIZE * 0.62)) - 8), TEXT_SIZE,
             FAINT),
        *_moved(flow.shapes(), MARGIN, top),
        *_moved(lanes, MARGIN, lanes_top),
    ]  # fmt: skip
    for piece, x, y in key:
        lines += _moved([piece], x + MARGIN, y + key_top)
    return "\n".join([*lines, "</svg>"]) + "\n"


def _moved(shapes: Iterator[str] | list[str], x: float, y: float) -> Iterator[str]:
    yield f'<g transform="translate({x:.1f} {y:.1f})">'
    yield from shapes
    yield "</g>"


class _Flow:
    """The steps, and the host's inputs and outputs, from left to right."""

    def __init__(self, picture: FramePicture) -> None:
        self._picture = picture
        self._boxes = {box.key: box for box in picture.boxes}
        self._back = [arrow for arrow in picture.arrows if arrow.kind == "back"]
        forward = [(a.source, a.target) for a in picture.arrows if a.kind != "back"]
        sizes = {box.key: _size(box) for box in picture.boxes}
        self._layout: Layout = laid_out(sizes, dict.fromkeys(forward))
        self._edges: dict[int, float] = {}
        """The ends of the widest boxes of each column: before them, arrows run straight."""
        for item in self._layout.items.values():
            edge = self._edges.get(item.column, 0.0)
            self._edges[item.column] = max(edge, item.x + item.width)
        self.width = self._layout.width + LANE * (len(self._back) + 1)
        self.height = self._layout.height + LANE * len(self._back)

    def shapes(self) -> Iterator[str]:
        """The arrows, and the boxes above them."""
        for number, arrow in enumerate(self._back):
            yield self._loop(arrow, number)
        for arrow in self._picture.arrows:
            if arrow.kind != "back":
                yield self._arrow(arrow)
        for box in self._picture.boxes:
            yield from _box(box, self._layout.items[box.key])

    def _start(self, arrow: Arrow) -> float:
        """The height at which an arrow begins: that of a row of its box."""
        item, box = self._layout.items[arrow.source], self._boxes[arrow.source]
        for number, port in enumerate(box.ports):
            if port.key == arrow.port:
                return item.y + _head(box) + ROW * (number + 0.5)
        return item.middle

    def _color(self, arrow: Arrow) -> str:
        for port in self._boxes[arrow.source].ports:
            if port.key == arrow.port:
                return texture_color(port.texture)
        return COLORS[self._boxes[arrow.source].kind].line

    def _arrow(self, arrow: Arrow) -> str:
        first, *others = self._layout.paths[arrow.source, arrow.target]
        begin, y = first.x + _inner(self._boxes[arrow.source], first), self._start(arrow)
        x = self._edges[first.column]
        path = [f"M{begin:.1f} {y:.1f} H{x:.1f}"]
        for item in others:
            bend = (item.x - x) / 2
            path.append(
                f"C{x + bend:.1f} {y:.1f} {item.x - bend:.1f} {item.middle:.1f} "
                f"{item.x:.1f} {item.middle:.1f}"
            )
            x, y = item.x, item.middle
            if item is not others[-1]:
                x += item.width
                path.append(f"L{x:.1f} {y:.1f}")
        look = ARROWS[arrow.kind]
        words = f"{arrow.port or arrow.source}: {look.words}"
        return _titled(stroke(path, x, y, self._color(arrow), look.width), words, look.dash)

    def _loop(self, arrow: Arrow, number: int) -> str:
        """An arrow back to the left, below all boxes: to the contents that the next frame finds."""
        source, target = self._layout.items[arrow.source], self._layout.items[arrow.target]
        start, end = self._start(arrow), target.middle
        right = self._edges[source.column] + 8 + 5 * number
        left = target.x - 14 - 5 * number
        below = self._layout.height + LANE * (number + 1)
        begin = source.x + _inner(self._boxes[arrow.source], source)
        path = [
            f"M{begin:.1f} {start:.1f} H{right - 6:.1f} q6 0 6 6 V{below - 6:.1f} q0 6 -6 6",
            f"H{left + 6:.1f} q-6 0 -6 -6 V{end + 6:.1f} q0 -6 6 -6 H{target.x:.1f}",
        ]
        look = ARROWS["back"]
        shape = stroke(path, target.x, end, self._color(arrow), look.width)
        return _titled(shape, f"{arrow.port}: {look.words}", look.dash)


def _titled(shape: str, words: str, dash: str) -> str:
    dashed = f' stroke-dasharray="{dash}"' if dash else ""
    return f"<g{dashed}><title>{escaped(words)}</title>{shape}</g>"


def _inner(box: Box, item: Item) -> float:
    """The width of a box without those that stand out behind it."""
    return item.width - (2 * STACK if box.repeated else 0.0)


def _lines(box: Box) -> list[str]:
    """The lines below a box's name."""
    found = [cut(line) for line in box.lines]
    if box.repeated:
        found.append(f"× {box.repeated}")
    if box.only_first:
        found.append("first frame only")
    return found


def _head(box: Box) -> float:
    """The height of a box above the rows of its results."""
    return HEAD + LINE * len(_lines(box)) + (6 if box.ports else 2)


def _size(box: Box) -> tuple[float, float]:
    widths = [width_of(cut(box.name), NAME_SIZE)]
    widths += [width_of(line, TEXT_SIZE) for line in _lines(box)]
    widths += [width_of(_row(port), TEXT_SIZE) + 17 for port in box.ports]
    stack = 2 * STACK if box.repeated else 0.0
    height = _head(box) + ROW * len(box.ports) + (5 if box.ports else 4)
    return max(widths) + 20 + stack, height + stack


def _row(port: Port) -> str:
    dropped = " · dropped" if port.mark == "dropped" else ""
    return f"{port.name}: {port.what}{dropped}"


def _box(box: Box, item: Item) -> Iterator[str]:
    colors = COLORS[box.kind]
    is_step = box.kind in STEPS
    stack = 2 * STACK if box.repeated else 0.0
    width, height = item.width - stack, item.height - stack
    dash = f' stroke-dasharray="{ONCE}"' if box.only_first or box.kind == "previous" else ""
    corner = 6.0 if is_step else min(height / 2, 14.0)
    yield "<g>"
    yield f"<title>{escaped(_tooltip(box))}</title>"
    for behind in (2 * STACK, STACK) if stack else ():
        yield _rectangle(item.x + behind, item.y + behind, width, height, corner, colors, dash)
    yield _rectangle(item.x, item.y, width, height, corner, colors, dash)
    ink = "#ffffff" if colors.is_dark else INK
    yield text(item.x + 10, item.y + 18, cut(box.name), NAME_SIZE, ink, bold=True)
    for number, line in enumerate(_lines(box)):
        faint = "#dfe6ec" if colors.is_dark else FAINT
        yield text(item.x + 10, item.y + HEAD + 8 + LINE * number, line, TEXT_SIZE, faint)
    if box.ports:
        yield from _ports(box, item, width)
    yield "</g>"


def _rectangle(
    x: float, y: float, width: float, height: float, corner: float, colors: Colors, dash: str
) -> str:
    return (
        f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" '
        f'rx="{corner:.1f}" fill="{colors.fill}" stroke="{colors.line}" stroke-width="1.1"{dash}/>'
    )


def _ports(box: Box, item: Item, width: float) -> Iterator[str]:
    """The results of a step: one row each, with the colour of its texture."""
    top = item.y + _head(box)
    yield (
        f'<rect x="{item.x + 1:.1f}" y="{top - 1:.1f}" width="{width - 2:.1f}" '
        f'height="{ROW * len(box.ports) + 4:.1f}" rx="4" fill="#ffffff"/>'
    )
    for number, port in enumerate(box.ports):
        y, color = top + ROW * number, texture_color(port.texture)
        faint = port.mark == "dropped"
        yield (
            f'<rect x="{item.x + 10:.1f}" y="{y + 5:.1f}" width="10" height="10" rx="2" '
            f'fill="{"none" if faint else color}" stroke="{color}"/>'
        )
        yield text(item.x + 27, y + 14, _row(port), TEXT_SIZE, "#8b97a3" if faint else INK)


def _tooltip(box: Box) -> str:
    rows = [f"{port.key} in texture #{port.texture}" if port.texture is not None else port.key
            for port in box.ports]  # fmt: skip
    return "\n".join([box.name, *box.lines, *filter(None, [box.repeated]), *box.notes, *rows])

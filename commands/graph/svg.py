"""Writes the graph as an SVG picture for any browser, with our own layout."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .layout import Item, Layout, laid_out
from .model import KINDS, Box, Cluster, Kind, Picture
from .shapes import (
    ADVANCE,
    INK,
    NAME_SIZE,
    TEXT_SIZE,
    Colors,
    arrow,
    begun,
    cut,
    escaped,
    stroke,
    text,
)

MARGIN, PADDING, TITLE = 24.0, 16.0, 30.0

COLORS: dict[Kind, Colors] = {
    "attribute": Colors("#e6f0d8", "#6b8f3a"),
    "input": Colors("#eef3e6", "#8aa36b"),
    "texture": Colors("#d8efe6", "#2f8f6b"),
    "buffer": Colors("#d5ecf0", "#23808f"),
    "frame": Colors("#f3e6f5", "#9a5ba6"),
    "view": Colors("#e9e3f8", "#6f58b5"),
    "rig": Colors("#fdf0cf", "#b98a14"),
    "material": Colors("#fde3d3", "#c2622a"),
    "draw": Colors("#e3e9f8", "#4a68b0"),
    "group": Colors("#f0e8e0", "#8c7458"),
    "derived": Colors("#f7f3df", "#8f7f2a"),
    "value": Colors("#ffffff", "#5b6570"),
    "loop": Colors("#e2f1f8", "#2b7da3"),
    "call": Colors("#efe9fb", "#7a55c7"),
    "crossing": Colors("#dff3f1", "#12857a"),
    "argument": Colors("#f1f1f1", "#8a8a8a"),
    "result": Colors("#34404c", "#1d252d", is_dark=True),
}
GUARD = "#d1570b"
_FAULTLESS, _FAULTY = (0xFF, 0xFF, 0xFF), (0xE8, 0x4A, 0x35)
"""The fills of boxes without any part in a pixel's error, and of boxes that make all of it."""


def colors_of(box: Box) -> Colors:
    """The colours of a box: of its kind, or if there is a pixel, of its part in the error."""
    if box.part is None:
        return COLORS[box.kind]
    return Colors(_shade(box.part), COLORS[box.kind].line)


def _shade(part: float) -> str:
    """The fill for a part of the error: by its root, so that small parts can be seen, too."""
    share = min(part, 1.0) ** 0.5
    pairs = zip(_FAULTLESS, _FAULTY, strict=True)
    return "#" + "".join(f"{round(a + share * (b - a)):02x}" for a, b in pairs)


def drawn(picture: Picture) -> str:
    """The whole picture: the host and the stages from left to right, functions and loops below."""
    panels = [_Panel(cluster) for cluster in picture.clusters if cluster.boxes]
    width = _arrange(panels)
    legend = list(_legend(picture, max(width, 560.0)))
    bottom = max((panel.y + panel.height for panel in panels), default=0.0) + MARGIN
    height = bottom + max((y for _, _, y in legend), default=0.0) + 2 * MARGIN
    width = max(width, 560.0) + MARGIN
    lines = [
        *begun(picture.title, width, height),
        text(MARGIN, MARGIN + 10, picture.title, 16, INK, bold=True),
    ]
    for panel in panels:
        lines += panel.background()
    lines += _between(picture, panels)
    for panel in panels:
        lines += panel.contents()
    for piece, x, y in legend:
        lines.append(f'<g transform="translate({x + MARGIN:.1f} {y + bottom:.1f})">{piece}</g>')
    return "\n".join([*lines, "</svg>"]) + "\n"


def _arrange(panels: Sequence[_Panel]) -> float:
    """Put stages in a row, and functions and loops below, in rows of about the same width."""
    top, right = MARGIN + 28, MARGIN
    row = [panel for panel in panels if panel.is_stage]
    for panel in row:
        panel.x, panel.y = right, top
        right += panel.width + 40
    whole = max((panel.x + panel.width for panel in panels if panel.is_stage), default=MARGIN)
    x, y = MARGIN, top + max((panel.height for panel in row), default=0.0) + 28
    tallest = 0.0
    for panel in panels:
        if panel.is_stage:
            continue
        if x > MARGIN and x + panel.width > max(whole, 900.0):
            x, y, tallest = MARGIN, y + tallest + 28, 0.0
        panel.x, panel.y = x, y
        x, tallest = x + panel.width + 28, max(tallest, panel.height)
        whole = max(whole, panel.x + panel.width)
    return whole


class _Panel:
    """A cluster with its layout, at some place in the picture."""

    def __init__(self, cluster: Cluster) -> None:
        self.cluster = cluster
        self.x = self.y = 0.0
        sizes = {box.key: _size(box) for box in cluster.boxes}
        self.layout: Layout = laid_out(sizes, cluster.edges)
        title = len(cluster.title) * NAME_SIZE * ADVANCE
        self.width = max(self.layout.width, title) + 2 * PADDING
        self.height = self.layout.height + TITLE + 2 * PADDING

    @property
    def is_stage(self) -> bool:
        """True for the host or a stage; false for a function or loop."""
        return self.cluster.is_stage

    def place(self, key: str) -> tuple[float, float, Item] | None:
        """The position of a box's upper left corner in the picture."""
        item = self.layout.items.get(key)
        if item is None:
            return None
        return self.x + PADDING + item.x, self.y + TITLE + PADDING + item.y, item

    def background(self) -> Iterator[str]:
        dash = "" if self.is_stage else ' stroke-dasharray="5 4"'
        yield (
            f'<rect x="{self.x:.1f}" y="{self.y:.1f}" width="{self.width:.1f}" '
            f'height="{self.height:.1f}" rx="10" fill="#f0f3f6" stroke="#c3ccd5"{dash}/>'
        )
        yield text(
            self.x + PADDING, self.y + 21, self.cluster.title, NAME_SIZE, "#46525e", bold=True
        )

    def contents(self) -> Iterator[str]:
        """The arrows, and the boxes above them."""
        left, top = self.x + PADDING, self.y + TITLE + PADDING
        for path in self.layout.paths.values():
            yield arrow([(item, left + item.x, top + item.middle) for item in path])
        for box in self.cluster.boxes:
            item = self.layout.items[box.key]
            yield from _box(box, left + item.x, top + item.y, item)


def _size(box: Box) -> tuple[float, float]:
    lines = _lines(box)
    widths = [len(lines[0]) * NAME_SIZE, *(len(line) * TEXT_SIZE for line in lines[1:])]
    guard = 16.0 if box.guarded else 0.0
    return max(widths) * ADVANCE + 18 + guard, 8 + 17 + 14.0 * (len(lines) - 1) + 6


def _lines(box: Box) -> list[str]:
    """The lines of a box: its name and type, its formula, its kind."""
    lines = [cut(f"{box.name}: {box.type}")]
    if box.formula and box.formula != box.name:
        lines.append(cut(box.formula))
    if box.note and box.kind in ("derived", "crossing") and box.formula == "":
        lines.append(box.note)
    return lines


def _box(box: Box, x: float, y: float, item: Item) -> Iterator[str]:
    colors = colors_of(box)
    leaf = not box.formula and box.kind != "crossing"
    dash = ' stroke-dasharray="4 3"' if box.kind == "derived" else ""
    dark = colors.is_dark
    yield "<g>"
    yield f"<title>{escaped(_tooltip(box))}</title>"
    yield (
        f'<rect x="{x:.1f}" y="{y:.1f}" width="{item.width:.1f}" height="{item.height:.1f}" '
        f'rx="{item.height / 2 if leaf else 5:.1f}" fill="{colors.fill}" '
        f'stroke="{GUARD if box.guarded else colors.line}" '
        f'stroke-width="{1.8 if box.guarded else 1.1}"{dash}/>'
    )
    name, *others = _lines(box)
    yield text(x + 9, y + 19, name, NAME_SIZE, "#ffffff" if dark else "#1d252d", bold=True)
    for number, line in enumerate(others):
        yield text(x + 9, y + 35 + 14 * number, line, TEXT_SIZE, "#dfe6ec" if dark else "#46525e")
    if box.guarded:
        yield _shield(x + item.width - 17, y + 6)
    yield "</g>"


def _tooltip(box: Box) -> str:
    lines = [f"{box.name} : {box.type}", box.formula, box.note or KINDS[box.kind]]
    lines += [f"{box.part:.1%} of the error" if box.part else ""]
    lines += ["a guard stays in it" if box.guarded else "", box.place]
    return "\n".join(filter(None, lines))


def _shield(x: float, y: float) -> str:
    shape = "l5 -1.8 l5 1.8 v5 c0 3 -2.4 5 -5 6.2 c-2.6 -1.2 -5 -3.2 -5 -6.2 z"
    return f'<path d="M{x:.1f} {y + 1.5:.1f} {shape}" fill="{GUARD}"/>'


def _between(picture: Picture, panels: Sequence[_Panel]) -> Iterator[str]:
    """The arrows from one stage to another, under the boxes."""
    for source, target in picture.crossings:
        start = next((place for panel in panels if (place := panel.place(source))), None)
        end = next((place for panel in panels if (place := panel.place(target))), None)
        if start is None or end is None:
            continue
        x, y = start[0] + start[2].width, start[1] + start[2].height / 2
        left, middle = end[0], end[1] + end[2].height / 2
        bend = max(30.0, (left - x) / 2)
        curve = f"C{x + bend:.1f} {y:.1f} {left - bend:.1f} {middle:.1f} {left:.1f} {middle:.1f}"
        yield stroke([f"M{x:.1f} {y:.1f}", curve], left, middle, "#12857a", 1.6)


def _legend(picture: Picture, width: float) -> Iterator[tuple[str, float, float]]:
    """The legend: the kinds of boxes in the picture, in rows, each with its position."""
    used = {box.kind for box in picture.boxes}
    entries = [(COLORS[kind], words) for kind, words in KINDS.items() if kind in used]
    if any(box.part is not None for box in picture.boxes):
        rims = [(Colors("#ffffff", colors.line), words) for colors, words in entries]
        shades = ((0.01, "1% of the error"), (0.25, "25%"), (1.0, "all of it"))
        entries = [*rims, *((Colors(_shade(part), "#8a8a8a"), words) for part, words in shades)]
    if any(box.guarded for box in picture.boxes):
        entries.append((Colors("", ""), "a guard stays"))
    x = y = 0.0
    for colors, words in entries:
        length = len(words) * TEXT_SIZE * ADVANCE + 44
        if x and x + length > width:
            x, y = 0.0, y + 22
        swatch = (
            f'<rect width="22" height="13" rx="4" fill="{colors.fill}" stroke="{colors.line}"/>'
            if colors.fill
            else _shield(6, 0)
        )
        yield swatch + text(29, 11, words, TEXT_SIZE, "#46525e"), x, y
        x += length

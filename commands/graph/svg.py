"""Writes a picture as SVG for any browser, with our own layout."""

from __future__ import annotations

from collections.abc import Sequence

from .lanes import Lanes
from .legend import legend
from .model import Picture
from .panels import Panel, arrows_between, panels_of
from .shapes import ADVANCE, FAINT, INK, TEXT_SIZE, begun, cut, moved, text

MARGIN = 24.0
STAGES, PARTS, ROWS = 40.0, 28.0, 28.0
"""The gaps between stages, between functions and loops, and between rows of them."""
NARROWEST = 620.0
"""The width that the legend has at least."""


def drawn(picture: Picture) -> str:
    """The whole picture, from top to bottom: the title, the panels, the time line, the legend."""
    heading = _heading(picture)
    panels = panels_of(picture)
    width, bottom = _arrange(panels, MARGIN + (46 if heading else 28))
    shapes = [line for panel in panels for line in panel.border()]
    shapes += arrows_between(picture, panels)
    for panel in panels:
        shapes += moved(panel.contents(), *panel.origin)
    if picture.time_line is not None:
        lanes, top = Lanes(picture.time_line), bottom + 34
        shapes += moved(lanes.shapes(), MARGIN, top)
        width, bottom = max(width, lanes.width), top + lanes.height
    width = max(width, NARROWEST) + 2 * MARGIN
    last = 0.0
    for piece, x, y in legend(picture, width - 2 * MARGIN):
        shapes += moved([piece], x + MARGIN, y + bottom + 30)
        last = y
    longest = int(width / (TEXT_SIZE * ADVANCE)) - 8
    lines = [
        *begun(picture.title, width, bottom + 30 + last + 2 * MARGIN),
        text(MARGIN, MARGIN + 10, picture.title, 16, INK, bold=True),
        *([text(MARGIN, MARGIN + 30, cut(heading, longest), TEXT_SIZE, FAINT)] if heading else []),
        *shapes,
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def _heading(picture: Picture) -> str:
    """The line below the title: the first line of the documentation, and facts of a frame."""
    line = picture.time_line
    facts = [] if line is None else [f"{len(line.columns)} steps", line.shared]
    return " · ".join([*picture.doc.splitlines()[:1], *facts])


def _arrange(panels: Sequence[Panel], top: float) -> tuple[float, float]:
    """Put stages in a row, and functions and loops below, in rows of about the same width.

    Returns the width without margins, and the lower end.
    """
    x = MARGIN
    stages = [panel for panel in panels if panel.is_stage]
    for panel in stages:
        panel.x, panel.y = x, top
        x += panel.width + STAGES
    bottom = max((panel.height for panel in stages), default=0.0) + top
    widest = max(x - STAGES, 900.0)
    x, y = MARGIN, bottom + ROWS
    for panel in panels:
        if panel.is_stage:
            continue
        if x > MARGIN and x + panel.width > widest:
            x, y = MARGIN, bottom + ROWS
        panel.x, panel.y = x, y
        x += panel.width + PARTS
        bottom = max(bottom, y + panel.height)
        widest = max(widest, panel.x + panel.width)
    return max((panel.x + panel.width for panel in panels), default=MARGIN) - MARGIN, bottom

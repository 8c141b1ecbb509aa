"""The shapes of SVG pictures; ``svg.py`` and ``frame/svg.py`` draw with them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from typing import NamedTuple

from ...compiler.diagnostics.display import harmless_lines
from .layout import Item

NAME_SIZE, TEXT_SIZE = 13.0, 11.0
ADVANCE = 0.62
"""The width of a letter of a fixed-width font, relative to its size, and a little more."""
LONGEST = 42
"""The most letters on a line of a box."""
INK, FAINT, PAPER = "#1d252d", "#46525e", "#fafbfc"


class Colors(NamedTuple):
    """The colours of a box."""

    fill: str
    line: str
    is_dark: bool = False
    """True if letters on this colour have to be white."""


def escaped(words: str) -> str:
    """A text escaped for XML, which has no control characters."""
    return escape(harmless_lines(words))


def begun(title: str, width: float, height: float) -> Iterator[str]:
    """The beginning of a picture, up to its background; ``</svg>`` ends it."""
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
        f'width="{width:.0f}" height="{height:.0f}" font-family="ui-monospace, Menlo, Consolas, '
        "'DejaVu Sans Mono', monospace\">"
    )
    yield f"<title>{escaped(title)}</title>"
    yield f'<rect width="{width:.0f}" height="{height:.0f}" fill="{PAPER}"/>'


def width_of(words: str, size: float) -> float:
    """The width of a text."""
    return len(words) * size * ADVANCE


def cut(words: str, longest: int = LONGEST) -> str:
    """A text, shortened if it is too long."""
    return words if len(words) <= longest else words[: longest - 1] + "…"


def arrow(points: Sequence[tuple[Item, float, float]]) -> str:
    """A smooth line through the places that an arrow passes, each with its left edge and height."""
    first, x, y = points[0]
    x += first.width
    path = [f"M{x:.1f} {y:.1f}"]
    for item, left, middle in points[1:]:
        bend = (left - x) / 2
        path.append(
            f"C{x + bend:.1f} {y:.1f} {left - bend:.1f} {middle:.1f} {left:.1f} {middle:.1f}"
        )
        x, y = left, middle
        if item is not points[-1][0]:
            x += item.width
            path.append(f"L{x:.1f} {y:.1f}")
    return stroke(path, x, y, "#8b97a3")


def stroke(path: Sequence[str], x: float, y: float, color: str, width: float = 1.1) -> str:
    """A line along a path, with the head of an arrow at its end."""
    head = f"M{x - 6:.1f} {y - 3:.1f} L{x:.1f} {y:.1f} L{x - 6:.1f} {y + 3:.1f}"
    return (
        f'<path d="{" ".join(path)} {head}" fill="none" stroke="{color}" stroke-width="{width}"/>'
    )


def text(x: float, y: float, words: str, size: float, color: str, *, bold: bool = False) -> str:
    """A line of text; ``y`` is the baseline."""
    weight = ' font-weight="600"' if bold else ""
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size:g}" fill="{color}"{weight} '
        f'xml:space="preserve">{escaped(words)}</text>'
    )

"""The shapes of SVG pictures, of which ``svg.py`` and the modules that it calls draw."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from html import escape

from ...compiler.diagnostics.display import harmless_lines

NAME_SIZE, TEXT_SIZE = 13.0, 11.0
ADVANCE = 0.62
"""The width of a letter of a fixed-width font, relative to its size, and a little more."""
LONGEST = 42
"""The most letters on a line of a box."""
INK, FAINT, PAPER = "#1d252d", "#46525e", "#fafbfc"
WHITE, FAINT_ON_DARK = "#ffffff", "#dfe6ec"
ONCE = "4 3"
"""The dashes around things that were made before, or that are not in every frame."""


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


def curve(x: float, y: float, left: float, middle: float, least: float = 0.0) -> str:
    """A part of a path: a smooth line to the right, which begins and ends level."""
    bend = max(least, (left - x) / 2)
    return f"C{x + bend:.1f} {y:.1f} {left - bend:.1f} {middle:.1f} {left:.1f} {middle:.1f}"


def rectangle(x: float, y: float, width: float, height: float, looks: str) -> str:
    """A rectangle; ``looks`` are its other attributes."""
    return f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" {looks}/>'


def dashed(dash: str) -> str:
    """The attribute for the dashes of a line; empty without any."""
    return f' stroke-dasharray="{dash}"' if dash else ""


def titled(words: str, *shapes: str, looks: str = "") -> str:
    """Shapes that show words if one points at them."""
    return f"<g{looks}><title>{escaped(words)}</title>{''.join(shapes)}</g>"


def moved(shapes: Iterable[str], x: float, y: float) -> Iterator[str]:
    """Shapes at another place."""
    yield f'<g transform="translate({x:.1f} {y:.1f})">'
    yield from shapes
    yield "</g>"


def text(x: float, y: float, words: str, size: float, color: str, *, bold: bool = False) -> str:
    """A line of text; ``y`` is the baseline."""
    weight = ' font-weight="600"' if bold else ""
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size:g}" fill="{color}"{weight} '
        f'xml:space="preserve">{escaped(words)}</text>'
    )

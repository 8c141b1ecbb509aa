"""Colours and kinds of lines of a frame's picture."""

from __future__ import annotations

from typing import NamedTuple

from ..shapes import Colors
from .model import ArrowKind, Kind

COLORS: dict[Kind, Colors] = {
    "models": Colors("#fde3d3", "#c2622a"),
    "texture": Colors("#d8efe6", "#2f8f6b"),
    "buffer": Colors("#d5ecf0", "#23808f"),
    "light": Colors("#fdf0cf", "#b98a14"),
    "parameter": Colors("#f3e6f5", "#9a5ba6"),
    "previous": Colors("#ffffff", "#5b6570"),
    "draw": Colors("#e3e9f8", "#4a68b0"),
    "run": Colors("#d9eef2", "#23808f"),
    "copy": Colors("#ececec", "#8a8a8a"),
    "output": Colors("#34404c", "#1d252d", is_dark=True),
}
TEXTURES = (
    "#4e79a7", "#f28e2b", "#59a14f", "#b07aa1", "#e15759", "#3d9a94", "#c9a227", "#9c755f",
    "#d37295", "#6b7fd7", "#7f8c3a", "#5b6570",
)  # fmt: skip
"""The colours of textures; they repeat if there are more textures."""
BUFFER = "#23808f"
ONCE = "4 3"
"""The dashes around things that do not exist in every frame."""


class Look(NamedTuple):
    """The colour and the line of an arrow."""

    words: str
    width: float
    dash: str = ""


ARROWS: dict[ArrowKind, Look] = {
    "given": Look("given by the host", 1.0),
    "read": Look("read", 1.5),
    "over": Look("drawn over", 3.0),
    "initial": Look("read in the first frame only", 1.5, "2 3"),
    "back": Look("read in the next frame", 1.5, "6 3"),
}


def texture_color(number: int | None) -> str:
    """The colour of a texture, or of a buffer."""
    return BUFFER if number is None else TEXTURES[number % len(TEXTURES)]

"""Sizes that a frame's textures can have, and the parts of them that a step can draw to.

The compiler checks those that it knows, and ``sizes.py`` and ``settings.py`` of
``targets/runner/frames`` all others, once their values are set.
"""

from __future__ import annotations

Area = tuple[int, int, int, int]
"""A part of a picture: left, top, width and height."""
Sides = tuple[int, int]
"""A width and a height."""

LARGEST_SIDE = 1 << 14
"""The largest side of a texture that devices of today can have."""


def halved(side: int, times: int) -> int:
    """A side of a texture in one of its mip levels."""
    return max(side >> times, 1)


def misfit(dimension: str, levels: int, width: int, height: int) -> str:
    """The reason why no texture of a dimension and of so many mip levels has this size.

    It is empty if one has.
    """
    if not 1 <= min(width, height) <= max(width, height) <= LARGEST_SIDE:
        return f"the size would be {width} x {height}, and a side has 1 to {LARGEST_SIDE} texels"
    if dimension == "cube" and width != height:
        return f"the faces of a cube are squares, and not {width} x {height}"
    most = max(width, height).bit_length()
    if levels > most:
        return f"there are {levels} mip levels, and {width} x {height} texels have {most}"
    return ""


def outside(viewport: Area, size: Sides | None) -> str:
    """The reason why a viewport is not within targets of a size; empty if it is.

    The size may be unknown.
    """
    left, top, width, height = viewport
    if min(left, top) < 0 or min(width, height) < 1:
        is_inside = False
    else:
        is_inside = size is None or (left + width <= size[0] and top + height <= size[1])
    return "" if is_inside else f"{_part(viewport)} is not within {_targets(size)}"


def hidden(scissor: Area, size: Sides | None) -> str:
    """The reason why a scissor leaves nothing of targets; empty if it leaves something.

    The size of the targets may be unknown.
    """
    left, top, width, height = scissor
    is_seen = min(width, height) > 0 and left + width > 0 and top + height > 0
    if size is not None:
        is_seen = is_seen and left < size[0] and top < size[1]
    return "" if is_seen else f"{_part(scissor)} contains nothing of {_targets(size)}"


def _part(area: Area) -> str:
    left, top, width, height = area
    return f"{width} x {height} texels at {left}, {top}"


def _targets(size: Sides | None) -> str:
    return "its targets" if size is None else f"targets of {size[0]} x {size[1]} texels"

"""Sizes that a frame's textures can have.

The compiler checks those that it knows, and ``targets/runner/frames/sizes.py`` all others, once
their values are set.
"""

from __future__ import annotations

LARGEST_SIDE = 1 << 14
"""Of a texture: what devices of today can have."""


def halved(side: int, times: int) -> int:
    """A side of a texture in one of its mip levels."""
    return max(side >> times, 1)


def misfit(dimension: str, levels: int, width: int, height: int) -> str:
    """Why no texture of a dimension and of so many mip levels has this size; empty if one has."""
    if not 1 <= min(width, height) <= max(width, height) <= LARGEST_SIDE:
        return f"the size would be {width} x {height}, and a side has 1 to {LARGEST_SIDE} texels"
    if dimension == "cube" and width != height:
        return f"the faces of a cube are squares, and not {width} x {height}"
    most = max(width, height).bit_length()
    if levels > most:
        return f"there are {levels} mip levels, and {width} x {height} texels have {most}"
    return ""

"""Checks the sizes of a frame's textures, which are known only when all values are set.

``FrameHost`` calls it before anything is drawn to a texture, whichever route draws.
"""

from __future__ import annotations

from collections.abc import Mapping

from .checks.rows import PlanError, Row, attachments, fail, step_name

LARGEST_SIDE = 1 << 14
"""Of a texture: what devices of today can have."""

Size = tuple[int, int]


def halved(side: int, times: int) -> int:
    """A side of a texture in one of its mip levels."""
    return max(side >> times, 1)


def checked_size(texture: Row, width: int, height: int) -> Size:
    """The size of a texture's first level; its row says how often the size is halved. Raises
    ``PlanError`` for sizes that no texture of its kind can have."""
    names, shown = ", ".join(texture["results"]), f"{width} x {height}"
    if not 1 <= min(width, height) <= max(width, height) <= LARGEST_SIDE:
        raise PlanError(
            f"{names}: the size would be {shown}, and a side has 1 to {LARGEST_SIDE} texels"
        )
    level = texture["size"]["level"]
    width, height = halved(width, level), halved(height, level)
    if texture["dimension"] == "cube" and width != height:
        raise PlanError(f"{names}: the faces of a cube are squares, and not {width} x {height}")
    most = max(width, height).bit_length()
    if texture["levels"] > most:
        raise PlanError(
            f"{names}: there are {texture['levels']} mip levels, and {width} x {height} texels "
            f"have {most}"
        )
    return width, height


def drawn_size(plan: Row, step: Row, sizes: Mapping[int, Size]) -> Size:
    """How large all is that a step draws to; ``sizes`` are those of textures. Raises ``PlanError``
    where its targets differ."""
    found: dict[Size, str] = {}
    for row in attachments(step):
        width, height = sizes[row["texture"]]
        found[halved(width, row["level"]), halved(height, row["level"])] = row["result"]
    if len(found) > 1:
        each = " and ".join(f"`{name}` with {w} x {h}" for (w, h), name in found.items())
        fail(plan, step_name(step), f"it draws to {each} texels: all have to have one size")
    return next(iter(found))

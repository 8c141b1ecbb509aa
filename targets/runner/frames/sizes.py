"""Checks the sizes of a frame's textures, which are known only when all values are set.

``FrameHost`` calls it before anything is drawn to a texture, whichever route draws.
"""

from __future__ import annotations

from collections.abc import Mapping

from ....compiler.documents.plan import FramePlan, FrameTextureRow, PlanStep
from ....compiler.ir.image_sizes import halved, misfit
from .checks.rows import PlanError, fail

Size = tuple[int, int]


def checked_size(texture: FrameTextureRow, width: int, height: int) -> Size:
    """The size of a texture's first level; its row says how often the size is halved. Raises
    ``PlanError`` for sizes that no texture of its kind can have."""
    names = ", ".join(texture.results)
    level, dimension, levels = texture.size.level, texture.dimension, texture.levels
    if reason := misfit("2d", 1, width, height):
        raise PlanError(f"{names}: {reason}")
    width, height = halved(width, level), halved(height, level)
    if reason := misfit(dimension, levels, width, height):
        raise PlanError(f"{names}: {reason}")
    return width, height


def drawn_size(plan: FramePlan, step: PlanStep, sizes: Mapping[int, Size]) -> Size:
    """The size of all attachments of a step; ``sizes`` are those of textures.

    Raises ``PlanError`` if its targets differ.
    """
    found: dict[Size, str] = {}
    for row in step.attachments:
        width, height = sizes[row.texture]
        found[halved(width, row.level), halved(height, row.level)] = row.result
    if len(found) > 1:
        each = " and ".join(f"`{name}` with {w} x {h}" for (w, h), name in found.items())
        fail(plan, step.name, f"it draws to {each} texels: all have to have one size")
    return next(iter(found))

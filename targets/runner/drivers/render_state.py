"""The targets of a pipeline: their formats, and how they are blended.

All other state that no text of a pipeline says is that of the language: ``ir/render_state.py``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ....compiler.ir.blending import Blend

TargetFormat = Literal[
    "r32float", "rg32float", "rgba32float", "r8unorm", "rg8unorm", "rgba8unorm", "rgba8unorm-srgb",
    "r16float", "rg16float", "rgba16float",
]  # fmt: skip
DepthFormat = Literal["depth32float", "depth32float-stencil8"]
"""Of the depths that are drawn to, and of the stencil values beside them."""

Winding = Literal["ccw", "cw"]
"""How the corners of a front go around."""

ALL_LANES = "rgba"


@dataclass(frozen=True, slots=True)
class RenderTarget:
    """One render target."""

    format: TargetFormat
    blend: Blend | None = None
    """``None`` where what is drawn takes the place of what is there."""
    mask: str = ALL_LANES
    """Which lanes are written: some of these letters, or ``none``."""

    def writes(self, lane: str) -> bool:
        """Whether a lane is written."""
        return self.mask != "none" and lane in self.mask

"""The targets of a pipeline: their formats, and how they are blended.

All other state that no shader text has is the language's own: ``ir/render_state.py``.
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
"""The format of the depth attachment, and of the stencil values in it."""

Winding = Literal["ccw", "cw"]
"""The winding of a front face's corners."""

ALL_LANES = "rgba"


@dataclass(frozen=True, slots=True)
class RenderTarget:
    """One render target."""

    format: TargetFormat
    blend: Blend | None = None
    """The blend state; ``None`` if fragments replace the contents."""
    mask: str = ALL_LANES
    """The lanes that are written: some of these letters, or ``none``."""

    def writes(self, lane: str) -> bool:
        """True if a lane is written."""
        return self.mask != "none" and lane in self.mask

"""The fixed state of a pipeline, which no shader text has: culling, blending, depth, stencil."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

TargetFormat = Literal[
    "r32float", "rg32float", "rgba32float", "r8unorm", "rg8unorm", "rgba8unorm", "rgba8unorm-srgb",
    "r16float", "rg16float", "rgba16float",
]  # fmt: skip
DepthFormat = Literal["depth32float", "depth32float-stencil8"]
"""Of the depths that are drawn to, and of the stencil values beside them."""

Compare = Literal[
    "never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"
]
"""How the reference, or the depth of a fragment, on the left, is compared with a depth."""

Cull = Literal["none", "back", "front"]
"""The triangles that are culled."""

Winding = Literal["ccw", "cw"]
"""How the corners of a front go around."""

Fill = Literal["faces", "lines"]
"""The fill mode of triangles: whole faces, or their edges."""

Factor = Literal[
    "zero", "one", "src", "one_minus_src", "src_alpha", "one_minus_src_alpha", "dst",
    "one_minus_dst", "dst_alpha", "one_minus_dst_alpha", "src_alpha_saturated", "constant",
    "one_minus_constant",
]  # fmt: skip
"""By what a side is multiplied when colours are blended: the source is what is drawn, the
destination what is there."""

Operation = Literal["add", "subtract", "reverse_subtract", "min", "max"]
"""How the two products are joined; ``min`` and ``max`` have factors of ``one``."""


@dataclass(frozen=True, slots=True)
class BlendEquation:
    """The blending of two colours, or of two alphas."""

    source: Factor = "one"
    destination: Factor = "zero"
    operation: Operation = "add"


@dataclass(frozen=True, slots=True)
class Blend:
    """How a target is blended."""

    color: BlendEquation
    alpha: BlendEquation


ALL_LANES = "rgba"


@dataclass(frozen=True, slots=True)
class RenderTarget:
    """One render target."""

    format: TargetFormat
    blend: Blend | None = None
    """``None`` where what is drawn takes the place of what is there."""
    mask: str = ALL_LANES
    """The lanes that are written: some of these letters, or ``none``."""

    def writes(self, lane: str) -> bool:
        """True if a lane is written."""
        return self.mask != "none" and lane in self.mask


@dataclass(frozen=True, slots=True)
class DepthBias:
    """How far triangles are moved away from the eye before the depth test."""

    constant: int = 0
    """In steps of the format."""
    slope: float = 0.0
    """In times of what the depth changes from one pixel to the next."""
    clamp: float = 0.0
    """How far both together move at most; 0: any distance."""


NO_BIAS = DepthBias()

StencilOperation = Literal[
    "keep", "zero", "replace", "invert",
    "increment_clamp", "decrement_clamp", "increment_wrap", "decrement_wrap",
]  # fmt: skip
"""The operation on a stencil value."""


@dataclass(frozen=True, slots=True)
class StencilSide:
    """The stencil test of triangles of which one side is seen, and what becomes of the values."""

    compare: Compare = "always"
    """How the reference, on the left, has to compare with the value, both masked."""
    fail: StencilOperation = "keep"
    depth_fail: StencilOperation = "keep"
    passed: StencilOperation = "keep"
    """Where the test fails, where only the depth test does, and where neither does."""


@dataclass(frozen=True, slots=True)
class Stencil:
    """The stencil test of either side. Each draw of a job begins with values of 0."""

    front: StencilSide
    back: StencilSide
    reference: int
    read_mask: int
    write_mask: int

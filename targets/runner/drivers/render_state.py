"""The fixed state of a pipeline, which no shader text has: culling, blending, depth, stencil."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

TargetFormat = Literal[
    "r32float", "rg32float", "rgba32float", "r8unorm", "rg8unorm", "rgba8unorm", "rgba8unorm-srgb",
    "r16float", "rg16float", "rgba16float",
]  # fmt: skip
DepthFormat = Literal["depth32float", "depth32float-stencil8"]
"""The format of the depth attachment, and of the stencil values in it."""

Compare = Literal[
    "never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"
]
"""The comparison of a reference, or of a fragment's depth (the left side), with a depth (the
right)."""

Cull = Literal["none", "back", "front"]
"""The triangles that are culled."""

Winding = Literal["ccw", "cw"]
"""The winding of a front face's corners."""

Fill = Literal["faces", "lines"]
"""The fill mode of triangles: whole faces, or their edges."""

Factor = Literal[
    "zero", "one", "src", "one_minus_src", "src_alpha", "one_minus_src_alpha", "dst",
    "one_minus_dst", "dst_alpha", "one_minus_dst_alpha", "src_alpha_saturated", "constant",
    "one_minus_constant",
]  # fmt: skip
"""The factor of a side when colours are blended: the source is the fragment, and the destination
the contents of the target."""

Operation = Literal["add", "subtract", "reverse_subtract", "min", "max"]
"""The operation on both products; ``min`` and ``max`` have factors of ``one``."""


@dataclass(frozen=True, slots=True)
class BlendEquation:
    """The blending of two colours, or of two alphas."""

    source: Factor = "one"
    destination: Factor = "zero"
    operation: Operation = "add"


@dataclass(frozen=True, slots=True)
class Blend:
    """The blend state of a target."""

    color: BlendEquation
    alpha: BlendEquation


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


@dataclass(frozen=True, slots=True)
class DepthBias:
    """The depth bias: moves triangles away from the eye before the depth test."""

    constant: int = 0
    """The constant part, in steps of the format."""
    slope: float = 0.0
    """The slope's part, as a factor of the depth's change from one pixel to the next."""
    clamp: float = 0.0
    """The largest bias of both parts together; 0: there is no limit."""


NO_BIAS = DepthBias()

StencilOperation = Literal[
    "keep", "zero", "replace", "invert",
    "increment_clamp", "decrement_clamp", "increment_wrap", "decrement_wrap",
]  # fmt: skip
"""The operation on a stencil value."""


@dataclass(frozen=True, slots=True)
class StencilSide:
    """The stencil test, and the operations, for triangles that show one of their sides."""

    compare: Compare = "always"
    """The comparison of the reference, on the left, with the value, both masked."""
    fail: StencilOperation = "keep"
    depth_fail: StencilOperation = "keep"
    passed: StencilOperation = "keep"
    """The operation if both tests pass. ``fail`` is that of a failed stencil test, and
    ``depth_fail`` that of a failed depth test."""


@dataclass(frozen=True, slots=True)
class Stencil:
    """The stencil test of either side. Each draw of a job begins with values of 0."""

    front: StencilSide
    back: StencilSide
    reference: int
    read_mask: int
    write_mask: int

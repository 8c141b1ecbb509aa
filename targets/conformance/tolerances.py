"""How far a driver's picture may lie from the reference: one row for each, with its reason.

A pixel agrees if ``|got - expected| <= absolute + relative * |expected| + 1.25 * radius``, where
the radius is the reference's own, for what a device may round on the way.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace


@dataclass(frozen=True, slots=True)
class Tolerance:
    """What is known of a driver besides what it tells."""

    absolute: float
    relative: float
    reason: str
    """Why these two are what they are."""
    functions: Mapping[str, float] = field(default_factory=dict)
    """Builtins that are off by more than rounding, and by how much."""
    interpolates_snapped: bool = False
    """Whether attributes go by the snapped places of vertices, as coverage does everywhere."""
    clips_sides: bool = False
    """Whether it cuts triangles off at the sides of the picture, and snaps what that makes."""
    rounding_bits: int = 22
    """Of what operations give; float32 has 23, and some take several roundings."""
    edge_slack: float = 0.0
    """By how many pixels it misjudges on which side of an edge a pixel lies."""
    varying_bits: int = 18
    """Of what is interpolated, relative to its largest corner. No API promises any."""
    subtexel_bits: int = 8
    """Of filter weights, where the API does not tell."""
    mip_bits: int = 8
    """Of the level of detail, where the API does not tell."""
    mixing_bits: int | None = None
    """Of what it mixes of two levels whose texels it does not filter; ``None``: as floats."""
    level_power: int | None = None
    """Of which power of a footprint it reads the logarithm off the float's bits, roughly."""
    bottom_up: bool = False
    """Whether a quad's first pixel is the lower left one, which matters for cubes only."""
    projects_cubes: bool = True
    """Whether a cube's level goes by how the place in its face changes, as Vulkan specifies."""


_LLVM = Tolerance(
    1e-5,
    1e-4,
    "float32 arithmetic, and functions close to exact",
    # Mesa's polynomial for the arc sine; WGSL and Vulkan allow more, by way of atan2.
    functions={"asin": 3e-4, "acos": 3e-4},
    clips_sides=True,
    edge_slack=2.0**-11,
    level_power=2,
)
_SWIFTSHADER = Tolerance(
    1e-5,
    1e-4,
    "float32 arithmetic, and most functions close to exact",
    # As far off as Vulkan and WGSL allow.
    functions={"sin": 2.0**-11, "cos": 2.0**-11, "tan": 2.0**-10},
    interpolates_snapped=True,
    clips_sides=True,
    mip_bits=6,
    # Which it does in 16 bits, with some roundings.
    mixing_bits=14,
    level_power=4,
    projects_cubes=False,
)
# GL leaves open who owns a pixel that lies on an edge, and rows from the bottom up turn a top-left
# rule over: such pixels are undecided.
_WEBGL = replace(_SWIFTSHADER, edge_slack=2.0**-16, bottom_up=True)

DRIVERS: Mapping[str, Tolerance] = {
    "lavapipe": _LLVM,
    "llvmpipe": _LLVM,
    "swiftshader": _SWIFTSHADER,
    "webgpu": _SWIFTSHADER,
    "webgl2": _WEBGL,
}
"""By a route's driver."""

TOGETHER = 1.25
"""The radius is the sum of what a device's choices change one by one; together they may change so
many times as much."""

UNDECIDED_SHARE = 0.03
"""More undecided pixels than this part of the picture prove too little to be a pass."""
UNDECIDED_FEW = 40
"""So do more than this and than the decided ones of what is drawn."""
PROVEN_SHARE = 0.01
"""Some case has to have so many decided pixels, as a part of its picture."""

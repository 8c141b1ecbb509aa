"""The tolerance of each driver: how much its pictures may differ from the reference's, and why.

``compare.py`` applies a row, and docs/conformance.md shows all of them. A pixel agrees if
``|got - expected| <= absolute + relative * |expected| + 1.25 * radius``. The reference computes the
radius, which allows for what a device may round on the way.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace


@dataclass(frozen=True, slots=True)
class Tolerance:
    """Properties of a driver that its API does not report."""

    absolute: float
    relative: float
    reason: str
    """The reason for these two numbers."""
    functions: Mapping[str, float] = field(default_factory=dict)
    """Builtins whose error is larger than rounding, and the error."""
    interpolates_snapped: bool = False
    """Whether attributes are interpolated between snapped vertices, as coverage always is."""
    clips_sides: bool = False
    """Whether it clips triangles at the sides of the picture, and snaps the new corners."""
    rounding_bits: int = 22
    """Exact bits of an operation's result; float32 has 23, but some operations round several
    times."""
    edge_slack: float = 0.0
    """How close to an edge, in pixels, it may put a pixel on the wrong side."""
    varying_bits: int = 18
    """Exact bits of interpolated values, relative to the largest corner. No API promises any."""
    subtexel_bits: int = 8
    """Bits of filter weights, if the API does not report them."""
    mip_bits: int = 8
    """Bits of the level of detail, if the API does not report them."""
    mixing_bits: int | None = None
    """Bits with which it blends two levels whose texels it does not filter; ``None``: it uses
    floats."""
    level_power: int | None = None
    """It reads the logarithm of this power of a footprint roughly, from a float's bits."""
    bottom_up: bool = False
    """Whether a quad's first pixel is the lower left one, which matters only for cubes."""
    projects_cubes: bool = True
    """Whether a cube's level follows from the coordinates in the face, as Vulkan specifies."""


_LLVM = Tolerance(
    1e-5,
    1e-4,
    "float32 arithmetic, and functions close to exact",
    # Mesa's polynomial for the arc sine; WGSL and Vulkan allow more, because they allow atan2.
    functions={"asin": 3e-4, "acos": 3e-4},
    clips_sides=True,
    edge_slack=2.0**-11,
    level_power=2,
)
_SWIFTSHADER = Tolerance(
    1e-5,
    1e-4,
    "float32 arithmetic, and most functions close to exact",
    # The largest errors that Vulkan and WGSL allow.
    functions={"sin": 2.0**-11, "cos": 2.0**-11, "tan": 2.0**-10},
    interpolates_snapped=True,
    clips_sides=True,
    mip_bits=6,
    # It blends levels in 16 bits, with several roundings.
    mixing_bits=14,
    level_power=4,
    projects_cubes=False,
)
# OpenGL does not define which triangle owns a pixel that is exactly on an edge, and rows from the
# bottom up invert the top-left rule. Such pixels are undecided.
_WEBGL = replace(_SWIFTSHADER, edge_slack=2.0**-16, bottom_up=True)

DRIVERS: Mapping[str, Tolerance] = {
    "lavapipe": _LLVM,
    "llvmpipe": _LLVM,
    "swiftshader": _SWIFTSHADER,
    "webgpu": _SWIFTSHADER,
    "webgl2": _WEBGL,
}
"""The drivers, by their names in routes."""

TOGETHER = 1.25
"""The radius is the sum of the changes that each of a device's choices makes alone. Together they
may change this many times as much."""

UNDECIDED_SHARE = 0.03
"""If a larger part of the picture is undecided, agreement proves too little."""
UNDECIDED_FEW = 40
"""The same holds if more pixels are undecided than this, and more than the decided ones of the
object."""
PROVEN_SHARE = 0.01
"""The part of its picture that must be decided pixels of the object, in at least one case."""

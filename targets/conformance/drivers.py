"""Properties of each driver that its API does not report, and its measured accuracy.

``trials.py`` makes the rules of the reference's pictures from these rows, and docs/conformance.md
shows them. A picture is first compared with the bounds that were *measured* of the driver. Only if
it leaves them, it is compared with those that specifications guarantee.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from ...compiler.reference.picture.scene import Derivatives, Footprint, Lines
from ...stdlib.builtins.accuracy import INTERPOLATED_BITS


@dataclass(frozen=True, slots=True)
class Hardware:
    """The precision of a device's fixed functions, in binary places."""

    varying_bits: int
    """Places of the planes from which values are interpolated, relative to the largest number with
    which these are computed."""
    frag_coord_bits: int
    """Places of a fragment's depth, and of its 1 / w."""
    subtexel_bits: int
    """Places of the weights of filters."""
    mip_bits: int
    """Places of a level of detail that a program names."""
    lod_error: float | None = None
    """How far off one is that follows from steps, in levels; ``None``: a step of the others."""
    product_bits: int | None = None
    """Places of the weight of each of several texels, which is a product; ``None``: a float's."""
    fixed_bits: int | None = None
    """Places of the result of a filter over texels in fixed point; ``None``: a float's."""
    half_bits: int | None = None
    """Places of a blend of texels that are short floats, relative to the larger one; ``None``: a
    float's."""
    float_bits: int | None = None
    """The same for floats of 32 bits."""
    mixing_bits: int | None = None
    """Places of the weights of two levels whose texels are not filtered; ``None``: they are
    floats."""
    derivatives: Derivatives = "any"
    footprint: Footprint = "any"
    """The length from which mip levels follow."""
    corner_bits: int | None = None
    """Places of the mean of the three texels around a cube's corner; ``None``: it may be one of
    them."""
    lines: Lines = "any"
    """The rule for the pixels that a line covers."""


@dataclass(frozen=True, slots=True)
class Driver:
    """A driver's properties."""

    assumed: Hardware
    """The guaranteed properties, where the API does not report them. No API promises anything about
    interpolated values."""
    measured: Hardware | None = None
    """The measured properties, with some binary places less, as other pictures may have larger
    errors. ``measured.py`` has the measured errors of functions."""
    interpolates_snapped: bool = False
    """True if attributes are interpolated between snapped vertices, as coverage always is."""
    clips_sides: bool = False
    """True if the driver clips triangles at the sides of the picture, and snaps the new corners."""
    owns_bottom: bool = False
    """True if pixels that are exactly on a level edge belong to the face above it, not below."""
    edge_slack: float = 0.0
    """The distance from an edge, in pixels, at which the driver may put a pixel on the wrong
    side."""
    snaps_line_ends: bool | None = False
    """True if the driver snaps the ends of lines, and half their width separately; ``None`` if that
    is not known."""
    level_power: int | None = None
    """The power of a footprint whose logarithm the driver reads roughly, from a float's bits."""
    projects_cubes: bool = True
    """True if a cube's mip level follows from the coordinates in the face, as Vulkan specifies."""
    mirrors_sample_depths: bool = False
    """True if the driver takes the depth of each of several samples from the wrong side of the
    pixel."""
    grids: tuple[int, ...] = (8,)
    """The binary places of a pixel to which its devices snap vertices. They report them, so this is
    for promises about devices that are not at hand."""


_LLVM = Driver(
    Hardware(
        varying_bits=20, frag_coord_bits=18, subtexel_bits=8, mip_bits=8, footprint="step"
    ),
    Hardware(
        varying_bits=22, frag_coord_bits=18, subtexel_bits=16, mip_bits=16,
        derivatives="own", footprint="euclidean", corner_bits=20, lines="rectangle",
    ),
    clips_sides=True,
    edge_slack=2.0**-11,
    snaps_line_ends=True,
    level_power=2,
)  # fmt: skip
_SWIFTSHADER = Driver(
    # SwiftShader blends levels in 16 bits, with several roundings.
    Hardware(
        varying_bits=20, frag_coord_bits=18, subtexel_bits=8, mip_bits=6, footprint="step",
        mixing_bits=14,
    ),
    Hardware(
        varying_bits=22, frag_coord_bits=18, subtexel_bits=14, mip_bits=12, mixing_bits=14,
        derivatives="first", footprint="euclidean", corner_bits=8, lines="rectangle",
    ),
    interpolates_snapped=True,
    clips_sides=True,
    level_power=4,
    projects_cubes=False,
    mirrors_sample_depths=True,
    grids=(4,),
)  # fmt: skip


def _with_lines(driver: Driver, lines: Lines) -> Driver:
    """The driver under an API for which it covers lines by another rule."""
    measured = driver.measured and replace(driver.measured, lines=lines)
    return replace(driver, measured=measured)


# WebGL's rows are drawn from the bottom up, which turns the top-left rule into a bottom-left one.
_WEBGL = replace(_with_lines(_SWIFTSHADER, "parallelogram"), owns_bottom=True)

# The devices of other people's machines, unless they have measured theirs (``profiles.py``). Where
# the API reports nothing, this is less than such devices are known to have. Vulkan says nothing of
# the precision of levels and of filtered results. Its conformance tests (VK-GL-CTS,
# vktPipelineImageSamplingInstance.cpp) accept levels with 4 places and results that lack two of a
# texel's 8 bits; a filter over floats is given the same as over fixed point.
_ANY_DEVICE = Driver(
    Hardware(
        varying_bits=INTERPOLATED_BITS,
        frag_coord_bits=INTERPOLATED_BITS,
        subtexel_bits=8,
        mip_bits=4,
        lod_error=2.0**-4,
        fixed_bits=6,
        half_bits=8,
        float_bits=8,
        mixing_bits=8,
    ),
    interpolates_snapped=True,
    clips_sides=True,
    edge_slack=2.0**-11,
    # Direct3D asks for 8 places, and the others for at least 4, which SwiftShader has.
    grids=(4, 8),
    snaps_line_ends=None,
)

DRIVERS: Mapping[str, Driver] = {
    "lavapipe": _LLVM,
    "llvmpipe": _with_lines(_LLVM, "diamonds"),
    "swiftshader": _SWIFTSHADER,
    "webgpu": _SWIFTSHADER,
    "webgl2": _WEBGL,
    "vulkan": _ANY_DEVICE,
    "opengl": _ANY_DEVICE,
    "wgpu": _ANY_DEVICE,
}
"""The drivers, by their names in routes."""

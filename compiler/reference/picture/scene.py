"""The input and output of ``draw`` as plain data: geometry, textures, raster rules, the picture."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

Area = tuple[int, int, int, int]
"""A part of a picture: left, top, width and height."""
Lines = Literal["rectangle", "parallelogram", "diamonds", "any"]
"""The rule by which a line of the width 1 covers pixels.

``rectangle``: pixels with their middle in a rectangle around it. ``parallelogram``: in one with
sides along the picture, one pixel wide across the line's longer direction. ``diamonds``: pixels
whose diamond it leaves, where values change along its longer direction only. ``any``: nothing is
known, so each of these rules is possible.
"""
Derivatives = Literal["own", "first", "any"]
"""The differences that a device takes between pixels.

``own``: those of each pixel's own row and column. ``first``: those of the first row and column for
the whole quad. ``any``: nothing is known, so any of its quad.
"""
Footprint = Literal["euclidean", "step", "ellipse", "any"]
"""The length in texels from whose logarithm the level follows.

``euclidean``: that of the longer one of the steps in a quad's first row and column. ``step``:
anything from the largest lane of a step to the sum of its lanes, in any row or column. ``ellipse``:
anything from the longer step to the longer axis of the ellipse that both steps span, for the steps
in any row and column of the quad. ``any``: all that APIs allow (``levels.py``).
"""
Stored = Literal["float", "half", "fixed"]
"""The numbers of a texture's format: floats of 32 bits or of fewer, or fixed point in 0..1.

How precise the result of a filter is depends on it.
"""
Counted = frozenset[tuple[str, Hashable]]
"""Names and values of raster rules in ``RARE`` on which a picture depends."""

LEVEL_EDGES = frozenset({"owns_bottom"})
LINES = frozenset({"lines", "snaps_line_ends"})
ROWS = frozenset({"bottom_up"})
RARE = LEVEL_EDGES | LINES | ROWS
"""The rules that few pictures depend on.

Such pictures have samples exactly on a level edge, or lines, or pixels that use values of their
neighbours or have several samples. All others are the same by any of these rules.
"""


@dataclass(frozen=True, slots=True)
class Geometry:
    """Indexed triangles or lines; or other primitives, which are expanded or captured."""

    attributes: Mapping[str, NDArray[Any]]
    """The attributes by name, (vertices, lanes): float64, or int64 for integers."""
    triangles: Ints
    """Indices of vertices, (triangles, 3), in the order of drawing.

    The first is the provoking vertex. Lines have two, and other primitives as many as they have
    corners.
    """
    instance_count: int = 1
    """The number of instances: the same vertices are repeated, one instance after the other."""

    @property
    def vertex_count(self) -> int:
        """The number of vertices; without any attribute, as many as the triangles mention."""
        counts = [len(values) for values in self.attributes.values()]
        return counts[0] if counts else int(self.triangles.max(initial=-1)) + 1

    def inputs(self) -> Mapping[str, Ints]:
        """The pipeline's inputs at each vertex, by name."""
        numbers = np.arange(self.vertex_count)
        each = max(self.vertex_count // self.instance_count, 1)
        return {"vertex_index": numbers % each, "instance_index": numbers // each}


def instanced(
    per_vertex: Mapping[str, NDArray[Any]],
    per_instance: Mapping[str, NDArray[Any]],
    triangles: Ints,
    instance_count: int,
) -> Geometry:
    """All instances of a mesh as one geometry, in the order in which they are drawn."""
    alone = Geometry(per_vertex, triangles).vertex_count
    attributes = {name: np.tile(values, (instance_count, 1)) for name, values in per_vertex.items()}
    for name, values in per_instance.items():
        attributes[name] = np.repeat(values, alone, axis=0)
    offsets = np.arange(instance_count)[:, None, None] * alone
    return Geometry(
        attributes, (triangles + offsets).reshape(-1, triangles.shape[1]), instance_count
    )


@dataclass(frozen=True, slots=True)
class Texels:
    """A texture as a shader reads it."""

    levels: tuple[Floats | Ints, ...]
    """The levels, each with linear values (height, width, 4), first row at the top.

    Depths are (height, width, 1). With layers, faces or slices: (layers, height, width, 4). Every
    level halves width and height, and the depth of a 3D texture, rounded down, but not below 1.
    """
    is_srgb: bool = False
    """True if colours are stored in 8 bits of sRGB, which a device decodes."""
    low: tuple[Floats, ...] = ()
    high: tuple[Floats, ...] = ()
    """The upper bounds of the numbers that a device has stored, for each level of a drawn texture.

    ``low`` has the lower ones. For an undecided pixel, these contain all that it may have drawn
    there.
    """
    has_undefined: bool = False
    """True if some texels were drawn that are undefined; they are NaN."""
    stored: Stored = "float"
    """The numbers of the texture's format."""
    lanes: int = 4
    """The lanes that the format has, of those in ``levels``."""


@dataclass(frozen=True, slots=True)
class RasterRules:
    """The size of the picture, and everything that an API leaves to the device."""

    width: int
    height: int
    subpixel_bits: int | None = None
    """To how many binary places of a pixel vertices are snapped; ``None``: they are not."""
    interpolates_snapped: bool = False
    """True if depth and attributes are interpolated between the snapped vertices.

    Otherwise those before snapping count. Coverage always depends on the snapped ones.
    """
    clips_sides: bool = False
    """True if triangles are clipped at the sides of the picture, before they are snapped."""
    owns_bottom: bool = False
    """True if pixels that are exactly on a level edge belong to the face above it, not below."""
    edge_slack: float = 0.0
    """The distance to an edge, in pixels, at which the device may put a pixel on the wrong side."""
    lines: Lines = "rectangle"
    snaps_line_ends: bool | None = False
    """True if the ends of lines are snapped, and half their width by itself.

    Otherwise the corners of the covered area are; ``None`` if it may be either.
    """
    subtexel_bits: int | None = None
    """The binary places of a linear filter's weights; ``None``: they are exact."""
    varying_bits: int | None = None
    """The exact binary places of the planes from which values are interpolated; ``None``: all.

    They are relative to the largest number with which the planes are computed.
    """
    frag_coord_bits: int | None = None
    """The exact binary places of the planes of a fragment's depth, and of its 1 / w."""
    mip_bits: int | None = None
    """The binary places of a level that a program names; ``None``: exact."""
    lod_error: float | None = None
    """How far off the level is that follows from steps, in levels; ``None``: a step of the others.
    """
    footprint: Footprint = "any"
    """The length from which the level follows. Of cubes, ``euclidean`` is not known."""
    product_bits: int | None = None
    """The binary places of the weight of each of four or eight texels, which is the product of
    those along the axes; ``None``: it is as precise as a float32."""
    fixed_bits: int | None = None
    """The binary places of the result of a filter over texels in fixed point.

    ``None``: it is as precise as a float32 is.
    """
    half_bits: int | None = None
    """The binary places of each blend of texels that are short floats, relative to the larger one.

    ``None``: as many as a float32 has.
    """
    float_bits: int | None = None
    """The same for texels that are floats of 32 bits."""
    mixing_bits: int | None = None
    """The binary places of a mean of single texels of two levels; ``None``: exact.

    One of the levels may have no weight.
    """
    level_power: int | None = None
    """The power of a footprint whose logarithm a device reads roughly; ``None``: it is exact.

    It reads the logarithm from a float's bits.
    """
    derivatives: Derivatives = "any"
    corner_bits: int | None = None
    """The binary places of the texel beyond a cube's corner; ``None``: it may read one of three.

    They are known where the device reads the mean of the three texels around it, as Vulkan
    recommends.
    """
    bottom_up: bool = False
    """True if the device counts rows from below.

    Then a quad's first pixel is the lower left one, which matters for levels and derivatives, and
    the samples of a pixel lie turned over.
    """
    projects_cubes: bool = True
    """True if a cube's level follows from the coordinates in the face, as Vulkan specifies.

    See "Cube Map Derivative Transformation". Otherwise it follows from the movement on the cube's
    surface, in space.
    """
    unguarded_is_nan: bool = False
    """True if an ``unguarded`` operation outside of its domain makes pixels undecided.

    This is since a device may give anything there. Otherwise the operation means what it does with
    its guard.
    """
    viewport: Area | None = None
    """The part of the picture into which the clip volume is drawn; ``None``: all of it.

    Nothing is drawn outside of it.
    """
    scissor: Area | None = None
    """To which part of the picture is drawn, likewise."""
    samples: int = 1
    """The number of samples of each pixel."""
    mirrors_sample_depths: bool = False
    """True if the device computes the depth of each sample as if the samples were reversed in x.

    Left and right are exchanged: a known mistake.
    """

    @property
    def reading_exactly(self) -> RasterRules:
        """These rules for a device whose texture reads do not round."""
        return replace(
            self,
            subtexel_bits=None,
            mip_bits=None,
            lod_error=None,
            product_bits=None,
            fixed_bits=None,
            half_bits=None,
            float_bits=None,
            mixing_bits=None,
        )

    @property
    def common(self) -> Counted:
        """All but the rare ones."""
        return self.counted(row.name for row in fields(self) if row.name not in RARE)

    def counted(self, names: Iterable[str]) -> Counted:
        """The named rules and their values."""
        return frozenset((name, getattr(self, name)) for name in names)

    def agree_with(self, counted: Counted) -> bool:
        """True if a picture that depends on these rare rules is also right by these rules.

        They have to have the others in common.
        """
        return counted <= self.counted(RARE)

    @property
    def port(self) -> Area:
        """The viewport."""
        return (0, 0, self.width, self.height) if self.viewport is None else self.viewport

    @property
    def sample_count(self) -> int:
        """The number of samples of the whole picture."""
        return self.width * self.height * self.samples

    @property
    def drawn(self) -> Area:
        """The area that is drawn to: first and last column and row; the last ones are outside."""
        found = (0, 0, self.width, self.height)
        for area in (self.viewport, self.scissor):
            if area is not None:
                left, top, width, height = area
                found = (
                    max(found[0], left), max(found[1], top),
                    min(found[2], left + width), min(found[3], top + height),
                )  # fmt: skip
        return found


@dataclass(frozen=True, slots=True)
class Expected:
    """The picture, and how certain it is."""

    targets: tuple[Floats, ...]
    """The values of each target (height, width, 4), not clamped to its format's range.

    Missing lanes are 0, 0, 1.
    """
    covered: Bools
    """(height, width): where at least one fragment was written."""
    undecided: Bools
    """True for undecided pixels, (height, width).

    There, rounding tips which fragments are drawn, or in which order; or a promise is broken or an
    ``unguarded`` operation leaves its domain, so that nothing is defined.
    """
    low: tuple[Floats, ...]
    high: tuple[Floats, ...]
    """The upper bounds of a conforming device's values in each target (height, width, 4).

    ``low`` has the lower ones. They are infinite where nothing is known. Without bounds, these are
    ``targets``.
    """
    layers: Ints
    """(height, width): how many fragments were drawn, each of which was rounded to the format."""
    counted: Counted = frozenset()
    """The rare rules on which it hangs."""

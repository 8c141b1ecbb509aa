"""Textures as data: the formats of texels, and images with all their mip levels."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

TextureFormat = Literal[
    "rgba8unorm", "rgba8unorm-srgb", "rgba32float", "depth32float",
    "r8uint", "rgba8uint", "r32uint", "rgba32uint", "r32sint", "rgba32sint",
]  # fmt: skip
Dimension = Literal["2d", "2d_array", "3d", "cube", "cube_array"]
FACES = 6
"""The number of faces of a cube."""
Sample = Literal["float", "unfilterable-float", "depth", "sint", "uint"]
"""The sample type of a texture; a shader never filters an ``unfilterable-float``."""


@dataclass(frozen=True, slots=True)
class Texel:
    """The memory layout of a ``TextureFormat``."""

    lanes: int
    """The number of lanes, 1 or 4. If it is 1, a shader reads 0, 0, 1 for the others."""
    kind: Literal["u1", "<u4", "<i4", "<f4"]
    """The type of a lane, as NumPy spells it."""
    sample: Sample

    @property
    def size(self) -> int:
        """The number of bytes."""
        return self.lanes * int(self.kind[-1])


TEXELS: Mapping[TextureFormat, Texel] = {
    "rgba8unorm": Texel(4, "u1", "float"),
    "rgba8unorm-srgb": Texel(4, "u1", "float"),
    "rgba32float": Texel(4, "<f4", "float"),
    "depth32float": Texel(1, "<f4", "depth"),
    "r8uint": Texel(1, "u1", "uint"),
    "rgba8uint": Texel(4, "u1", "uint"),
    "r32uint": Texel(1, "<u4", "uint"),
    "rgba32uint": Texel(4, "<u4", "uint"),
    "r32sint": Texel(1, "<i4", "sint"),
    "rgba32sint": Texel(4, "<i4", "sint"),
}


@dataclass(frozen=True, slots=True)
class Image:
    """The texels of a texture with all its mip levels.

    They are stored row by row, the first at the top (v = 0), then layer by layer, slice by slice of
    a 3D texture, or face by face of a cube: +x, -x, +y, -y, +z, -z, each oriented as in all APIs.
    Arrays of cubes have cube after cube.
    """

    format: TextureFormat
    width: int
    """The width of the first level. Each further level halves both sides, rounded down, but not
    below 1."""
    height: int
    levels: tuple[bytes, ...]
    dimension: Dimension = "2d"
    depth: int = 1
    """The number of layers or faces, or of the slices of the first level, which are halved like the
    sides."""

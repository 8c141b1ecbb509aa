"""What is drawn, under which rules, and what has to come out: plain data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

Cull = Literal["none", "back", "front"]


@dataclass(frozen=True, slots=True)
class Geometry:
    """Indexed triangles."""

    attributes: Mapping[str, NDArray[Any]]
    """By attribute name, (vertices, lanes): float64, or int64 for integers."""
    triangles: Ints
    """(triangles, 3) numbers of vertices, in the order of drawing; the first one is provoking."""
    instance_count: int = 1
    """How many times over there are the same vertices, one instance after the other."""

    @property
    def vertex_count(self) -> int:
        """How many vertices there are; without any attribute, as many as the triangles name."""
        counts = [len(values) for values in self.attributes.values()]
        return counts[0] if counts else int(self.triangles.max(initial=-1)) + 1

    def inputs(self) -> Mapping[str, Ints]:
        """What the pipeline supplies at each vertex, by name."""
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
    return Geometry(attributes, (triangles + offsets).reshape(-1, 3), instance_count)


@dataclass(frozen=True, slots=True)
class Texels:
    """A texture with its mip levels."""

    levels: tuple[Floats | Ints, ...]
    """Each (height, width, 4) linear values, the first row on top; of depths (height, width, 1).

    With layers, faces or slices: (layers, height, width, 4). Every level halves width and height,
    and a volume's depth, rounding down, to no less than 1."""


@dataclass(frozen=True, slots=True)
class RasterRules:
    """The picture's size, and what an API leaves to the device or the pipeline's state."""

    width: int
    height: int
    subpixel_bits: int | None = None
    """To how many binary places of a pixel vertices are snapped; ``None`` leaves them alone."""
    interpolates_snapped: bool = False
    """Whether depth and attributes are interpolated between the snapped places of the vertices,
    rather than between those from before; coverage always goes by the snapped ones."""
    clips_sides: bool = False
    """Whether triangles are cut off at the sides of the picture, before they are snapped."""
    edge_slack: float = 0.0
    """By how many pixels the device may misjudge on which side of an edge a pixel lies."""
    cull: Cull = "none"
    subtexel_bits: int | None = None
    """Binary places of a linear filter's weights; ``None``: exact, with a radius of 0."""
    functions: tuple[tuple[str, float], ...] = ()
    """Builtins that are off by more than rounding, and by how much, absolutely."""
    rounding_bits: int | None = None
    """Binary places of what operations of the fragment stage give; ``None``: exact."""
    varying_bits: int | None = None
    """Binary places of what is interpolated, relative to the largest of its corners; ``None``:
    exact."""
    mip_bits: int | None = None
    """Binary places of the level of detail, likewise."""
    mixing_bits: int | None = None
    """Binary places of a mean of single texels of two levels; ``None``: exact."""
    level_power: int | None = None
    """Of which power of a footprint a device reads the logarithm off the float's bits, roughly;
    ``None``: it is exact."""
    bottom_up: bool = False
    """Whether a quad's first pixel is the lower left one, which matters for cubes only."""
    projects_cubes: bool = True
    """Whether a cube's level goes by how the place in its face changes, as Vulkan specifies
    ("Cube Map Derivative Transformation"), or by how that on its surface does, in space."""


@dataclass(frozen=True, slots=True)
class Expected:
    """The picture, and how sure it is."""

    targets: tuple[Floats, ...]
    """For each target (height, width, 4), not clamped to its format's range; lanes that the format
    lacks are 0, 0, 1."""
    covered: Bools
    """(height, width): where at least one fragment was written."""
    undecided: Bools
    """(height, width): where rounding to float32 may tip a decision the value hangs on."""
    radius: tuple[Floats, ...]
    """For each target (height, width, 4): how far filtering, derivatives, interpolation and
    rounding within the device's bits may move it."""

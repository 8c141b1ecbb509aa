"""Points, lines and triangles: the primitives of a mesh, and those that are drawn of it.

Expansions and tessellations say by these words which primitives they take and make.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

DrawnPrimitive = Literal["point", "line", "triangle"]
"""The primitives that a rasteriser draws."""

CORNERS: Mapping[str, int] = {
    "point": 1,
    "line": 2,
    "triangle": 3,
    "line_adjacency": 4,
    "triangle_adjacency": 6,
}
"""The number of vertices of each kind of primitive.

With adjacency they are in the order of Vulkan and OpenGL: a line between the vertices next to its
ends, a triangle with the vertex across each edge behind the one where that edge begins.
"""

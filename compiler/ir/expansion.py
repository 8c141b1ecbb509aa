"""What each primitive of a mesh turns into: its corners, and the groups of strips that it emits.

Semantics makes an ``Expansion`` of an ``expand`` member. The lowering and the languages with a
geometry stage draw by it, and the reflection tells it to the host.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import accumulate
from typing import Literal

from ...frozen import frozen
from ..diagnostics.source import Span
from .primitives import CORNERS, DrawnPrimitive

StripShape = Literal["strip", "list", "line", "points"]


@frozen
class EmittedStrips:
    """One group of strips."""

    shape: StripShape
    """Triangles that each share two vertices with the one before, or that share none; lines from
    each vertex to the next one; or points, which only a pass can emit that captures them."""
    vertices: int
    """Of each strip."""
    strips: int
    """How many there are at most."""
    strip_name: str = "strip"
    """What the number of a strip is called."""
    vertex_name: str = "i"
    """What the number of a vertex in its strip is called."""

    @property
    def triangles(self) -> int:
        """Of each strip."""
        whole = {"strip": self.vertices - 2, "list": self.vertices // 3}
        return whole.get(self.shape, 0)

    @property
    def emits(self) -> DrawnPrimitive:
        """What its vertices are."""
        emitted: Mapping[StripShape, DrawnPrimitive] = {"line": "line", "points": "point"}
        return emitted.get(self.shape, "triangle")

    @property
    def listed_each(self) -> int:
        """How many vertices each strip has as a list of triangles, of lines, or of points."""
        if self.shape == "line":
            return 2 * (self.vertices - 1)
        return self.vertices if self.shape == "points" else 3 * self.triangles

    @property
    def listed(self) -> int:
        """How many all strips have."""
        return self.listed_each * self.strips


@frozen
class Expansion:
    """What each primitive turns into."""

    primitive: str
    """One of ``CORNERS``."""
    groups: tuple[EmittedStrips, ...]
    """In the order in which they are drawn."""
    span: Span
    """Where the primitive is named."""

    @property
    def corners(self) -> int:
        """How many vertices each primitive of the mesh has."""
        return CORNERS[self.primitive]

    @property
    def vertices(self) -> int:
        """How many vertices a primitive emits at most."""
        return sum(group.vertices * group.strips for group in self.groups)

    @property
    def listed(self) -> int:
        """How many there are as a list of triangles, of lines, or of points."""
        return sum(group.listed for group in self.groups)

    @property
    def emits(self) -> DrawnPrimitive:
        """What the emitted vertices are; all groups agree in that."""
        return self.groups[0].emits

    @property
    def starts(self) -> tuple[int, ...]:
        """For each group the number of its first vertex in that list."""
        return tuple(accumulate((group.listed for group in self.groups[:-1]), initial=0))

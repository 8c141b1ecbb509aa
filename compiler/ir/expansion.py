"""The expansion of each primitive of a mesh: its corners, and the groups of strips that it emits.

Semantics makes an ``Expansion`` of an ``expand`` member. The lowering and the languages with a
geometry stage draw by it, and the reflection tells it to the host.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import accumulate
from typing import Literal

from ...support.frozen import frozen
from ..diagnostics.source import Span
from .primitives import CORNERS, DrawnPrimitive

StripShape = Literal["strip", "list", "line", "points"]


@frozen
class StripKind:
    """The properties that all strips of one shape share."""

    emits: DrawnPrimitive
    """The kind of primitives that the vertices form."""
    is_joined: bool
    """True if each primitive but the first adds one vertex to vertices of the one before."""

    @property
    def corners(self) -> int:
        """The number of vertices of each primitive."""
        return CORNERS[self.emits]

    @property
    def step(self) -> int:
        """The number of vertices from the start of one primitive to that of the next."""
        return 1 if self.is_joined else self.corners

    def is_whole(self, vertices: int) -> bool:
        """True if ``vertices`` make a whole number of primitives, and at least one."""
        return vertices >= self.corners and (vertices - self.corners) % self.step == 0


STRIP_KINDS: Mapping[StripShape, StripKind] = {
    "strip": StripKind("triangle", is_joined=True),
    "list": StripKind("triangle", is_joined=False),
    "line": StripKind("line", is_joined=True),
    "points": StripKind("point", is_joined=False),
}
"""Points are emitted only by a pass that captures them."""


@frozen
class EmittedStrips:
    """One group of strips."""

    shape: StripShape
    vertices: int
    """The number of vertices of each strip."""
    strips: int
    """The largest number of strips."""
    strip_name: str = "strip"
    """The user's name for the number of a strip."""
    vertex_name: str = "i"
    """The user's name for the number of a vertex in its strip."""

    @property
    def kind(self) -> StripKind:
        """The properties that it shares with other strips of its shape."""
        return STRIP_KINDS[self.shape]

    @property
    def primitives(self) -> int:
        """The number of primitives of each strip."""
        return max((self.vertices - self.kind.corners) // self.kind.step + 1, 0)

    @property
    def listed_each(self) -> int:
        """The number of vertices of each strip as a list of triangles, lines or points."""
        return self.kind.corners * self.primitives

    @property
    def listed(self) -> int:
        """The number of vertices of all strips as such a list."""
        return self.listed_each * self.strips


@frozen
class Expansion:
    """The expansion of each primitive into strips."""

    primitive: str
    """One of ``CORNERS``."""
    groups: tuple[EmittedStrips, ...]
    """The groups, in the order in which they are drawn."""
    span: Span
    """The span that names the primitive."""

    @property
    def corners(self) -> int:
        """The number of vertices of each primitive of the mesh."""
        return CORNERS[self.primitive]

    @property
    def vertices(self) -> int:
        """The largest number of vertices that a primitive emits."""
        return sum(group.vertices * group.strips for group in self.groups)

    @property
    def listed(self) -> int:
        """The number of vertices of all strips as a list of triangles, lines or points."""
        return sum(group.listed for group in self.groups)

    @property
    def emits(self) -> DrawnPrimitive:
        """The kind of primitives that are emitted; all groups agree in it."""
        return self.groups[0].kind.emits

    @property
    def starts(self) -> tuple[int, ...]:
        """For each group, the number of its first vertex in that list."""
        return tuple(accumulate((group.listed for group in self.groups[:-1]), initial=0))

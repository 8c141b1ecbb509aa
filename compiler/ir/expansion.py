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
class StripKind:
    """What all strips of one shape have in common."""

    emits: DrawnPrimitive
    """What the vertices are."""
    is_joined: bool
    """Whether each primitive but the first consists of one vertex more, and of what came before."""

    @property
    def corners(self) -> int:
        """How many vertices each primitive has."""
        return CORNERS[self.emits]

    @property
    def step(self) -> int:
        """How many vertices further each primitive begins."""
        return 1 if self.is_joined else self.corners

    def is_whole(self, vertices: int) -> bool:
        """Whether so many vertices are a whole number of primitives, and at least one."""
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
    """Of each strip."""
    strips: int
    """How many there are at most."""
    strip_name: str = "strip"
    """What the number of a strip is called."""
    vertex_name: str = "i"
    """What the number of a vertex in its strip is called."""

    @property
    def kind(self) -> StripKind:
        """What it shares with others of its shape."""
        return STRIP_KINDS[self.shape]

    @property
    def primitives(self) -> int:
        """Of each strip."""
        return max((self.vertices - self.kind.corners) // self.kind.step + 1, 0)

    @property
    def listed_each(self) -> int:
        """How many vertices each strip has as a list of triangles, of lines, or of points."""
        return self.kind.corners * self.primitives

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
        return self.groups[0].kind.emits

    @property
    def starts(self) -> tuple[int, ...]:
        """For each group the number of its first vertex in that list."""
        return tuple(accumulate((group.listed for group in self.groups[:-1]), initial=0))

"""The division of each patch of a mesh: its kind, its control points, and how its edges lie.

Semantics makes a ``Tessellation`` of a ``tessellate`` member. The lowering and the languages with
tessellation stages draw by it, and the reflection tells it to the host.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from ...support.frozen import frozen
from ..diagnostics.source import Span
from .primitives import CORNERS, DrawnPrimitive
from .stages import PATCH_COORDINATE, PATCH_WEIGHTS, SystemInput

Patch = Literal["triangle", "quad", "isoline"]

Spacing = Literal["equal", "fractional_even", "fractional_odd"]
"""The spacing of the steps of an edge.

``equal``: a whole number of steps that are all alike. ``fractional_even``, ``fractional_odd``: an
even or odd number of steps, of which two grow out of nothing as the level rises.
"""

MOST_POINTS = 32
"""No patch has more control points."""
MOST_LEVEL = 64
"""No edge is divided into more steps."""


@frozen
class PatchKind:
    """The properties that all patches of one kind share."""

    ends: int
    """The number of control points that are its corners.

    Those of a quad go round it: they lie at (0, 0), (1, 0), (1, 1) and (0, 1). A line begins at the
    first one, and ends at the other.
    """
    edges: tuple[tuple[int, int] | None, ...]
    """For each ``EDGE_LEVEL``, between which ends the edge lies; ``None`` for the number of lines.

    The order is Direct3D's: the edges of a triangle across from its ends, and those of a quad at u
    = 0, v = 0, u = 1 and v = 1.
    """
    inner: tuple[tuple[int, ...], ...]
    """For each ``INNER_LEVEL``, the numbers of the edges that are divided in its direction."""
    coordinate: SystemInput
    """The input that holds the place of a vertex in the patch."""
    drawn: DrawnPrimitive
    """The primitives into which it is divided."""

    @property
    def cell(self) -> int:
        """The number of vertices of each of these primitives."""
        return CORNERS[self.drawn]


PATCH_KINDS: Mapping[Patch, PatchKind] = {
    "triangle": PatchKind(3, ((1, 2), (2, 0), (0, 1)), ((0, 1, 2),), PATCH_WEIGHTS, "triangle"),
    "quad": PatchKind(
        4, ((0, 3), (0, 1), (1, 2), (3, 2)), ((1, 3), (0, 2)), PATCH_COORDINATE, "triangle"
    ),
    "isoline": PatchKind(2, (None, (0, 1)), (), PATCH_COORDINATE, "line"),
}  # fmt: skip


@frozen
class Tessellation:
    """The division of each patch; the results of the control stage are the levels."""

    patch: Patch
    points: int
    """The number of control points of a patch, each of which is a vertex of the mesh."""
    ends: tuple[int, ...]
    """The control points that are its corners, in the order of ``PatchKind.ends``."""
    spacing: Spacing
    span: Span
    """The span that names the kind of patch."""

    @property
    def kind(self) -> PatchKind:
        """The properties that it shares with other patches of its kind."""
        return PATCH_KINDS[self.patch]

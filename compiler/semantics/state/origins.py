"""The origins of vertices, in a surface that turns the primitives of a mesh into others.

Values at the vertices of the mesh have to get to the vertices that are made of them: as they are at
one corner of the primitive, or as a mean of several. ``crossings.py`` asks for that.
"""

from __future__ import annotations

from collections.abc import Sequence

from ....support.frozen import frozen
from ...ir import build
from ...ir.node import Graph, Node
from ...ir.stages import CONTROL_POINT, CORNER, OF_PATCH, Crossing
from ...ir.tessellation import Patch
from ...ir.types import INT, scalar_kind


@frozen
class OneCorner:
    """Each vertex that is emitted is like one corner of the primitive."""

    number: Node
    crossing: Crossing = CORNER
    """The crossing of a corner's value to the vertex."""
    patch: MixedEnds | None = None
    """The place of the corner itself in its patch, if the primitive is a part of one."""

    def value(self, graph: Graph, part: Node, *, is_of_instance: bool) -> Node:
        """A value of the mesh at this vertex."""
        if self.patch is not None:
            part = self.patch.value(graph, part, is_of_instance=is_of_instance)
        number = build.constant(graph, INT, 0) if is_of_instance else self.number
        return build.at_corner(graph, part, number, self.crossing)

    def of_patch(self, graph: Graph, part: Node) -> Node:
        """A value that is the same all over the patch that the primitive is a part of."""
        assert self.patch is not None
        there = self.patch.of_patch(graph, part)
        return build.at_corner(graph, there, build.constant(graph, INT, 0), self.crossing)


@frozen
class MixedEnds:
    """Each vertex of a patch lies between its ends."""

    patch: Patch
    ends: tuple[int, ...]
    """The numbers of these control points."""
    coordinate: Node
    """The place of the vertex in the patch."""

    def value(self, graph: Graph, part: Node, *, is_of_instance: bool) -> Node:
        """A value of the mesh at this vertex; a value that is no float is that of the first end."""
        ends = [
            build.at_corner(graph, part, build.constant(graph, INT, end), CONTROL_POINT)
            for end in self.ends
        ]
        if is_of_instance or scalar_kind(part.type) != "float":
            return ends[0]
        return self._mixed(graph, ends)

    def of_patch(self, graph: Graph, part: Node) -> Node:
        """A value that is the same all over the patch."""
        return build.cross(graph, part, OF_PATCH)

    def _mixed(self, graph: Graph, ends: Sequence[Node]) -> Node:
        """Weighted by a triangle's coordinate; or blended along u, and for a quad along v then."""
        type_ = ends[0].type
        if self.patch == "triangle":
            shares = [
                graph.node("call", type_, (end, build.swizzle(graph, self.coordinate, (k,))), "mul")
                for k, end in enumerate(ends)
            ]
            pair = graph.node("call", type_, (shares[0], shares[1]), "add")
            return graph.node("call", type_, (pair, shares[2]), "add")
        u, v = (build.swizzle(graph, self.coordinate, (lane,)) for lane in (0, 1))
        below = graph.node("call", type_, (ends[0], ends[1], u), "mix")
        if self.patch == "isoline":
            return below
        above = graph.node("call", type_, (ends[3], ends[2], u), "mix")
        return graph.node("call", type_, (below, above, v), "mix")


Origin = OneCorner | MixedEnds

"""Vertices of divided patches, as those of a draw that has an instance for each patch.

``lower_tessellation`` uses it for vertices that are drawn, and ``expanded_corners.py`` for those at
the corners of what is expanded; ``lower_stages.py`` calls ``count_captured`` where the stages
themselves are wanted. Where a vertex lies in its patch is a vertex input if a host
divides all patches alike. Otherwise it is computed from the number of the vertex.
"""

from __future__ import annotations

from collections.abc import Sequence

from ...support.frozen import changed
from ..ir import build
from ..ir.leaves import Attribute
from ..ir.node import Graph, Node
from ..ir.operations import CROSS, INPUT
from ..ir.ranges import Ranges
from ..ir.rewrite import rewrite
from ..ir.shader import AttributeInfo, MeshInput, PatchPattern, Result, Shader
from ..ir.stages import (
    CONTROL,
    EDGE_LEVEL,
    FLAT,
    INNER_LEVEL,
    PATCH_INDEX,
    PATTERN_VERTEX,
    SMOOTH,
    TESSELLATED,
    VERTICES,
    SystemInput,
)
from ..ir.tessellation import MOST_LEVEL, Tessellation
from .corner_inputs import CornerInputs


def levels_of(shader: Shader) -> tuple[Result, ...]:
    """The tessellation levels: into how many steps a patch is divided."""
    return tuple(result for result in shader.results if result.stage == CONTROL)


def most_cells(patches: Tessellation, levels: Sequence[Result]) -> int:
    """The largest number of triangles or lines into which a patch is divided."""
    from ..reference.tessellation import divided

    ranges = Ranges(())
    edges, inside = (
        [min(ranges.of(level.value).hi, MOST_LEVEL) for level in levels if level.kind == kind]
        for kind in (EDGE_LEVEL, INNER_LEVEL)
    )
    return len(divided(patches.patch, edges, inside, patches.spacing).cells)


def count_captured(shader: Shader) -> Shader:
    """Notes the largest number of vertices that stages make of each patch, if it captures them.

    A host has to make room for so many.
    """
    patches, expansion = shader.tessellation, shader.expansion
    if patches is None or shader.capture is None:
        return shader
    each = patches.kind.cell if expansion is None else expansion.listed
    return changed(shader, listed=each * most_cells(patches, levels_of(shader)))


class PatchVertices:
    """Makes vertices of a draw of those in patches, and collects the inputs that they read."""

    def __init__(self, shader: Shader, patches: Tessellation) -> None:
        self._shader = shader
        self._patches = patches
        self._row = patches.kind.coordinate
        self._inputs = CornerInputs(shader, patches.points, patches.span)
        self._known: dict[Node, dict[Node, Node]] = {}
        """For each vertex, by its place or its number, the values there by those they replace."""

    @property
    def attributes(self) -> tuple[AttributeInfo, ...]:
        """The vertex inputs that are read."""
        return self._inputs.attributes

    @property
    def index(self) -> Node:
        """The number of the patch."""
        return self._inputs.number(PATCH_INDEX)

    def at(self, value: Node, place: Node) -> Node:
        """A value of the vertex that lies at this place of its patch."""
        return self._with(value, self._row, place)

    def place(self, number: Node) -> Node:
        """The place in its patch of the vertex with this number."""
        place = self._with(self._pattern.place, PATTERN_VERTEX, number)
        self._shader.notes.names.setdefault(place.id, self._row.name)
        return place

    def is_there(self, number: Node) -> Node:
        """A condition: the patch is divided so finely that it has the vertex with this number."""
        return self._with(self._pattern.is_there, PATTERN_VERTEX, number)

    def given_place(self, corner: int | None = None) -> Node:
        """The place of the vertex, or of a ``corner`` of its primitive, as a vertex input."""
        row = self._row
        of_corner = "" if corner is None else f"corner{corner}."
        leaf = Attribute(f"pattern.{of_corner}{row.name}", row.type, step=VERTICES)
        mesh = MeshInput(row.name, corner, is_of_pattern=True)
        return self._inputs.added(
            AttributeInfo(leaf, str(row.type), "", self._patches.span, mesh=mesh)
        )

    @property
    def _pattern(self) -> PatchPattern:
        assert self._shader.pattern is not None
        return self._shader.pattern

    def _with(self, value: Node, row: SystemInput, known: Node) -> Node:
        """A value at the vertex of which this is known."""

        def rule(graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
            if node.op == "cross":
                return self._crossed(graph, node, operands)
            read = INPUT.data(node)
            if read == PATCH_INDEX:
                return self.index
            return known if read == row else None

        graph, follow = self._shader.graph, self._shader.notes.follow
        new = self._known.setdefault(known, {})
        return rewrite(graph, (value,), rule, follow, ("cross", "input"), new=new)[0]

    def _crossed(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node:
        crossing = CROSS.data(node)
        if crossing.mode == "corner":
            return self._inputs.at_corner(*operands)
        if crossing.destination == TESSELLATED:
            return operands[0]  # Each vertex can compute the values of its patch.
        return build.cross(graph, operands[0], FLAT if crossing.mode == "flat" else SMOOTH)

"""Tessellations without their stages: each patch of the mesh is drawn as an instance.

``lower_stages`` calls ``lower_tessellation`` before all passes. What the mesh has at the control
points are vertex inputs per instance, one for each that is read. Where the vertices lie in their
patch:

- If all patches of a draw are divided alike, the host computes into how many steps, once for the
  draw, and makes the pattern of triangles or lines. Its points are the vertices of the draw, and
  where they lie is a vertex input.
- If not, an instance has as many vertices as its patch can have at most, and each of them finds out
  by its number where it lies, if it is there at all: the library's tessellator says so. A triangle
  or line that the patch does not have has all its vertices in one place, beyond the picture.

Their order is that of the tessellator: patch after patch.
"""

from __future__ import annotations

from collections.abc import Sequence

from ...frozen import changed
from ..ir import build
from ..ir.leaves import Attribute
from ..ir.node import Graph, Node, reachable
from ..ir.operations import CROSS, INPUT
from ..ir.ranges import Ranges
from ..ir.rewrite import rewrite
from ..ir.shader import AttributeInfo, MeshInput, Result, Shader
from ..ir.stages import (
    CLIP_POSITION,
    CONTROL,
    EDGE_LEVEL,
    EVALUATION,
    FLAT,
    INNER_LEVEL,
    PATCH_INDEX,
    PATTERN_VERTEX,
    RASTERISED,
    SMOOTH,
    TESSELLATED,
    VERTEX,
    VERTICES,
)
from ..ir.tessellation import MOST_LEVEL, Tessellation
from .corner_inputs import CornerInputs, listed_vertex, placed


def lower_tessellation(shader: Shader) -> Shader:
    """The shader with vertices instead of vertices in patches; itself if it divides none."""
    patches = shader.tessellation
    if patches is None:
        return shader
    before = len(shader.graph)
    levels = tuple(result for result in shader.results if result.stage == CONTROL)
    by_host = shader.pattern is None
    count = 0 if by_host else most_vertices(patches, levels)
    lowering = _Lowering(shader, patches, count)
    drawn = [result for result in shader.results if result.stage != CONTROL]
    results = [lowering.lowered(result) for result in drawn]
    # What tells the vertices apart stands nowhere, but where the tessellation does.
    for node in reachable([result.value for result in results]):
        if node.id >= before:
            shader.notes.spans.setdefault(node.id, patches.span)
    return changed(
        shader,
        results=tuple(results),
        attributes=lowering.attributes,
        chain=RASTERISED,
        levels=levels if by_host else (),
        listed=count,
    )


def most_vertices(patches: Tessellation, levels: Sequence[Result]) -> int:
    """How many vertices a patch has at most, as a list of triangles or of lines."""
    from ..reference.tessellation import divided

    ranges = Ranges(())
    edges, inside = (
        [_bounded(ranges.of(level.value).hi) for level in levels if level.kind == kind]
        for kind in (EDGE_LEVEL, INNER_LEVEL)
    )
    cells = divided(patches.patch, edges, inside, patches.spacing).cells
    return patches.kind.cell * len(cells)


def _bounded(level: float) -> float:
    return min(level, MOST_LEVEL)


class _Lowering:
    """Makes vertices of those in patches, and collects what these read of the mesh."""

    def __init__(self, shader: Shader, patches: Tessellation, count: int) -> None:
        """A patch has ``count`` vertices if the shader tells where they lie."""
        self._shader = shader
        self._patches = patches
        self._pattern = shader.pattern
        self._count = count
        self._inputs = CornerInputs(shader, patches.points, patches.span)
        self._known: dict[Node, Node] = {}

    @property
    def attributes(self) -> tuple[AttributeInfo, ...]:
        """The vertex inputs that are read."""
        return self._inputs.attributes

    def lowered(self, result: Result) -> Result:
        """A result of the evaluation stage as one of the vertices, and the fragments' own."""
        value = self._value(result.value)
        if result.stage != EVALUATION:
            return changed(result, value=value)
        if result.kind == CLIP_POSITION and self._pattern is not None:
            value = placed(self._shader, self._value(self._pattern.is_there), value)
        return changed(result, stage=VERTEX, value=value)

    def _value(self, value: Node) -> Node:
        graph, follow = self._shader.graph, self._shader.notes.follow
        ops = ("cross", "input")
        return rewrite(graph, (value,), self._rule, follow, ops, new=self._known)[0]

    def _rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        if node.op == "input":
            row = INPUT.data(node)
            if row == PATCH_INDEX:
                return self._inputs.number(row)
            if row == PATTERN_VERTEX:
                return listed_vertex(graph, self._count)
            return self._coordinate() if row.domain == TESSELLATED else None
        crossing = CROSS.data(node)
        if crossing.mode == "corner":
            return self._inputs.at_corner(*operands)
        if crossing.destination == TESSELLATED:
            return operands[0]  # What a patch has, each of its vertices can compute.
        return build.cross(graph, operands[0], FLAT if crossing.mode == "flat" else SMOOTH)

    def _coordinate(self) -> Node:
        """Where the vertex lies in its patch."""
        if self._pattern is not None:
            place = self._value(self._pattern.place)
            self._shader.notes.names.setdefault(place.id, self._patches.kind.coordinate.name)
            return place
        row = self._patches.kind.coordinate
        leaf = Attribute(f"pattern.{row.name}", row.type, VERTICES)
        mesh = MeshInput(row.name, is_of_pattern=True)
        return self._inputs.added(
            AttributeInfo(leaf, str(row.type), "", self._patches.span, mesh=mesh)
        )

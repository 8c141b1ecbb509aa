"""Tessellations without their stages: each patch of the mesh is drawn as an instance.

``api.py`` calls ``lower_tessellation`` before all passes. If all patches of a draw are divided
alike, the host computes into how many steps, once for the draw, and makes the pattern of triangles.
Its points are the vertices of the draw, and where they lie in a patch is a vertex input. What the
mesh has at the control points are vertex inputs per instance, one for each that is read. The order
of triangles is that of the tessellator: patch after patch.
"""

from __future__ import annotations

from ...frozen import changed
from ..ir import build
from ..ir.domains import Domains
from ..ir.leaves import Attribute
from ..ir.node import Graph, Node, reachable
from ..ir.operations import CROSS, INPUT
from ..ir.rewrite import rewrite
from ..ir.shader import AttributeInfo, MeshInput, Result, Shader
from ..ir.stages import (
    CONTROL,
    EVALUATION,
    FLAT,
    PATCH_INDEX,
    RASTERISED,
    SMOOTH,
    TESSELLATED,
    VERTEX,
    VERTICES,
)
from ..ir.tessellation import Tessellation
from .corner_inputs import CornerInputs

_KNOWN_TO_HOST = frozenset(
    {"constant", "parameter", "call", "select", "vector", "splat", "matrix", "swizzle", "index"}
    | {"member", "apply", "bound", "fold"}
)
"""Operations by which a host computes levels."""


def lower_tessellation(shader: Shader) -> Shader:
    """The shader with vertices instead of vertices in patches; itself if it divides none, or if the
    host cannot divide all of them alike."""
    patches = shader.tessellation
    if patches is None or not _can_divide(shader, patches):
        return shader
    before = len(shader.graph)
    lowering = _Lowering(shader, patches)
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
        levels=tuple(result for result in shader.results if result.stage == CONTROL),
    )


def _can_divide(shader: Shader, patches: Tessellation) -> bool:
    """Whether a host can make the pattern: of triangles, by levels that it can compute."""
    levels = [result.value for result in shader.results if result.stage == CONTROL]
    domains = Domains()
    return (
        patches.kind.cell == 3
        and all(domains.of(level) is None for level in levels)
        and all(node.op in _KNOWN_TO_HOST for node in reachable(levels))
    )


class _Lowering:
    """Makes vertices of those in patches, and collects what these read of the mesh."""

    def __init__(self, shader: Shader, patches: Tessellation) -> None:
        self._shader = shader
        self._patches = patches
        self._inputs = CornerInputs(shader, patches.points, patches.span)
        self._known: dict[Node, Node] = {}

    @property
    def attributes(self) -> tuple[AttributeInfo, ...]:
        """The vertex inputs that are read."""
        return self._inputs.attributes

    def lowered(self, result: Result) -> Result:
        """A result of the evaluation stage as one of the vertices, and the fragments' own."""
        graph, follow = self._shader.graph, self._shader.notes.follow
        ops = ("cross", "input")
        (value,) = rewrite(graph, (result.value,), self._rule, follow, ops, new=self._known)
        stage = VERTEX if result.stage == EVALUATION else result.stage
        return changed(result, stage=stage, value=value)

    def _rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        if node.op == "input":
            row = INPUT.data(node)
            if row == PATCH_INDEX:
                return self._inputs.number(row)
            return self._coordinate() if row.domain == TESSELLATED else None
        crossing = CROSS.data(node)
        if crossing.mode == "corner":
            return self._inputs.at_corner(*operands)
        if crossing.destination == TESSELLATED:
            return operands[0]  # What a patch has, each of its vertices can compute.
        return build.cross(graph, operands[0], FLAT if crossing.mode == "flat" else SMOOTH)

    def _coordinate(self) -> Node:
        """Where the vertex lies in its patch."""
        row = self._patches.kind.coordinate
        leaf = Attribute(f"pattern.{row.name}", row.type, VERTICES)
        mesh = MeshInput(row.name, is_of_pattern=True)
        return self._inputs.added(
            AttributeInfo(leaf, str(row.type), "", self._patches.span, mesh=mesh)
        )

"""Tessellations without their stages: each patch of the mesh is drawn as an instance.

``lower_stages`` calls ``lower_tessellation`` before all passes. The attributes of the mesh at the
control points are vertex inputs per instance, one for each that is read. The places of the vertices
in their patch are found in one of two ways:

- If all patches of a draw are divided alike, the host computes the levels once for the draw, and
  makes the pattern of triangles or lines. Its points are the vertices of the draw, and their places
  are a vertex input.
- If not, an instance has as many vertices as its patch can have at most, and each of them finds out
  its place by its number, if it is there at all: the library's tessellator says so. A triangle or
  line that the patch does not have has all its vertices in one place, beyond the picture. If
  vertices are captured, this is always done, and those that are not there are left out.

Their order is that of the tessellator: patch after patch.
"""

from __future__ import annotations

from ...support.frozen import changed
from ..ir.node import reachable
from ..ir.shader import Result, Shader
from ..ir.stages import CAPTURED, CLIP_POSITION, CONTROL, EMITTING, EVALUATION, RASTERISED, VERTEX
from .corner_inputs import listed_vertex, placed
from .patch_vertices import PatchVertices, levels_of, most_cells


def lower_tessellation(shader: Shader) -> Shader:
    """The shader with vertices instead of vertices in patches; itself if it divides none."""
    patches = shader.tessellation
    if patches is None or EVALUATION not in shader.chain:
        return shader
    before = len(shader.graph)
    levels = levels_of(shader)
    vertices = PatchVertices(shader, patches)
    by_host, count, drawn = shader.pattern is None, 0, None
    if by_host:
        place = vertices.given_place()
    else:
        count = patches.kind.cell * most_cells(patches, levels)
        number = listed_vertex(shader.graph, count)
        place, drawn = vertices.place(number), vertices.is_there(number)
    results = []
    for result in shader.results:
        if result.stage == CONTROL:
            continue
        value, row = vertices.at(result.value, place), result.stage
        if row == EVALUATION:
            row = VERTEX
            if result.kind == CLIP_POSITION and drawn is not None:
                value = placed(shader, drawn, value)
        results.append(changed(result, stage=row, value=value))
    if drawn is not None and shader.capture is not None:
        results.append(Result(EMITTING, VERTEX, drawn))
    # The vertices' numbers have no place of their own: they get that of the tessellation.
    for node in reachable([result.value for result in results]):
        if node.id >= before:
            shader.notes.spans.setdefault(node.id, patches.span)
    return changed(
        shader,
        results=tuple(results),
        attributes=vertices.attributes,
        chain=RASTERISED if shader.capture is None else CAPTURED,
        levels=levels if by_host else (),
        listed=count,
    )

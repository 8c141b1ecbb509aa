"""Kernels over images as full-screen passes: each texel is the pixel of a render target.

A triangle without vertex inputs covers the whole picture, and the place of a pixel is that of the
texel. So an image has the same values as a kernel writes, and any profile can make it. The pipeline
calls ``full_screen`` behind all passes but the last one, for the profiles that cannot write images
(``Profile.image_formats``), and the reference draws every kernel over images in this form.
"""

from __future__ import annotations

from ...support.frozen import changed
from . import build
from .node import Graph, Node
from .rewrite import rewrite
from .shader import Result, Shader
from .stages import (
    CLIP_POSITION,
    FRAGMENT,
    IMAGE,
    RASTERISED,
    TARGET,
    VERTEX,
    SystemInput,
    inputs_of,
)
from .types import BOOL, FLOAT, IVEC2, UINT, VEC4, width

CORNERS = 3
"""The number of vertices that a host draws."""

_INPUTS = inputs_of(RASTERISED)
_NEAR, _FAR = -1.0, 3.0
"""The ends of the triangle in clip space, in each direction: it covers -1..1 twice."""


def writes_images(shader: Shader) -> bool:
    """True if a shader is a kernel over images."""
    return bool(shader.results_of(IMAGE))


def whole_texels(shader: Shader) -> Shader:
    """A kernel with four lanes in each texel of its images, as every API writes these."""
    results = tuple(
        changed(result, value=_whole(shader.graph, result.value))
        if result.kind == IMAGE
        else result
        for result in shader.results
    )
    return changed(shader, results=results)


def _whole(graph: Graph, value: Node) -> Node:
    missing = (0.0, 0.0, 1.0)[width(value.type) - 1 :]
    return build.vector(graph, (value, *(build.floating(graph, lane) for lane in missing)))


def full_screen(shader: Shader) -> Shader:
    """A kernel over images as a pass that draws them, from a graph in any form."""
    graph = shader.graph
    images = shader.results_of(IMAGE)
    texel = _texel(shader)

    def rule(_graph: Graph, _node: Node, _operands: tuple[Node, ...]) -> Node:
        return texel

    given = [result.value for result in images]
    values = rewrite(graph, given, rule, shader.notes.follow, ("input",))
    position = _position(graph)
    spans = shader.notes.spans
    if span := spans.get(images[0].value.id):
        for node in (texel, *texel.operands, position):
            spans.setdefault(node.id, span)
    targets = (
        changed(result, kind=TARGET, stage=FRAGMENT, value=value)
        for result, value in zip(images, values, strict=True)
    )
    results = (Result(CLIP_POSITION, VERTEX, position), *targets)
    return changed(shader, results=results, chain=RASTERISED, work_group=None)


def _texel(shader: Shader) -> Node:
    """The place of a pixel as whole numbers; the centre of the first one lies at a half."""
    graph = shader.graph
    centre = build.swizzle(graph, _input(graph, "frag_coord"), (0, 1))
    texel = graph.node("native", IVEC2, (centre,), "to_int")
    shader.notes.names.setdefault(texel.id, "texel")
    return texel


def _position(graph: Graph) -> Node:
    """The position of a vertex of the triangle that covers the picture.

    The second vertex is far to the right, the third far up.
    """
    number = _input(graph, "vertex_index")
    near, far = (build.constant(graph, FLOAT, place) for place in (_NEAR, _FAR))

    def beyond(vertex: int) -> Node:
        which = build.constant(graph, UINT, vertex)
        condition = graph.node("native", BOOL, (number, which), "eq")
        return graph.node("select", FLOAT, (condition, far, near))

    depth = build.constant(graph, FLOAT, 0.0)
    place = build.vector(graph, (beyond(1), beyond(2), depth, build.constant(graph, FLOAT, 1.0)))
    assert place.type == VEC4
    return place


def _input(graph: Graph, name: str) -> Node:
    row: SystemInput = _INPUTS[name]
    return graph.node("input", row.type, (), row)

"""Binds the vertices of a draw."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

import moderngl

from ..draws import Draw
from ..pipeline import Pipeline, Primitive, StepMode
from .program import attribute_layout

RATES: Mapping[StepMode, str] = {"vertex": "/v", "instance": "/i"}
"""The suffix of moderngl's layouts for each rate."""

MODES: Mapping[Primitive, int] = {
    "point": moderngl.POINTS,
    "line": moderngl.LINES,
    "triangle": moderngl.TRIANGLES,
    "line_adjacency": moderngl.LINES_ADJACENCY,
    "triangle_adjacency": moderngl.TRIANGLES_ADJACENCY,
    "patch": moderngl.PATCHES,
}


@contextmanager
def vertices(
    context: moderngl.Context, program: moderngl.Program, pipeline: Pipeline, draw: Draw
) -> Iterator[moderngl.VertexArray]:
    """The vertices of a draw; its blocks, textures and buffers are bound elsewhere."""
    for name in pipeline.host_uniforms:
        uniform = program.get(name, None)
        if isinstance(uniform, moderngl.Uniform):
            uniform.value = float(draw.height)
    attributes = [
        (
            context.buffer(data),
            f"{attribute_layout(slot.format)}{RATES[slot.step]}",
            slot.identifier,
        )
        for slot, data in zip(pipeline.inputs, draw.vertices, strict=True)
        if program.get(slot.identifier, None) is not None
    ]
    indices = context.buffer(draw.indices)
    array = context.vertex_array(program, attributes, index_buffer=indices, index_element_size=4)
    yield array

"""Tessellates patches with Mesa's llvmpipe, as a process of its own.

``test_tessellation.py`` sends a JSON list of cases (kind of patch, spacing, four levels of edges,
two of the inside) and gets, for each, its triangles or lines: nested lists of the points' places in
units of 2^-16. moderngl cannot capture patches, so a geometry shader writes them into a buffer.
"""

from __future__ import annotations

import json
import sys
from typing import Any

import moderngl
import numpy as np

from burnish.targets.runner.drivers.opengl.context import create_context

MOST_POINTS = 40000
KINDS = {"triangle": "triangles", "quad": "quads", "isolines": "isolines"}

VERTEX = "#version 450\nvoid main() {}"
CONTROL = "#version 450\nlayout(vertices = 1) out;\nvoid main() {{ {levels} }}"
EVALUATION = """#version 450
layout({kind}, {spacing}_spacing, ccw) in;
out vec3 place;
void main() {{ place = gl_TessCoord; }}
"""
GEOMETRY = """#version 450
layout({shape}s) in;
layout(points, max_vertices = 1) out;
in vec3 place[];
layout(std430, binding = 0) buffer Found {{ uint count; vec4 places[]; }};
void main() {{
    uint start = atomicAdd(count, {corners});
    for (int i = 0; i < {corners}; ++i) places[start + i] = vec4(place[i], 0);
}}
"""
FRAGMENT = "#version 450\nvoid main() {}"


def cells(context: Any, kind: str, spacing: str, edges: Any, inside: Any) -> Any:
    """The triangles or lines of one patch."""
    corners = 2 if kind == "isolines" else 3
    shape = "line" if kind == "isolines" else "triangle"
    levels = [f"gl_TessLevelOuter[{i}] = {float(x)!r};" for i, x in enumerate(edges)]
    levels += [f"gl_TessLevelInner[{i}] = {float(x)!r};" for i, x in enumerate(inside)]
    program = context.program(
        vertex_shader=VERTEX,
        tess_control_shader=CONTROL.format(levels=" ".join(levels)),
        tess_evaluation_shader=EVALUATION.format(kind=KINDS[kind], spacing=spacing),
        geometry_shader=GEOMETRY.format(shape=shape, corners=corners),
        fragment_shader=FRAGMENT,
    )
    drawn = context.vertex_array(program, [])
    buffer = context.buffer(data=bytes(16 + 16 * MOST_POINTS))
    buffer.bind_to_storage_buffer(0)
    drawn.render(moderngl.PATCHES, vertices=1)
    context.finish()
    data = buffer.read()
    for made in (drawn, program, buffer):
        made.release()
    count = int(np.frombuffer(data[:4], np.uint32)[0])
    assert count <= MOST_POINTS
    places = np.frombuffer(data[16 : 16 + 16 * count], np.float32).reshape(-1, corners, 4)
    return np.rint(places[..., :3] * 2.0**16).astype(int).tolist()


def main() -> None:
    """Answer the cases of the standard input."""
    context: Any = create_context(None)
    context.patch_vertices = 1
    context.simple_framebuffer((4, 4)).use()
    json.dump([cells(context, *case) for case in json.load(sys.stdin)], sys.stdout)


if __name__ == "__main__":
    main()

"""The points, lines and triangles of a mesh, and what is drawn where they are expanded."""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.targets.runner.expanded_draws import as_drawn
from burnish.targets.runner.meshes import MESHES, Mesh, MeshError, mesh
from burnish.targets.runner.primitives import PRIMITIVES, primitives
from burnish.targets.runner.scene import vertex_data, with_inputs

SQUARE = Mesh(
    {"position": np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [9, 9, 9]], float)},
    np.array([[0, 1, 2], [0, 2, 3]]),
)
"""Two triangles that share an edge, and a vertex that none has."""

OF_SQUARE = {
    "point": [[0], [1], [2], [3]],
    "line": [[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]],
    "triangle": [[0, 1, 2], [0, 2, 3]],
    "line_adjacency": [[2, 0, 1, 2], [0, 1, 2, 0], [1, 2, 0, 3], [0, 2, 3, 0], [2, 3, 0, 2]],
    "triangle_adjacency": [[0, 2, 1, 0, 2, 3], [0, 1, 2, 0, 3, 2]],
}


@pytest.mark.parametrize("kind", PRIMITIVES)
def test_primitives(kind: str) -> None:
    assert primitives(SQUARE, kind).tolist() == OF_SQUARE[kind]


@pytest.mark.parametrize("name", MESHES)
def test_across_every_edge_of_a_closed_mesh_lies_another_triangle(name: str) -> None:
    found = primitives(mesh(name), "triangle_adjacency")
    own, across = found[:, ::2], found[:, 1::2]
    back = np.roll(own, 1, axis=1)
    borders = int((across == back).sum())
    assert (borders == 0) == (name not in ("plane", "floor"))


def test_seams_are_no_borders() -> None:
    """Vertices in one place count as one: a cube has 12 edges, and six diagonals."""
    assert len(primitives(mesh("cube"), "line")) == 18
    assert len(primitives(mesh("cube"), "point")) == 24


MATERIAL = """material M {{
    attribute shift : vec2 per instance
    expand {primitive} {{ strip of 4 as i like corner[0] {{
        uv = corner[{last}].uv + shift  position = corner[0].position
    }} }}
    color = vec3(uv, float(primitive_index) + float(instance_index) + float(vertex_index))
}}"""


@pytest.mark.parametrize(("primitive", "last"), [("point", 0), ("line", 1), ("triangle", 2)])
def test_each_primitive_of_each_instance_is_an_instance(primitive: str, last: int) -> None:
    (material,) = burnish.compile(MATERIAL.format(primitive=primitive, last=last), "wgsl").materials
    whole = with_inputs(material.reflection, mesh("cube"), 3)
    assert whole.instance_count == 3
    data = vertex_data(material.reflection, whole)
    drawn = as_drawn(material.instance(), data, whole)
    corners = primitives(whole, primitive)
    count = len(corners)
    assert drawn.instance_count == 3 * count
    assert drawn.corners.tolist() == [[0, 1, 2], [3, 4, 5]]
    found = drawn.attributes
    assert set(found) == {
        "corner0.vertex_position", f"corner{last}.vertex_uv", "shift", "corner0.vertex_index",
        "draw.instance_index", "draw.primitive_index",
    }  # fmt: skip
    for copy in range(3):
        of_copy = slice(copy * count, (copy + 1) * count)
        position = data["vertex_position"][corners[:, 0]]
        assert (found["corner0.vertex_position"][of_copy] == position).all()
        uv = data["vertex_uv"][corners[:, last]]
        assert (found[f"corner{last}.vertex_uv"][of_copy] == uv).all()
        assert (found["shift"][of_copy] == data["shift"][copy]).all()
        assert (found["corner0.vertex_index"][of_copy, 0] == corners[:, 0]).all()
        assert (found["draw.instance_index"][of_copy] == copy).all()
        assert (found["draw.primitive_index"][of_copy, 0] == np.arange(count)).all()


def test_a_mesh_without_primitives_is_refused() -> None:
    (material,) = burnish.compile(
        "material M { expand line { strip of 4 like corner[0] {} } }", "wgsl"
    )
    empty = Mesh(SQUARE.channels, np.zeros((0, 3), np.int64))
    with pytest.raises(MeshError, match="the mesh has no line to expand"):
        as_drawn(material.instance(), {}, empty)


@pytest.mark.parametrize("native_stages", [True, False])
def test_nothing_is_captured_of_a_mesh_without_triangles(native_stages: bool) -> None:
    """Neither by a stream output nor by a kernel."""
    text = "material M { color = vec3(1) } pass P { capture position : vec3 = position }"
    (material,) = burnish.compile(text, "glsl:vulkan", pass_="P", native_stages=native_stages)
    empty = Mesh(SQUARE.channels, np.zeros((0, 3), np.int64))
    with pytest.raises(MeshError, match="the mesh has no triangle to capture"):
        as_drawn(material.instance(), {}, empty)

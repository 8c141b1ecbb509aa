"""A value that depends on one corner of a primitive alone is computed by the stage before.

``fur`` and others do this with normals.
"""

from __future__ import annotations

import burnish

EXPANDED = """
material M : Surface {{
    param bend : mat3 = mat3(1)
    expand triangle {{ strip of 3 as i {{ {} }} }}
}}
"""
DIVIDED = """
material M : Surface {{
    param bend : mat3 = mat3(1)
    tessellate triangle by 2 {{ {} }}
}}
"""


def texts(text: str, stage: str) -> tuple[str, str]:
    """The texts of the vertex stage and of another one."""
    (material,) = burnish.compile(text, "glsl:vulkan", native_stages=True)
    return material.text("glsl:vulkan", "vertex"), material.text("glsl:vulkan", stage)


def test_what_depends_on_one_corner_is_computed_for_each_vertex() -> None:
    position = "position = corner[i].position + sin(bend * corner[i].normal) * float(i)"
    vertex, geometry = texts(EXPANDED.format(position), "geometry")
    assert "sin(" in vertex and "sin(" not in geometry
    assert "bend" not in geometry


def test_so_does_a_patch() -> None:
    position = "position = inherited.position + sin(bend * corner[1].normal)"
    vertex, evaluation = texts(DIVIDED.format(position), "evaluation")
    assert "sin(" not in evaluation and "sin(" in vertex


def test_a_value_that_is_read_as_it_is_crosses_alone() -> None:
    position = "position = corner[i].position + sin(corner[i].position) * float(i)"
    vertex, geometry = texts(EXPANDED.format(position), "geometry")
    assert "sin(" not in vertex and "sin(" in geometry


def test_values_of_two_corners_are_joined_where_both_are_known() -> None:
    position = "position = corner[i].position * dot(corner[0].normal, corner[1].normal)"
    _, geometry = texts(EXPANDED.format(position), "geometry")
    assert "dot(" in geometry.split("void main")[1]


def test_two_uses_of_a_value_move_only_if_no_more_crosses() -> None:
    position = "position = sin(corner[i].normal) * float(i) + cos(corner[i].normal)"
    _, geometry = texts(EXPANDED.format(position), "geometry")
    assert "sin(" in geometry and "cos(" in geometry

"""Matrices that are not square, from the declaration to the text and to the bytes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import burnish
from burnish.compiler.ir.types import MATRICES, Matrix

from ..golden import assert_golden

HERE = Path(__file__).parent

GRADED = """
/// Colours that an affine transform corrects, seen along a plane.
material Graded {
    param grade : mat4x3 per draw
    param tilt  : mat2x3 per draw

    own    = mat3x2(uv, uv.yx, vec2(1, uv.x))
    graded = grade * vec4(normal, 1)
    slope  = transpose(tilt) * graded + (own * grade)[3]
    color  = graded + tilt * slope
}
"""


@pytest.mark.parametrize("profile", ["glsl:vulkan", "hlsl:sm6", "wgsl:webgpu", "msl:metal2"])
def test_the_text_is_as_it_was(profile: str) -> None:
    (material,) = burnish.compile(GRADED, profile)
    (file,) = (file for file in material.files if "fragment" in file.entry_points)
    assert_golden(file.text, HERE / "golden" / file.name.replace("Graded", "graded"))


def test_an_old_language_multiplies_those_of_uniforms() -> None:
    text = "material M { param m : mat2x3 per draw  color = m * uv + m[1] }"
    written = burnish.compile(text, "glsl:es100")["M"].text("glsl:es100", "fragment")
    assert "uniform mat4 m;" in written
    assert "(m * vec4(v_uv, 0.0, 0.0)).xyz + m[1].xyz" in written


def test_an_old_language_has_no_others() -> None:
    with pytest.raises(burnish.CompileError, match="no matrices that are not square"):
        burnish.compile("material M { color = outer(normal, uv) * uv }", "glsl:es100")


@pytest.mark.parametrize("type_", MATRICES, ids=str)
def test_hosts_find_every_column(type_: Matrix) -> None:
    """A column takes 16 bytes in all languages, and so does the last one."""
    text = f"""material M {{
        param before : float per draw
        param turn   : {type_} per draw
        param after  : float per draw
        color = vec3((turn * vec{type_.columns}(before)).x, after, 0)
    }}"""
    reflection = burnish.compile(text, ("glsl", "hlsl", "wgsl"))["M"].reflection
    rows = {row.name: row for row in reflection.parameters}
    turn, start = rows["turn"].layout, rows["turn"].offset
    assert (turn.columns, turn.lanes, turn.column_stride) == (type_.columns, type_.rows, 16)
    assert start is not None
    assert start % 16 == 0
    assert rows["after"].offset == start + 16 * type_.columns


@pytest.mark.parametrize("left", MATRICES, ids=str)
@pytest.mark.parametrize("right", MATRICES, ids=str)
def test_a_product_has_the_rows_of_the_left_and_the_columns_of_the_right(
    left: Matrix, right: Matrix
) -> None:
    result = Matrix(right.columns, left.rows)
    text = f"""material M {{
        param a : {left} per draw
        param b : {right} per draw
        c : {result} = a * b
        color = vec3(c[0].x)
    }}"""
    if left.columns == right.rows:
        burnish.compile(text, "glsl")
        return
    with pytest.raises(burnish.CompileError) as error:
        burnish.compile(text, "glsl")
    (diagnostic,) = error.value.diagnostics
    assert f"no `*` between {left} and {right}" in diagnostic.message
    assert set(re.findall(r"mat\dx\d|mat\d", str(diagnostic.hint).partition("stands")[2])) == {
        str(other) for other in MATRICES if other.rows == left.columns
    }

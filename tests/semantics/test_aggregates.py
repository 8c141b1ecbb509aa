"""Structures, arrays and matrices as values: made, handed on, chosen, read."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.reference.namespace import Lanes

from .kit import lanes, number

HEAD = """
struct Layer { tint : rgb, width : float }
struct Stack { layers : Layer[2], shift : vec2 }
fn wide(l: Layer) -> float = 2 * l.width
fn doubled(l: Layer) -> Layer = Layer(2 * l.tint, wide(l))
fn weight(w: float[3], i: int) -> float = w[i]
fn pair(x: float) -> float[2] = [x, -x]
"""
MEMBERS = """
param n : int
param x : float
param held : Layer
param many : Layer[3]
param grid : mat3
whole : float[3] = [1, 2, 4]
own = Layer(vec3(1, 2, 3), 4)
stack = Stack([own, Layer(#fff, x)], vec2(5, 6))
"""
GIVEN: dict[str, Lanes] = {
    "n": (1,),
    "x": (0.25,),
    "held": ((7.0, 8.0, 9.0), (10.0,)),
    "many": tuple(((k, k, k), (k,)) for k in (1.0, 2.0, 3.0)),
    "grid": ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0), (7.0, 8.0, 9.0)),
}
VALUES: dict[str, float] = {
    "own.width": 4,
    "own.tint.y": 2,
    "wide(own)": 8,
    "wide(doubled(held))": 40,
    "stack.layers[1].width": 0.25,
    "stack.layers[n].width": 0.25,
    "stack.shift.y": 6,
    "(if x > 0.0 then own else held).width": 4,
    "(if x > 1.0 then own else held).width": 10,
    "(if x > 1.0 then own else many[n + 1]).tint.x": 3,
    "[own, held, many[2]][n].width": 10,
    "[own, if x > 1.0 then own else held][n].tint.z": 9,
    "whole[n]": 2,
    "whole[n + 7]": 4,
    "whole[-n]": 1,
    "[1, x, 3][n]": 0.25,
    "weight([5, 6, 7], n)": 6,
    "weight(whole, 2)": 4,
    "pair(x)[n]": -0.25,
    "(if x > 1.0 then [1, 2] else pair(3))[n]": -3,
    "[[1, 2, 3], [4, 5, 6]][n][n + 1]": 6,
    "[[1, 2, 3], [4, 5, 6]][1][n]": 5,
    "[[1.0, x], pair(x)][n][0]": 0.25,
    "float([1, 2, 3][n])": 2,
    "float([true, false][n])": 0,
    "[vec2(1, 2), vec2(3, 4)][n].y": 4,
    "[mat2(1), mat2(3)][n][1].y": 3,
    "grid[n][n + 1]": 6,
    "(if x > 1.0 then mat3(1) else grid)[2].z": 9,
    "mat4(grid)[2].z": 9,
    "mat4(grid)[3].w": 1,
    "mat4(grid)[3].x": 0,
    "mat4(grid)[1].w": 0,
    "mat3(mat2(5))[2].z": 1,
    "mat2(grid)[1].x": 4,
    "float(ivec3(vec3(1.7, -1.7, 3))[n])": -1,
}


@pytest.mark.parametrize(("text", "expected"), VALUES.items(), ids=VALUES)
def test_values(text: str, expected: float) -> None:
    assert number(text, MEMBERS, HEAD, **GIVEN) == pytest.approx(expected)


def test_a_whole_structure_is_shaded() -> None:
    assert lanes("doubled(stack.layers[0]).tint", MEMBERS, HEAD, **GIVEN) == (2, 4, 6)


def test_constant_arrays_keep_their_name() -> None:
    text = """
    struct Wave { height : float, length : float }
    waves   = [Wave(1, 2), Wave(3, 5)]
    weights = [1.0, 2.0, 4.0]
    material M {
        param n : int
        color = vec3(weights[n], waves[n].height, waves[n].length)
    }
    """
    shown = burnish.compile(text, ("hlsl:sm6",))["M"].text("hlsl:sm6", "fragment")
    assert "static const float weights[3] = {1.0, 2.0, 4.0};" in shown
    assert "static const float waves_height[2] = {1.0, 3.0};" in shown
    assert "static const float waves_length[2] = {2.0, 5.0};" in shown


RANGED = """
material M {
    param w : float[4] in 0.5..2 = [1, 2, 0.5, 1]
    param v : vec2[2] in -1..1
    param a : angle[2] in -90deg..90deg = [0, 45deg]
    param i : int in 0..3
    color = vec3(log(w[i]) + 1 / w[0], cos(a[0]), asin(v[1].y))
}"""


def test_a_range_holds_for_all_elements() -> None:
    (compiled,) = burnish.compile(RANGED, ("wgsl",), hoist=False)
    assert compiled.guards == ()
    ranges = {row.name: row.range for row in compiled.reflection.parameters}
    assert (ranges["w"], ranges["v"]) == ((0.5, 2), (-1, 1))
    instance = compiled.instance()
    with pytest.raises(burnish.ParameterError, match=r"declared in 0.5..2: 3 is not"):
        instance.set("w[1]", 3)


def test_the_default_of_an_array_lies_in_its_range() -> None:
    found = burnish.check(
        "material M { param w : float[2] in 0..1 = [0.5, 2]  color = vec3(w[0]) }"
    )
    assert [diagnostic.rule.code for diagnostic in found] == ["B0403"]

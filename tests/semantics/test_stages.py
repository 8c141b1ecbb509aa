"""The stages that compute values: an interpolated value is computed at the vertices."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.diagnostics.render import render
from burnish.compiler.ir.node import Node, reachable
from burnish.compiler.ir.operations import CROSS
from burnish.compiler.ir.stages import CLIP_POSITION, TARGET
from burnish.compiler.reference.namespace import Lanes

from .kit import Given, amid, at, shader

CORNERS: list[Given] = [
    {"vertex_uv": (0.0, 0.0), "vertex_position": (0.0, 0.0, 0.0), "mark": (5,)},
    {"vertex_uv": (3.0, 0.0), "vertex_position": (3.0, 0.0, 0.0), "mark": (6,)},
    {"vertex_uv": (0.0, 6.0), "vertex_position": (0.0, 6.0, 0.0), "mark": (7,)},
]

AMID: dict[str, float] = {
    "uv.x": 1,
    "uv.y": 2,
    "uv.x * uv.x": 1,
    "@vertex (uv.x * uv.x)": 3,
    "(@vertex uv.x) * uv.x": 1,
    "@vertex (uv.x * @vertex uv.x)": 3,
    "@vertex uv.x * uv.x": 1,
    "position.y": 2,
    "@vertex squared": 3,
    "squared": 1,
    "@vertex k": 7,
    "float(mark)": 5,
    "float(@vertex (mark * 2))": 10,
    "if @vertex (uv.x < 1) then 1 else 2": 1,
    "if uv.x < 1 then 1 else 2": 2,
}


def middle(expression: str) -> float:
    """An expression's value in the middle of ``CORNERS``."""
    members = "param k : float = 7  attribute mark : int  squared = uv.x * uv.x"
    whole = shader(f"material M {{ {members}  color = vec3({expression}) }}")
    value = amid(whole, whole.results_of(TARGET)[0].value, CORNERS)[0]
    assert isinstance(value, float)
    return value


@pytest.mark.parametrize(("expression", "expected"), AMID.items(), ids=AMID)
def test_crossing(expression: str, expected: float) -> None:
    assert middle(expression) == pytest.approx(expected)


def crossings(root: Node) -> list[Node]:
    return [node for node in reachable((root,)) if node.op == "cross"]


def test_what_does_not_vary_does_not_cross() -> None:
    whole = shader("material M { param k : float = 7  color = vec3(@vertex sqrt(k)) }")
    assert not crossings(whole.results_of(TARGET)[0].value)


def test_nothing_crosses_on_the_way_to_the_clip_position() -> None:
    text = """material M {
        moved    = position.yxz
        position = @vertex (object_to_world * vec4(vertex_position * (1 + uv.x), 1)).xyz
        clip_position = vec4(moved, 1)
    }"""
    whole = shader(text)
    assert not crossings(whole.results_of(CLIP_POSITION)[0].value)
    assert at(whole, whole.results_of(CLIP_POSITION)[0].value, CORNERS[1]) == (0, 12, 0, 1)


def test_the_default_clip_position_is_that_of_the_camera() -> None:
    whole = shader("material M {}")
    columns: Lanes = ((2.0, 0.0, 0.0, 0.0), (0.0, 2.0, 0.0, 0.0), (0.0, 0.0, 2.0, 0.0))
    given = {"view_projection": (*columns, (1.0, 0.0, 0.0, 1.0))}
    assert at(whole, whole.results_of(CLIP_POSITION)[0].value, given) == (2, 0.5, 0, 1)


def test_booleans_and_integers_cross_without_interpolation() -> None:
    text = "material M { attribute n : ivec2  color = if @vertex (n.x > 0) then 0 else vec3(n.y) }"
    whole = shader(text.replace("vec3(n.y)", "vec3(float(n.y))"))
    modes = {CROSS.data(node).mode for node in crossings(whole.results_of(TARGET)[0].value)}
    assert modes == {"flat"}


def test_a_read_is_underlined_where_it_is_wrong_and_not_where_it_is_legal() -> None:
    text = """material M {
    map albedo : texture2d
    legal = albedo(uv)
    wrong = @vertex (albedo(uv).r + 1.0)
    color = legal.rgb * wrong
}"""
    (found,) = burnish.check(text)
    assert render(found).splitlines()[:6] == [
        "error[B0502]: a texture read without a level is not available at the vertex",
        " --> <text>:4:13",
        "  |",
        "4 |     wrong = @vertex (albedo(uv).r + 1.0)",
        "  |             ^^^^^^^^^^^^^^^^^^^^^^^^^^^^",
        "  |                      ---------- read here",
    ]

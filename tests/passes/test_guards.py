"""Ranges remove guards where they prove that none is needed; what stays is told."""

from __future__ import annotations

import pytest

import burnish


def guards(text: str) -> list[str]:
    """The builtins of a material's own text that keep a guard."""
    text = f"material M {{ param x : float  {text} }}"
    (material,) = burnish.compile(text, ["wgsl"]).materials
    return [g.builtin for g in material.guards if g.span and g.span.source.name == "<text>"]


SAFE = [
    "param power : float in 1..512  color = vec3(pow(saturate(uv.x), power))",
    "param size : float in 0.5..2  color = vec3(uv.x / size)",
    "color = vec3(sqrt(uv.x * uv.x))",
    "color = vec3(sqrt(dot(uv, uv)))",
    "color = vec3(normalize(normal))",
    "color = vec3(acos(clamp(uv.x, -1, 1)))",
    "color = vec3(log(max(uv.x, 0.001)))",
    "color = vec3(smoothstep(0.25, 0.75, uv.x))",
    "color = vec3(normalize(nonzero(uv)), 0)",
    "v = nonzero(uv)  color = vec3(normalize(v) / dot(v, v), 1 / length(v))",
    "color = vec3(-nonzero(uv) / sqrt(dot(-nonzero(uv), -nonzero(uv))), 0)",
    "color = vec3(if uv.x > 0.5 then 1.0 / uv.x else 0.0)",
    "param n : int in 1..8  color = vec3(float(7 / n))",
    "color = vec3(sum i in 0..4 : 1.0 / float(i + 1))",
    "color = vec3(sqrt(quantize_half(saturate(uv.x))))",
]


@pytest.mark.parametrize("text", SAFE)
def test_a_proven_operand_needs_no_guard(text: str) -> None:
    assert guards(text) == []


UNSAFE = [
    ("color = vec3(1 / uv.x)", "div"),
    ("color = vec3(pow(uv.x, 3.0))", "pow"),
    ("color = vec3(pow(saturate(uv.x), x))", "pow"),
    ("color = vec3(sqrt(uv.x))", "sqrt"),
    ("color = vec3(acos(dot(normal, to_eye)))", "acos"),
    ("color = normalize(vec3(uv, 0))", "normalize"),
    ("color = vec3(if x > 0 then normalize(nonzero(uv)) else normalize(uv), 0)", "normalize"),
    ("color = vec3(normalize(nonzero(uv) + nonzero(uv.yx)), 0)", "normalize"),
    ("color = normalize(@vertex nonzero(vec3(position)))", "normalize"),
    ("color = vec3(if uv.x > 0.5 then 1.0 else 1.0 / uv.x)", "div"),
    ("color = vec3(sum i in 0..9 : uv.x / float(i))", "div"),
]


NEEDED_SOMEWHERE = [
    # Direct3D: inverse roots to 2^-21 of the result, sines to 0.0008.
    ("param a : float in 1..4  color = vec3(asin(inversesqrt(a) * 0.9999996))", "asin"),
    ("param a : float in 0..3  color = vec3(sqrt(sin(a) + 0.0006))", "sqrt"),
    # The reciprocal of so large a divisor may be flushed to zero.
    ("param big : float in 1..3e38  color = vec3(log(1e20 / big))", "log"),
    # A plane through 0, 0 and 1 is below zero somewhere: SwiftShader drew NaN.
    ("heat = @vertex saturate(position.x)  color = vec3(sqrt(heat))", "sqrt"),
    # Far behind its nearest corner, a plane through values over w is off by more than these.
    ("heat = @vertex (0.5 + saturate(position.x))  color = vec3(sqrt(heat))", "sqrt"),
]
"""Operands that some platform computes so roughly that they leave the domain there."""


@pytest.mark.parametrize(("text", "builtin"), [*UNSAFE, *NEEDED_SOMEWHERE])
def test_an_unproven_operand_keeps_its_guard(text: str, builtin: str) -> None:
    assert builtin in guards(text)


def test_a_guard_says_where_and_why() -> None:
    text = "material M { color = vec3(1 / uv.x) }"
    (material,) = burnish.compile(text, ["wgsl"]).materials
    (guard,) = [g for g in material.guards if g.span and g.span.source.name == "<text>"]
    assert guard.span is not None
    assert text[guard.span.start : guard.span.end] == "1 / uv.x"
    assert guard.reason.startswith("operands in [1, 1], ")


ONE_QUESTION = {
    "vec3(uv, 1) / x": "select(vec3f(0.0), vec3f(input.uv, 1.0) / material.x, abs(material.x)",
    "vec3(uv, 1) mod frag_coord.w": "floor(color_joined / input.frag_coord.w)",
    "vec3(ivec3(vec3(uv, 1)))": "vec3i(clamp(vec3f(input.uv, 1.0), vec3f(",
    "vec3(uvec3(vec3(uv, 1)))": "vec3u(clamp(vec3f(input.uv, 1.0), vec3f(",
}


@pytest.mark.parametrize(("color", "guarded"), ONE_QUESTION.items())
def test_lanes_share_a_guard_that_asks_the_same_of_all(color: str, guarded: str) -> None:
    text = f"material M {{ param x : float  color = {color} }}"
    shown = burnish.compile(text, ["wgsl"], hoist=False)["M"].text("wgsl", "fragment")
    assert guarded in shown

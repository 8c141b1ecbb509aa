"""Parameters with one value are constants: the shaders are those of the same text with slots."""

from __future__ import annotations

import re

import pytest

import burnish

BLOCK = re.compile(
    r"^(layout\(.*\) uniform \w+ \{|struct Material \{)\n.*?^\}.*?;\n\n?", re.M | re.S
)


def text(source: str) -> str:
    """The fragment shader without the declaration of what the host sets."""
    (material,) = burnish.compile(source, "glsl")
    return BLOCK.sub("", material.text("glsl", "fragment"))


def pair(parameter: str, slot: str, rest: str) -> tuple[str, str]:
    """The texts of a material with a parameter, and with a slot in its place."""
    return tuple(text(f"material M {{\n{each}\n{rest}\n}}\n") for each in (parameter, slot))  # type: ignore[return-value]


@pytest.mark.parametrize(
    ("parameter", "slot", "color"),
    [
        ("param k : float in 0..0", "k : float = 0", "vec3(k * sin(uv.x) + uv.y)"),
        ("param k : float in 0.25..0.25", "k : float = 0.25", "vec3(uv, k) * k"),
        ("param k : float in 1..1", "k : float = 1", "mix(vec3(uv, 0), sin(normal), k)"),
        (
            "param k : float in 0..0",
            "k : float = 0",
            "if k > 0 then rgb(sin(normal)) else rgb(normal)",
        ),
        ("param k : vec2 in 0..0", "k : vec2 = vec2(0)", "vec3(k * sin(uv), uv.x)"),
        ("param k : rgb in 1..1", "k : rgb = rgb(1, 1, 1)", "k * rgb(normal)"),
        ("param k : int in 3..3", "k : int = 3", "vec3(sum i in 0..k : sin(float(i) * uv.x))"),
        (
            "param k : int in 0..0",
            "k : int = 0",
            "vec3(uv, (sum i in 0..k : sin(float(i) * uv.x)))",
        ),
        ("param k : uint in 1..1", "k : uint = 1", "vec3(uv, float(k << 2u))"),
        ("param k : angle in 0deg..0deg", "k : angle = 0", "vec3(cos(k) * uv, sin(k))"),
    ],
)
def test_a_parameter_with_one_value_is_a_constant(parameter: str, slot: str, color: str) -> None:
    with_parameter, with_slot = pair(parameter, slot, f"color = {color}")
    assert with_parameter == with_slot


def test_elements_with_one_value_are_constants() -> None:
    rest = "color = vec3(uv, k[int(uv.x * 3)] * sin(uv.y))"
    with_parameter, _ = pair("param k : float[3] in 0..0", "k = [0.0, 0.0, 0.0]", rest)
    assert "sin" not in with_parameter and "k[" not in with_parameter


def test_the_count_of_no_lights_leaves_no_loop() -> None:
    source = """
        import std.lights.{Point}
        import std.terms.{lambert}
        rig Many { lamps : Point[4] }
        fn twice(x: float) -> float = x + x
        material M { param k : float in 0..0
            color = lambert(rgb(1, 1, 1)) * twice(k) + rgb(normal) }
    """
    assert "for (" not in text(source)


def test_what_a_dead_factor_reads_is_not_bound() -> None:
    source = """
        material M {
            param k : float in 0..0
            param tint : rgb
            map dirt : texture2d
            map base : texture2d
            color = base(uv).rgb + k * tint * dirt(uv).rgb
        }
    """
    (material,) = burnish.compile(source, "glsl")
    reflection = material.reflection
    reads = {row.name: row.read for row in reflection.parameters}
    assert reads["k"] == () and reads["tint"] == ()
    assert "dirt" not in material.text("glsl", "fragment")


def test_a_range_that_implies_one_value_is_enough() -> None:
    """The product of two weights is 0 where one is; a sum that is at least 1 saturates to 1."""
    rest = "color = vec3(uv, saturate(k + 1 + abs(uv.x)) * uv.y + (k * uv.x) * sin(uv.y))"
    assert "sin" in text(f"material M {{ param k : float in 0..1\n{rest} }}")
    found = text(f"material M {{ param k : float in 0..0\n{rest} }}")
    assert "sin" not in found and "clamp" not in found

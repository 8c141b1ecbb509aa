"""Pairs of materials that mean the same, each by other words; and pairs that do not, by little."""

from __future__ import annotations

import pytest

from .kit import NUMBERS, compared

GEOMETRY = "param place : point<world>\nparam x : float in 0..1 = 0.5"
_ARROWS = """
v = normalize(eye - position)
l = normalize(place - position)
"""

SAME = {
    "another order": ("x + y", "y + x"),
    "distributed": ("x * (y + z)", "x * y + x * z"),
    "factored out": ("x * x - y * y", "(x - y) * (x + y)"),
    "a mix spelled out": ("mix(x, y, z)", "x + (y - x) * z"),
    "a power as products": ("pow(x, 5)", "x * x * x * x * x"),
    "a power in parts": ("pow(x, 2.5)", "x * x * sqrt(x)"),
    "a common divisor": ("(x + y) / (z + 1)", "x / (z + 1) + y / (z + 1)"),
    "divided in turn": ("x / (1 + y) / (1 + z)", "x / (1 + y + z + y * z)"),
    "a magnitude": ("abs(x - y)", "max(x - y, y - x)"),
    "the greater one": ("max(x, y)", "if x > y then x else y"),
    "a clamp": ("clamp(x, 0.2, 0.7)", "min(max(x, 0.2), 0.7)"),
    "constants that float64 would round": ("(x + 0.1) + 0.2", "x + 0.3"),
    "a sine and a cosine": ("sin(x) * sin(x) + cos(x) * cos(x)", "1.0"),
    "exponentials": ("exp(x) * exp(y)", "exp(x + y)"),
    "the root of a square": ("sqrt(x * x + 2 * x * y + y * y)", "x + y"),
    "a comparison of multiples": ("if 2 * x < y then x else z", "if x < 0.5 * y then x else z"),
    "a choice turned round": ("if x < y then x else z", "if x >= y then z else x"),
    "an unrolled loop": ("(sum i in 0..4 : x * float(i))", "6 * x"),
    "a smoothstep spelled out": (
        "smoothstep(0.2, 0.8, x)",
        "t = saturate((x - 0.2) / 0.6)\ncolor = vec3(t * t * (3 - 2 * t))",
    ),
}


@pytest.mark.parametrize("pair", SAME.values(), ids=SAME)
def test_other_words_for_the_same_are_proven_to_be_the_same(pair: tuple[str, str]) -> None:
    found = compared(*pair)
    assert (found.verdict, found.proven, found.bound) == ("same", 1.0, 0.0)
    assert found.means in ("expression", "algebra")


OF_VECTORS = {
    "a mirrored ray": (
        "color = vec3(dot(reflect(-l, normal), v))",
        "color = vec3(2.0 * dot(normal, l) * dot(normal, v) - dot(l, v))",
    ),
    "half of an angle": (
        "h = normalize(l + v)\ncolor = vec3(2.0 * dot(h, l) * dot(h, l) - 1.0)",
        "color = vec3(dot(l, v))",
    ),
    "the length of what has length one": (
        "color = vec3(dot(normal, normal) * x)",
        "color = vec3(x)",
    ),
    "divided by a length": (
        "d = place - position\ncolor = vec3(dot(normal, d) / length(d))",
        "color = vec3(dot(normal, l))",
    ),
}


@pytest.mark.parametrize("pair", OF_VECTORS.values(), ids=OF_VECTORS)
def test_formulas_of_directions_are_proven_by_their_lengths(pair: tuple[str, str]) -> None:
    one, other = (_ARROWS + each for each in pair)
    assert compared(one, other, GEOMETRY).means == "algebra"


APPROXIMATE = {
    "a series": ("sin(x * 0.1)", "x * 0.1 - x * x * x * 0.001 / 6", 1e-6),
    "a rounded constant": ("x * 0.3333333", "x / 3", 1e-7),
    "a choice that hardly jumps": ("if x < 0.5 then y else y + 0.00005", "y", 4.9e-5),
}


@pytest.mark.parametrize("pair", APPROXIMATE.values(), ids=APPROXIMATE)
def test_what_differs_less_than_is_allowed_is_proven_by_bounds(
    pair: tuple[str, str, float],
) -> None:
    first, second, really = pair
    found = compared(first, second)
    assert (found.verdict, found.means) == ("same", "bounds")
    assert really * 0.01 <= found.bound <= 1e-4


DIFFERENT = {
    "a sign": ("x + y * z", "x - y * z"),
    "another exponent": ("pow(x, 5)", "pow(x, 4.99)"),
    "no clamp at the upper end": ("saturate(x * 1.001)", "x * 1.001"),
    "no clamp at the lower end": ("max(x - 0.001, 0)", "x - 0.001"),
    "a mix the wrong way, with a weight of one half": ("mix(x, y, z)", "mix(y, x, z)"),
    "a branch for a tiny part": ("x", "if x > 0.7231 and x < 0.72312 then y else x"),
    "a branch for one number": ("x", "if x == 0.375 then y + 2 else x"),
    "another constant": ("x * 0.5 + 0.25", "x * 0.5 + 0.2502"),
    "a square where a product was": ("x * y", "x * x"),
    "a bound of a loop": ("(sum i in 0..4 : x * float(i))", "(sum i in 0..5 : x * float(i))"),
}


@pytest.mark.parametrize("pair", DIFFERENT.values(), ids=DIFFERENT)
def test_one_subtle_difference_is_found(pair: tuple[str, str]) -> None:
    found = compared(*pair)
    assert found.verdict == "different"
    assert found.witness is not None
    assert found.witness.difference > 1e-4


@pytest.mark.parametrize(("one", "other"), [("<", "<="), (">", ">=")])
def test_what_differs_at_equal_numbers_only_says_so(one: str, other: str) -> None:
    found = compared(f"if x {one} 0.5 then y else z", f"if x {other} 0.5 then y else z")
    assert found.witness is not None
    assert found.witness.is_edge
    assert found.witness.values["x"] == 0.5


def test_what_makes_no_difference_at_equal_numbers_is_the_same() -> None:
    assert compared("if x < y then y else x", "if x <= y then y else x").verdict == "same"


def test_another_channel_of_a_texture_differs() -> None:
    parameters = NUMBERS + "\nmap albedo : texture2d = white"
    found = compared("albedo(uv).r", "albedo(uv).g", parameters)
    assert found.verdict == "different"
    assert compared("albedo(uv * 2).r", "albedo(uv + uv).r", parameters).means == "algebra"

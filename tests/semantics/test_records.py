"""The values of materials: sharing, inheritance and late binding, parameters, textures."""

from __future__ import annotations

import math

import pytest

from burnish.compiler.ir.shader import ParameterInfo, RenderTarget
from burnish.compiler.ir.stages import DISCARD, TARGET
from burnish.compiler.reference.namespace import Lanes

from .kit import Painted, at, color, lanes, number, shader

BASE = """
abstract material Base {
    k     : float
    twice = 2 * k
    color = vec3(twice, k, 0)
}
"""
HEIRS: dict[str, Lanes] = {
    "material M : Base { k = 3 }": (6, 3, 0),
    "material M : Base { k = 3  twice = k + 1 }": (4, 3, 0),
    "material M : Base { k = 3  twice = inherited.twice + 10 }": (16, 3, 0),
    "material M : Base { param k : float = 5 }": (10, 5, 0),
    "abstract material N : Base { param k : float = 5 }  material M : N { k = 7 }": (14, 7, 0),
    "abstract material N : Base { k = 5 }  material M : N { k = inherited.k * 3 }": (30, 15, 0),
    "abstract material N : Base { k = 5  twice = inherited.twice + 100 }"
    "material M : N { k = 6  twice = inherited.twice + 1000 }": (1112, 6, 0),
    "abstract material N : Base { k = 5 }"
    "material M : N { other = inherited.k  k = 7  color = vec3(other) }": (5, 5, 5),
    "material M : Base { k = 3  color = inherited.color.bgr }": (0, 3, 6),
    # An abstract material takes a value back, and those derived from it set it again.
    "abstract material N : Base { color : rgb  dim = color / 2 }"
    "material M : N { k = 3  color = vec3(twice)  alpha = dim.x }": (6, 6, 6),
    "abstract material N : Base { param k : float = 5 }  abstract material O : N { k : float }"
    "material M : O { k = 7 }": (14, 7, 0),
    "abstract material N : Base { twice : float }"
    "material M : N { k = 3  param twice : float = 4 }": (4, 3, 0),
    "abstract material N : Base { twice : float }"
    "abstract material O : N { twice = 8 }  material M : O { k = twice / 2 }": (8, 4, 0),
    "material M : Base { k : float = 3  fresh = k * 7  color = vec3(fresh) }": (21, 21, 21),
}


@pytest.mark.parametrize(("heirs", "expected"), HEIRS.items(), ids=range(len(HEIRS)))
def test_inheritance(heirs: str, expected: Lanes) -> None:
    assert color(f"{BASE}{heirs}") == pytest.approx(expected)


def test_a_parameter_that_is_taken_back_is_none() -> None:
    text = """
        abstract material N { param k : float = 5  map t : texture2d  attribute a : vec2
                              color = vec3(k * t(a).r) }
        abstract material O : N { k : float  t : texture2d  a : vec2 }
        material M : O { k = 2  map t : texture2d  a = uv }
    """
    whole = shader(text)
    assert "k" not in {info.leaf.name for info in whole.parameters}
    assert "a" not in {info.leaf.name for info in whole.attributes}


def test_an_override_reaches_what_the_surface_computes() -> None:
    assert lanes("vec3(to_eye)", "position = vec3(0, 0, 1)  eye = vec3(0, 0, -3)") == (0, 0, -1)


def test_the_order_of_equations_means_nothing() -> None:
    assert number("c", "c = b + 1\nb = a + 1\na = 1") == 3


def test_a_material_is_its_own_surface() -> None:
    assert number("material.k", "k = 4") == 4


PARAMETERS = """
struct Layer { width : float }
material M {
    param a : float in 0.5..2 = 1                       /// How much
    param b : vec2 in -1..1 per draw = vec2(0, 0.5)
    param c : direction<world> per weather = vec3(0, 3, 4)
    param d : int in 1..limit = limit / 2
    param e : Layer[2] per frame
    param f : angle = 90deg
    param g : rgb = #808080
    param h : mat2 = mat2(2)
    param i : float per view
    param j : bool = true
}
limit = 8
"""


@pytest.fixture(scope="module")
def parameters() -> dict[str, ParameterInfo]:
    return {info.leaf.name: info for info in shader(PARAMETERS).parameters}


DEFAULTS = {
    "a": 1.0,
    "b": (0.0, 0.5),
    "c": (0.0, 0.6, 0.8),
    "d": 4,
    "e": None,
    "f": math.pi / 2,
    "g": pytest.approx((0.2158605,) * 3),
    "h": ((2.0, 0.0), (0.0, 2.0)),
    "i": None,
    "j": True,
}


def test_defaults(parameters: dict[str, ParameterInfo]) -> None:
    assert {name: parameters[name].default for name in DEFAULTS} == DEFAULTS


def test_ranges(parameters: dict[str, ParameterInfo]) -> None:
    ranges = {name: parameters[name].range for name in DEFAULTS}
    bounded = {name: limits for name, limits in ranges.items() if limits is not None}
    assert bounded == {"a": (0.5, 2), "b": (-1, 1), "d": (1, 8)}
    assert parameters["c"].leaf.fact.unit


def test_groups_types_and_remarks(parameters: dict[str, ParameterInfo]) -> None:
    groups = {name: parameters[name].leaf.group for name in DEFAULTS}
    assert [groups[name] for name in "abcei"] == ["material", "draw", "weather", "frame", "view"]
    written = [parameters[name].declared_type for name in "cegf"]
    assert written == ["direction<world>", "Layer[2]", "rgb", "angle"]
    assert parameters["a"].doc == "How much"


def test_a_parameter_that_is_set_is_none_any_more() -> None:
    text = "abstract material B { param k : float = 1 }  material M : B { k = 2 }"
    assert "k" not in {info.leaf.name for info in shader(text).parameters}


def test_a_parameter_has_the_value_that_the_host_sets() -> None:
    assert number("k * 2", "param k : float = 1", k=(21.0,)) == 42


def test_textures_are_read_at_a_coordinate() -> None:
    given: Lanes = (Painted(lambda u, v: (u, v, 10 * u, 1)),)
    assert lanes("albedo(uv * 2).rgb", "map albedo : texture2d", albedo=given) == (0.5, 1.5, 5)
    read = "fn red(t: texture2d, p: vec2) = t(p).r"
    assert number("red(albedo, uv)", "map albedo : texture2d", read, albedo=given) == 0.25


def test_what_a_texture_is_until_it_is_bound() -> None:
    text = """material M {
        map plain : texture2d
        map bumps : texture2d per draw = flat_normal with { wrap = mirror, mip = none }
    }"""
    plain, bumps = (info.leaf for info in shader(text).textures)
    assert (plain.default, plain.group) == ("white", "material")
    assert dict(plain.state) == {"filter": "linear", "mip": "linear", "wrap": "repeat"}
    assert (bumps.default, bumps.group) == ("flat_normal", "draw")
    assert dict(bumps.state) == {"filter": "linear", "mip": "none", "wrap": "mirror"}


def test_the_default_pass_writes_colour_and_alpha() -> None:
    whole = shader("material M { color = #ffffff  alpha = 0.25 }")
    (result,) = whole.results_of(TARGET)
    assert (result.name, result.state) == ("color", RenderTarget("rgba8_srgb"))
    assert at(whole, result.value) == (1, 1, 1, 0.25)
    assert not whole.results_of(DISCARD)


ADAPTING: dict[str, Lanes] = {
    "material M : Base { a = 0 }": (0, 2, 0.25),
    "material M : Base { a = -2 }": (4, 2, 0.25),
    "material M : Base { a = if uv.x > 0.5 then 1 else 2 }": (4, 2, 0.25),
    "material M : Base { v = 2 }": (0.0625, 4, 0.25),
    "material M : Base { v = 0.5 }": (0.0625, 1, 0.25),
    "material M : Base { l = [2, 3] }": (0.0625, 2, 6),
    "material M : Base { a = zero }": (0, 2, 0.25),
    "abstract material N : Base { a = 1 }  material M : N { a = 2 }": (4, 2, 0.25),
    "mixin Plain { a = 3 }  material M : Base + Plain {}": (9, 2, 0.25),
    "material M : Base { color = inherited.color + (t() with { a = 2 }) }": (1.0625, 3, 1.25),
    "material M : Base { v = a  a = 3 }": (9, 6, 0.25),
    "material M : Base { a = 3  v = vec2(a * a) }": (9, 18, 0.25),
}


@pytest.mark.parametrize(("heirs", "expected"), ADAPTING.items(), ids=ADAPTING)
def test_a_literal_adapts_to_what_it_overrides(heirs: str, expected: Lanes) -> None:
    base = """
        zero = 0
        abstract material Base {
            a = uv.x
            v = uv * 2
            l = [1.0, 0.25]
            color = vec3(mix(0, 1, a * a), v.x + v.y, l[0] * l[1])
        }
        term t() = vec3(mix(0, 1, a * a) / 4)
    """
    assert color(f"{base}{heirs}") == pytest.approx(expected)

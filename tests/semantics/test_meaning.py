"""The meanings of values: kinds, spaces, conversions; each typing rule refuses a program."""

from __future__ import annotations

import math

import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.meaning import RGB, Meaning
from burnish.compiler.ir.node import reachable
from burnish.compiler.ir.stages import TARGET
from burnish.compiler.ir.types import Type
from burnish.compiler.semantics.declarations import contracts
from burnish.compiler.semantics.types import meaning_rules
from burnish.compiler.semantics.types.meaning_rules import Found, Side

from .kit import lanes, number, shader

SPACE = "space bench"
BENCH = """
param bench_to_world : transform<bench, world> =
    mat4(vec4(0, 0, 2, 0), vec4(0, 3, 0, 0), vec4(1, 0, 0, 0), vec4(5, 6, 7, 1))
mark  = (vec3(1, 1, 1) as point<bench>)
arrow = (vec3(1, 1, 1) as vector<bench>)
"""
"""Bench's x runs along world's z, stretched to twice its length, and y is stretched threefold."""


@pytest.mark.parametrize(
    ("text", "expected"),
    {
        "mark in world": (6, 9, 9),
        "arrow in world": (1, 3, 2),
        "bench_to_world * mark": (6, 9, 9),
        "bench_to_world * arrow": (1, 3, 2),
        "(mark in world) in bench": (1, 1, 1),
        "(arrow in world) in bench": (1, 1, 1),
        "normalize(arrow) in world": tuple(n / math.sqrt(14) for n in (1, 3, 2)),
        "(vec3(1, 1, 1) as normal<bench>) in world": (1, 1 / 3, 1 / 2),
        "(vec3(1, 1/3.0, 0.5) as normal<world>) in bench": (1, 1, 1),
        "mark in world in bench": (1, 1, 1),
        "position - (mark in world)": (-5.5, -8.75, -9),
        "inverse(bench_to_world) * (mark in world)": (1, 1, 1),
        "mat3(bench_to_world) * arrow": (1, 3, 2),
        "(mat3(bench_to_world) as basis<bench, world>)[0] - (arrow in world)": (-1, -3, 0),
        "2 * arrow in world": (2, 6, 4),
    }.items(),
)
def test_values_go_from_space_to_space(text: str, expected: tuple[float, ...]) -> None:
    assert lanes(f"vec3({text})", BENCH, SPACE) == pytest.approx(expected)


def test_clip_space_is_homogeneous() -> None:
    members = "param lens : mat4 = mat4(2)  view_projection = lens  w = (position in clip).w"
    assert number("w", members) == 2


CHAIN = """
param seat_to_bench  : transform<seat, bench> = mat4(1)
param bench_to_world : transform<bench, world> = mat4(1)
param bench_to_seat  : transform<bench, seat> = mat4(2)
"""


def test_the_shortest_way_is_taken_and_no_inverse_where_a_direct_one_leads() -> None:
    """`bench_to_seat` is not the inverse of `seat_to_bench`, so values tell the ways apart."""
    head = "space bench space seat"
    mark = "vec3((vec3(1) as vector<bench>) in seat)"
    assert lanes(mark, CHAIN, head) == (2, 2, 2)
    assert lanes("vec3((vec3(1) as vector<seat>) in world)", CHAIN, head) == (1, 1, 1)
    assert lanes("vec3((vec3(1) as vector<world>) in seat)", CHAIN, head) == (2, 2, 2)


def test_a_light_sees_its_own_transform_before_the_surface() -> None:
    source = """
    space lamp
    light Beam : Light {
        param lamp_to_world : transform<lamp, world> = mat4(3)
        to_light = normalize((vec3(0, 0, 1) as vector<lamp>) in world)
        falloff  = length((vec3(0, 0, 1) as vector<lamp>) in world)
    }
    term shown() per light = vec3(light.falloff)
    rig Room { beam : Beam }
    material M { color = shown() }
    """
    whole = shader(source)
    assert whole.results_of(TARGET)


GENERICS = """
space bench
fn midpoint<S: spaces>(a: point<S>, b: point<S>) -> point<S> = a + 0.5 * (b - a)
fn total<N: widths>(v: vec<float, N>) -> float = dot(v, v) * float(N)
fn first<K: scalars, N: widths>(v: vec<K, N>) -> K = v.x
fn mean<N: counts>(a: float[N]) -> float = (sum i in 0..N : a[i]) / float(N)
fn doubled<T: floats>(x: T) -> T = x + x
fn which(x: float) = 1
fn which(x: vec3) = 2
fn which(x: rgb) = 3
fn which<S: spaces>(x: point<S>) = 5
fn which<T: vectors>(x: T) = 4
fn which(x: direction<world>) = 6
fn either<B: bools>(b: B) -> B = b
"""


@pytest.mark.parametrize(
    ("text", "expected"),
    {
        "total(vec2(1, 2))": 10,
        "total(vec4(1))": 16,
        "float(first(ivec3(7, 8, 9)))": 7,
        "first(vec2(0.5, 1))": 0.5,
        "mean(row)": 2.5,
        "which(1)": 1,
        "which(vec3(0))": 2,
        "which(#fff)": 3,
        "which(vec2(0))": 4,
        "which(position)": 5,
        "which(normalize(vec3(uv, 1) + normal))": 6,
        "which(normal + to_eye)": 4,
        "vec3(midpoint(position, eye)).x": 1.25,
        "vec3(midpoint(position, vec3(1))).x": 0.75,
        "either(any(bvec2(true, false)))": 1,
    }.items(),
)
def test_type_parameters(text: str, expected: float) -> None:
    members = "param row : float[4] eye = vec3(2)"
    assert number(text, members, GENERICS, row=((1.0,), (2.0,), (3.0,), (4.0,))) == expected


@pytest.mark.parametrize(
    "equation",
    [
        "a : rgb = doubled(#fff)",
        "a : angle = doubled(20deg)",
        "a : point<world> = midpoint(position, eye)",
        "a : vector<world> = doubled(normal)",
        "a = dot(doubled(normal), to_eye)",
    ],
)
def test_what_arguments_mean_goes_through_type_parameters(equation: str) -> None:
    assert not _told(f"{GENERICS} material M {{ {equation} }}")


@pytest.mark.parametrize(
    ("equation", "code"),
    [
        ("a : rgb = doubled(normal)", "B0320"),
        ("a : point<view> = midpoint(position, eye)", "B0320"),
        ("a = midpoint(position, (eye as point<view>))", "B0320"),
        ("a = doubled(position)", "B0322"),
        ("a : direction<world> = doubled(to_eye)", "B0324"),
        ("a = total(1.0)", "B0302"),
        ("a = mean(uv)", "B0302"),
    ],
)
def test_and_is_checked(equation: str, code: str) -> None:
    assert _told(f"{GENERICS} material M {{ {equation} }}") == [code]


def test_a_mistake_in_a_generic_function_names_the_instance() -> None:
    source = f"{GENERICS} material M {{ a = doubled(position) }}"
    with pytest.raises(CompileError) as caught:
        shader(source)
    (found,) = caught.value.diagnostics
    assert found.labels[-1].text == "in `doubled<point<world>>`, called here"


RIGHT = [
    "a : point<world> = position + normal",
    "a : point<world> = position - normal",
    "a : vector<world> = eye - position",
    "a : vector<world> = normal + to_eye",
    "a : normal<world> = normalize(normal)",
    "a : direction<world> = normalize(cross(normal, to_eye))",
    "a : direction<world> = reflect(to_eye, normal)",
    "a : vector<world> = ddx(position)",
    "a : rgb = color * #fff + 0.5",
    "a : rgb = saturate(color) / (color + 1)",
    "a : rgb = mix(color, #000, 0.5)",
    "a : rgb = (#ffffff80).rgb",
    "a : rgba = rgba(color, alpha)",
    "a : angle = 2 * 20deg - asin(0.5) mod 3deg",
    "a : float = 20deg / 10deg",
    "a : float = sin(20deg)",
    "a : rgb = position * 0.1",
    "a : rgb = abs(normal)",
    "a : rgb = normal * 0.5 + 0.5",
    "a : rgb = position.xyz",
    "a : transform<object, clip> = view_projection * object_to_world",
    "a : transform<world, object> = inverse(object_to_world)",
    "a : basis<object, world> = mat3(object_to_world)",
    "a : vector<world> = if alpha > 0.5 then normal else vec3(0)",
    "a : vector<world> = sum i in 0..3 : normal",
    "a : point<world> = (sum i in 0..4 : position) / 4",
]


@pytest.mark.parametrize("equation", RIGHT)
def test_what_is_right_is_left_alone(equation: str) -> None:
    assert not _told(f"material M {{ {equation} }}")


WRONG = {
    "sum": "a = position + eye",
    "difference": "a = normal - position",
    "product": "a = color * normal",
    "quotient": "a = color / normal",
    "remainder": "a = color mod normal",
    "negation": "a : rgb = -normal",
    "numbers": "a = smoothstep(color, normal, vec3(0))",
    "lanes": "a = pow(color, normal)",
    "limits": "a = min(color, normal)",
    "blend": "a = mix(position, normal, 0.5)",
    "change": "a : rgb = ddx(position)",
    "angle": "a = asin(alpha) + color",
    "measure": "a = length(position)",
    "distance": "a = distance(position, normal)",
    "perpendicular": "a : rgb = cross(normal, to_eye)",
    "unit": "a : rgb = normalize(normal)",
    "reflected": "a = reflect(position, normal)",
    "turned": "a = faceforward(position, normal, normal)",
    "texel": "map m : texture2d of rgb  a = m(uv).rgb + normal",
    "of_texture": "map m : depth_cube  a = m(normal, 30deg)",
    "reversed": "a : transform<object, world> = inverse(object_to_world)",
}
"""For each typing rule, an error that no other rule would find."""


@pytest.mark.parametrize("name", meaning_rules.RULES)
def test_every_rule_finds_something(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    source = f"material M {{ {WRONG[name]} }}"
    assert _told(source)

    def silent(_sides: tuple[Side, ...], _result: Type) -> Found:
        return None

    monkeypatch.setattr(meaning_rules, "RULES", {**meaning_rules.RULES, name: silent})
    monkeypatch.setattr("burnish.compiler.semantics.types.meanings.RULES", meaning_rules.RULES)
    assert not _told(source)


@pytest.mark.parametrize(
    "difference",
    ["(vec3(0.5) as point<object>) - object_position", "object_position - middle",
     "mix(middle, object_position, 0.5) - object_position"],
)  # fmt: skip
def test_what_was_declared_keeps_its_meaning_whatever_its_lanes_are(difference: str) -> None:
    """Three equal lanes are also how a bare number looks that was made as wide as a vector."""
    source = f"material M {{ middle : point<object> = 0  color = vec3(({difference}) in world) }}"
    assert not _told(source)


def _fits_colours(found: Meaning | None, wanted: Meaning | None) -> bool:
    """The rule ``fits``, except that any value is a colour; the library needs the rest of it."""
    return wanted == RGB or meaning_rules.fits(found, wanted)


@pytest.mark.parametrize(
    ("name", "broken", "equation"),
    [
        ("fits", _fits_colours, "a : rgb = normal"),
        ("needs_unit", lambda _declared: False, "a : direction<world> = eye - position"),
        ("_bare_number", lambda _written: "", "a : angle = 20"),
    ],
)
def test_every_check_of_a_declaration_finds_something(
    name: str, broken: object, equation: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = f"material M {{ {equation} }}"
    assert _told(source)
    monkeypatch.setattr(contracts, name, broken)
    assert not _told(source)


def test_no_ascription_is_left() -> None:
    whole = shader("material M { color = (vec3(normal) as rgb) + #fff * sin(20deg) }")
    roots = whole.roots
    assert all(node.op != "as" for node in reachable(roots))


def _told(source: str) -> list[str]:
    """The codes of all that is said of a text."""
    try:
        shader(source)
    except CompileError as error:
        return [found.rule.code for found in error.diagnostics]
    return []

"""The values of expressions: literals, operators, choices, sums, functions, aggregates."""

from __future__ import annotations

import math

import pytest

from burnish.compiler.reference.namespace import Lanes

from .kit import lanes, number

LITERALS: dict[str, Lanes] = {
    "#808080": (0.2158605,) * 3,
    "#fff": (1, 1, 1),
    "#f80": (1, 0.2462013, 0),
    "#0a0a0a": (0.0030353,) * 3,
    "#80808080.aaa": (128 / 255,) * 3,
    "#80808080.rgb": (0.2158605,) * 3,
    "vec3(180deg, 90deg, 0.5rad)": (math.pi, math.pi / 2, 0.5),
    "vec3(.5, 1e-3, 2.5e2)": (0.5, 0.001, 250),
    "vec3(3.40282347e38, -3.4028235e38, 1)": (2.0**128 - 2.0**104, 2.0**104 - 2.0**128, 1),
    "vec3(2, -3, 4)": (2, -3, 4),
    "vec3(float(true), float(7u), float(-2147483648))": (1, 7, -2147483648.0),
}


@pytest.mark.parametrize(("text", "expected"), LITERALS.items(), ids=LITERALS)
def test_literals(text: str, expected: Lanes) -> None:
    assert lanes(text) == pytest.approx(expected, abs=1e-7)


PRECEDENCE: dict[str, float] = {
    "1 + 2 * 3": 7,
    "10 - 4 - 3": 3,
    "24 / 4 / 2": 3,
    "8.0 / 4 * 2": 4,
    "7 mod 4 * 2": 6,
    "-2 * 3": -6,
    "2 - -3": 5,
    "--2": 2,
    "-vec2(1, 2).y": -2,
    "1 + 1 == 2": 1,
    "6 & 3 == 2": 1,
    "1 | 6 ^ 3 & 2": 5,
    "1 + 1 << 2": 8,
    "~0 & 0xFF": 255,
    "0xFFu >> 4": 15,
    "-16 >> 2": -4,
    "1 << 33": 2,
    "true or true and false": 1,
    "not true or true": 1,
    "not 1 > 2 and true": 1,
    "(1 + 2) * 3": 9,
    "if true then 1 else 2 + 10": 1,
    "(if false then 1 else 2) + 10": 12,
    "sum i in 0..3 : i + 1": 6,
    "(sum i in 0..3 : i) + 1": 4,
    "@vertex vec2(1, 2) [1] * 3": 6,
}


@pytest.mark.parametrize(("text", "expected"), PRECEDENCE.items(), ids=PRECEDENCE)
def test_precedence(text: str, expected: float) -> None:
    assert number(text) == expected


OPERATIONS: dict[str, float] = {
    "7 / 2": 3,
    "-7 / 2": -3,
    "7.0 / 2": 3.5,
    "-7 mod 3": 2,
    "7 mod -3": -2,
    "-7.5 mod 2.0": 0.5,
    "int(-2.7)": -2,
    "uint(2.7)": 2,
    "int(true)": 1,
    "bool(0.5)": 1,
    "bool(0)": 0,
    "2147483647 + 1": -(2.0**31),
    "any(bvec2(false, true))": 1,
    "all(bvec2(false, true))": 0,
    "true != false": 1,
    "3u >= 3u": 1,
}


@pytest.mark.parametrize(("text", "expected"), OPERATIONS.items(), ids=OPERATIONS)
def test_operations(text: str, expected: float) -> None:
    assert number(text) == expected


VECTORS: dict[str, Lanes] = {
    "vec3(1, 2, 3) * 2": (2, 4, 6),
    "2 - vec3(1, 2, 3)": (1, 0, -1),
    "vec3(1, 2, 3) * vec3(4, 5, 6)": (4, 10, 18),
    "vec3(1, 2, 3).zyx": (3, 2, 1),
    "vec3(1, 2, 3).bbr": (3, 3, 1),
    "vec4(1, 2, 3, 4).wzy": (4, 3, 2),
    "vec2(1, 2).xyx": (1, 2, 1),
    "alpha.xxx": (1, 1, 1),
    "vec3(5)": (5, 5, 5),
    "vec3(vec2(1, 2), 3)": (1, 2, 3),
    "vec3(1, vec2(2, 3))": (1, 2, 3),
    "vec3(vec4(1, 2, 3, 4))": (1, 2, 3),
    "vec3(ivec3(1, -2, 3))": (1, -2, 3),
    "vec3(bvec3(true, false, true))": (1, 0, 1),
    "max(vec3(1, 2, 3), 2)": (2, 2, 3),
    "mix(0, vec3(2, 4, 6), 0.5)": (1, 2, 3),
    "rgb(0.1, 0.2, 0.3)": (0.1, 0.2, 0.3),
    "direction(0, 0, 2)": (0, 0, 2),
}


@pytest.mark.parametrize(("text", "expected"), VECTORS.items(), ids=VECTORS)
def test_vectors(text: str, expected: Lanes) -> None:
    assert lanes(text) == pytest.approx(expected)


COLUMNS = "m = mat3(vec3(1, 2, 3), vec3(4, 5, 6), vec3(7, 8, 9))"
MATRICES: dict[str, Lanes] = {
    "m[1]": (4, 5, 6),
    "vec3(m[2][0])": (7, 7, 7),
    "m * vec3(1, 0, 0)": (1, 2, 3),
    "m * vec3(1, 10, 100)": (741, 852, 963),
    "transpose(m) * vec3(1, 0, 0)": (1, 4, 7),
    "(m * mat3(2)) * vec3(0, 1, 0)": (8, 10, 12),
    "mat3(2)[1]": (0, 2, 0),
    "(m + m)[0]": (2, 4, 6),
    "(2 * m)[0]": (2, 4, 6),
    "vec3(mat2(m) * vec2(0, 1), 0)": (4, 5, 0),
    "m * m * vec3(1, 0, 0)": (30, 36, 42),
}


@pytest.mark.parametrize(("text", "expected"), MATRICES.items(), ids=MATRICES)
def test_matrices(text: str, expected: Lanes) -> None:
    assert lanes(text, COLUMNS) == pytest.approx(expected)


ADAPTING: dict[str, float] = {
    "k : float = 1": 1,
    "k : float = -1": -1,
    "p : vec3 = 2  k = p.z": 2,
    "p : vec3 = 2.5  k = p.y": 2.5,
    "p : ivec2 = 2  k = p.y": 2,
    "p : uint = 2  k = p": 2,
    "k : float = if uv.x > 0.5 then 1 else 2": 2,
    "k : float = if uv.x > 0.5 then 1 else if uv.y > 0.5 then 3 else 4": 3,
    "p : vec3 = if uv.x > 0.5 then 1 else 2  k = p.z": 2,
    "p : vec3 = if uv.x > 0.5 then 1.0 else 2.0  k = p.z": 2,
    "k = uv.x * (if uv.x > 0.5 then 1 else 2)": 0.5,
    "p = vec2(if uv.x > 0.5 then 1 else 2)  k = p.y": 2,
    "k = if uv.x > 0.5 then 1 else 2.5": 2.5,
    "k = if uv.x > 0.5 then 2.5 else 1": 1,
    "p = if uv.x > 0.5 then 7 else normal  k = p.z": 1,
    "k = max(uv.x, 1)": 1,
    "k = pow(2, 3)": 8,
    "n : uint = 3  k = n + 1": 4,
    "n : uint = 3  k = 10 - n": 7,
}


@pytest.mark.parametrize(("members", "expected"), ADAPTING.items(), ids=ADAPTING)
def test_constants_adapt(members: str, expected: float) -> None:
    assert number("k", members) == expected


def test_a_long_choice_of_literals_adapts() -> None:
    choices = " else ".join(f"if uv.x > {1500 - i} then {i}" for i in range(1500))
    assert number("k", f"k : float = {choices} else 7") == 7


FOLDS: dict[str, float] = {
    "sum i in 0..5 : i": 10,
    "product i in 1..5 : i": 24,
    "sum i in -2..3 : float(i) * 0.5": 0,
    "sum i in 3..3 : 1.5": 0,
    "product i in 5..3 : 1.5": 1,
    "sum i in 0..n : uv.x": 1,
    "sum i in 0..3 : sum j in 0..2 : i * j": 3,
    "sum i in 0..3 : sum i in 0..2 : i": 3,
    "(sum i in 0..2 : vec2(float(i), 1)).y": 2,
    "sum n in 0..2 : n": 1,
}


@pytest.mark.parametrize(("text", "expected"), FOLDS.items(), ids=FOLDS)
def test_folds(text: str, expected: float) -> None:
    assert number(text, "", "n = 2 * 2") == expected


FUNCTIONS = """
fn half(x: float) -> float = x / 2
fn size(x: float) = 1
fn size(x: vec2) = 2
fn size(x: vec3) = 3
fn kind(x: int) = 10
fn kind(x: float) = 20
fn near(x: float) = 20
fn near(x: int) = 10
fn bent(t: float) -> float = t * t
fn bent(a: float, b: float, t: float) -> float = a + (b - a) * bent(t)
fn blend<T: floats>(a: T, b: T, t: float) -> T = a + (b - a) * t
fn twice<T: numbers>(a: T) -> T = a + a
fn corner<M: matrices>(m: M) -> float = m[0][0]
fn sin(x: float) -> float = 7
fn scaled(x: float) -> float = x * golden
golden = 1.5
"""
CALLS: dict[str, float] = {
    "half(3)": 1.5,
    "size(1.0)": 1,
    "size(uv)": 2,
    "size(normal)": 3,
    "kind(1)": 10,
    "kind(1.0)": 20,
    "near(1)": 10,
    "near(1.0)": 20,
    "near(int(1.5))": 10,
    "bent(1, 3, 0.5)": 1.5,
    "blend(1, 3, 0.5)": 2,
    "blend(vec2(1, 2), 4, 0.5).y": 3,
    "blend(0, normal, uv.x).z": 0.25,
    "twice(7)": 14,
    "twice(ivec2(3, 4)).y": 8,
    "corner(mat2(5))": 5,
    "sin(1)": 7,
    "cos(0)": 1,
    "scaled(4)": 6,
}


@pytest.mark.parametrize(("text", "expected"), CALLS.items(), ids=CALLS)
def test_functions(text: str, expected: float) -> None:
    assert number(text, "", FUNCTIONS) == expected


STACK = "struct Band { width : float  tints : rgb[2] }\nstruct Layer { band : Band  mark : int }"
LAYERS: Lanes = (
    (((1.0,), ((0.1, 0.2, 0.3), (0.4, 0.5, 0.6))), (7,)),
    (((2.0,), ((1.1, 1.2, 1.3), (1.4, 1.5, 1.6))), (8,)),
)
MEMBERS: dict[str, float] = {
    "stack[0].mark": 7,
    "stack[1].band.width": 2,
    "stack[1].band.tints[1].g": 1.5,
    "stack[number].mark": 8,
    "stack[number + 5].mark": 8,
    "stack[-number].mark": 7,
    "(if uv.x > 0.5 then stack[0] else stack[1]).mark": 8,
    "last(stack[1]).b": 1.6,
}


@pytest.mark.parametrize(("text", "expected"), MEMBERS.items(), ids=MEMBERS)
def test_structures_and_arrays(text: str, expected: float) -> None:
    head = f"{STACK}\nfn last(layer: Layer) -> rgb = layer.band.tints[1]"
    members = "param stack : Layer[2]\nparam number : int = 1"
    assert number(text, members, head, stack=LAYERS) == expected


INDICES = {-(2**31): 10.0, -1: 10.0, 0: 10.0, 1: 20.0, 2: 30.0, 3: 30.0, 2**31 - 1: 30.0}


@pytest.mark.parametrize(("index", "expected"), INDICES.items())
def test_an_index_is_clamped(index: int, expected: float) -> None:
    members = "param i : int = 0\nparam weights : float[3]"
    given: dict[str, Lanes] = {"weights": ((10.0,), (20.0,), (30.0,)), "i": (index,)}
    assert number("weights[i]", members, **given) == expected
    assert number("(10 * vec3(1, 2, 3))[i]", members, **given) == expected

"""Every operation with a trap has one result, whatever the backends do: asserted by value."""

from __future__ import annotations

import math

import pytest

from burnish.compiler.reference.functions import LaneKind, evaluate
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import SMALLEST_NORMAL, UNIT, UNKNOWN, Fact

LOWEST, HIGHEST = -(2**31), 2**31 - 1

FLOATS = [
    ("div", (1.0, 0.0), 0.0),
    ("div", (0.0, 0.0), 0.0),
    ("div", (1.0, -0.0), 0.0),
    ("div", (1.0, 1e-40), 0.0),
    ("div", (1.0, SMALLEST_NORMAL), 2.0**126),
    ("mod", (5.5, 2.0), 1.5),
    ("mod", (-5.5, 2.0), 0.5),
    ("mod", (5.5, -2.0), -0.5),
    ("mod", (-5.5, -2.0), -1.5),
    ("mod", (5.5, 0.0), 0.0),
    ("sign", (0.0,), 0.0),
    ("sign", (-0.0,), 0.0),
    ("sign", (-3.0,), -1.0),
    ("round", (0.5,), 0.0),
    ("round", (1.5,), 2.0),
    ("round", (2.5,), 2.0),
    ("round", (-1.5,), -2.0),
    ("fract", (-0.25,), 0.75),
    ("clamp", (0.5, 1.0, 0.0), 0.0),
    ("clamp", (7.0, 1.0, 0.0), 0.0),
    ("saturate", (7.0,), 1.0),
    ("step", (0.5, 0.5), 1.0),
    ("step", (0.0, -0.0), 1.0),
    ("smoothstep", (0.0, 1.0, 0.25), 0.15625),
    ("smoothstep", (1.0, 0.0, 0.25), 1.0 - 0.15625),
    ("smoothstep", (0.5, 0.5, 0.5), 0.0),
    ("smoothstep", (0.5, 0.5, 0.5000001), 1.0),
    ("smoothstep", (0.0, 0.0, 2.0**-65), 0.5),
    ("smoothstep", (2.0**-66, 0.0, 2.0**-63), 1.0),
    ("smoothstep", (0.5, 0.5, 1e18), 1.0),
    ("smoothstep", (0.5, 0.5, 0.4999), 0.0),
    ("sqrt", (-4.0,), 0.0),
    ("sqrt", (-0.0,), 0.0),
    ("inversesqrt", (0.0,), 2.0**63),
    ("inversesqrt", (-1.0,), 2.0**63),
    ("log", (0.0,), -126 * math.log(2)),
    ("log", (-1.0,), -126 * math.log(2)),
    ("log2", (1e-45,), -126.0),
    ("pow", (0.0, 0.0), 1.0),
    ("pow", (-2.0, 0.0), 1.0),
    ("pow", (0.0, -1.0), 0.0),
    ("pow", (0.0, 2.0), 0.0),
    ("pow", (-2.0, 2.0), 0.0),
    ("pow", (1e-40, 1e-40), 1.0),
    ("pow", (2.0, -1.0), 0.5),
    ("asin", (2.0,), math.pi / 2),
    ("asin", (-2.0,), -math.pi / 2),
    ("acos", (1.0000001,), 0.0),
    ("acos", (-2.0,), math.pi),
    ("atan2", (0.0, 0.0), 0.0),
    ("atan2", (-0.0, -0.0), 0.0),
    ("atan2", (0.0, -1.0), math.pi),
    ("atan2", (-0.0, -1.0), math.pi),
    ("atan2", (-1.0, 0.0), -math.pi / 2),
    ("exp", (1000.0,), math.inf),
    ("sinh", (-1000.0,), -math.inf),
    ("tanh", (1e30,), 1.0),
    ("acosh", (0.5,), 0.0),
    ("asinh", (-1e30,), -math.asinh(1e30)),
    ("atanh", (1.0,), math.atanh(1 - 2.0**-24)),
    ("log10", (0.0,), -126 * math.log10(2)),
    ("mantissa", (-0.75,), -0.75),
    ("mantissa", (1e-40,), 0.0),
    ("exponent", (-0.75,), 0),
    ("exponent", (8.0,), 4),
    ("exponent", (1e-40,), 0),
    ("bits_of", (1.0,), 0x3F800000),
    ("bits_of", (-2.5,), 0xC0200000),
    ("bits_of", (0.1,), 0x3DCCCCCD),
    ("bits_of", (1.99999999,), 0x40000000),
    ("bits_of", (-0.0,), 0),
    ("bits_of", (-1e-40,), 0),
    ("quantize_half", (0.1,), 0.0999755859375),
    ("quantize_half", (2049.0,), 2048.0),
    ("quantize_half", (2051.0,), 2052.0),
    ("quantize_half", (-1e9,), -65504.0),
    ("quantize_half", (1e-9,), 0.0),
    ("quantize_half", (2.0**-25 * 1.5,), 2.0**-24),
    ("to_int", (1.9,), 1),
    ("to_int", (-1.9,), -1),
    ("to_int", (3e9,), 2147483520),
    ("to_int", (-3e9,), LOWEST),
    ("to_uint", (-1.0,), 0),
    ("to_uint", (5e9,), 4294967040),
]


@pytest.mark.parametrize(("name", "operands", "expected"), FLOATS)
def test_floats(name: str, operands: tuple[float, ...], expected: float) -> None:
    assert evaluate(name, [(x,) for x in operands]) == (pytest.approx(expected, rel=1e-15),)


INTEGERS: list[tuple[str, LaneKind, tuple[int, ...], float]] = [
    ("div", "int", (7, 0), 7),
    ("div", "int", (LOWEST, -1), LOWEST),
    ("div", "int", (-7, 2), -3),
    ("div", "uint", (7, 0), 7),
    ("mod", "int", (7, 0), 0),
    ("mod", "int", (LOWEST, -1), 0),
    ("mod", "int", (-7, 3), 2),
    ("mod", "int", (7, -3), -2),
    ("mod", "uint", (2**32 - 1, 10), 5),
    ("add", "int", (HIGHEST, 1), LOWEST),
    ("sub", "uint", (0, 1), 2**32 - 1),
    ("mul", "int", (65536, 65536), 0),
    ("neg", "int", (LOWEST,), LOWEST),
    ("abs", "int", (LOWEST,), LOWEST),
    ("to_int", "uint", (2**32 - 1,), -1),
    ("to_uint", "int", (-1,), 2**32 - 1),
    ("to_int", "bool", (True,), 1),
    ("to_float", "bool", (True,), 1.0),
    ("bit_not", "uint", (0,), 2**32 - 1),
    ("bit_not", "int", (0,), -1),
    ("bit_xor", "int", (-1, 5), -6),
    ("shift_left", "int", (1, 31), LOWEST),
    ("shift_left", "uint", (1, 33), 2),
    ("shift_left", "int", (1, -1), LOWEST),
    ("shift_right", "int", (LOWEST, 31), -1),
    ("shift_right", "uint", (2**31, 31), 1),
    ("shift_right", "int", (-7, 1), -4),
    ("count_bits", "int", (-1,), 32),
    ("count_bits", "uint", (0xF0F,), 8),
    ("reverse_bits", "int", (1,), LOWEST),
    ("reverse_bits", "uint", (2**31,), 1),
    ("first_leading_bit", "int", (0,), -1),
    ("first_leading_bit", "int", (-1,), -1),
    ("first_leading_bit", "int", (-2,), 0),
    ("first_leading_bit", "int", (LOWEST,), 30),
    ("first_leading_bit", "uint", (2**31,), 31),
    ("first_trailing_bit", "uint", (0,), -1),
    ("first_trailing_bit", "int", (LOWEST,), 31),
    ("extract_bits", "int", (0xF0, 4, 4), -1),
    ("extract_bits", "uint", (0xF0, 4, 4), 15),
    ("extract_bits", "int", (-1, 28, 9), -1),
    ("extract_bits", "uint", (5, 40, 2), 0),
    ("extract_bits", "uint", (5, -2, 40), 5),
    ("extract_bits", "int", (5, 0, 0), 0),
    ("insert_bits", "int", (0, -1, 4, 8), 0xFF0),
    ("insert_bits", "uint", (7, 0, 1, 1), 5),
    ("insert_bits", "uint", (5, 1, 40, 2), 5),
    ("insert_bits", "int", (0, -1, 31, 9), LOWEST),
    ("float_of_bits", "uint", (0x3F800000,), 1.0),
    ("float_of_bits", "uint", (0xC0200000,), -2.5),
    ("float_of_bits", "uint", (0x7F800000,), 0.0),
    ("float_of_bits", "uint", (0xFFC00001,), 0.0),
    ("float_of_bits", "uint", (0x80000000,), 0.0),
    ("float_of_bits", "uint", (0x007FFFFF,), 0.0),
]


@pytest.mark.parametrize(("name", "kind", "operands", "expected"), INTEGERS)
def test_integers(name: str, kind: LaneKind, operands: tuple[int, ...], expected: float) -> None:
    (result,) = evaluate(name, [(x,) for x in operands], kind=kind)
    assert result == expected
    assert type(result) is type(expected)


@pytest.mark.parametrize(
    ("name", "lanes", "packed"),
    [
        ("unorm4x8", (0.0, 1.0, 0.2, 0.6), 0x9933FF00),
        ("snorm4x8", (-1.0, 1.0, 0.0, -127 / 127), 0x81007F81),
        ("unorm2x16", (1.0, 0.0), 0x0000FFFF),
        ("snorm2x16", (-1.0, 1.0), 0x7FFF8001),
        ("half2x16", (1.0, -2.0), 0xC0003C00),
        ("half2x16", (2.0**-24, 65504.0), 0x7BFF0001),
    ],
)
def test_what_is_packed_can_be_unpacked(name: str, lanes: tuple[float, ...], packed: int) -> None:
    assert evaluate(f"pack_{name}", [lanes]) == (packed,)
    assert evaluate(f"unpack_{name}", [(packed,)], kind="uint") == pytest.approx(lanes)


def test_unpacking_knows_two_patterns_of_the_least_signed_number() -> None:
    assert evaluate("unpack_snorm4x8", [(0x80818001,)], kind="uint") == (1 / 127, -1, -1, -1)
    assert evaluate("unpack_half2x16", [(0xFC007E00,)], kind="uint") == (0, 0)


def test_ldexp_is_exact_and_clamps_the_exponent() -> None:
    assert evaluate("ldexp", [(0.75,), (-126,)]) == (0.75 * 2.0**-126,)
    assert evaluate("ldexp", [(3.0,), (-999,)]) == (3.0 * 2.0**-252,)


def test_inner_products_of_integers_wrap() -> None:
    big = (2**31 - 1, 2**31 - 1)
    assert evaluate("dot", [big, (2, 2)], kind="int") == (-4,)
    assert evaluate("dot", [big, (3, 1)], kind="uint") == (2**32 - 4,)


def test_lanes_are_compared_and_chosen_one_by_one() -> None:
    assert evaluate("lt", [(1.0, 2.0), (2.0, 1.0)]) == (True, False)
    chosen = evaluate("choose", [(True, False), (1, 2), (3, 4)], kind="bool")
    assert chosen == (1, 4)


def test_matrices_of_products() -> None:
    assert evaluate("outer", [(1.0, 2.0), (3.0, 4.0)]) == ((3.0, 6.0), (4.0, 8.0))
    m = ((1.0, 2.0), (3.0, 4.0))
    assert evaluate("hadamard", [m, m]) == ((1.0, 4.0), (9.0, 16.0))


def test_normalize_of_zero_is_zero() -> None:
    assert evaluate("normalize", [(0.0, -0.0, 0.0)]) == (0.0, 0.0, 0.0)


def test_reflect_of_a_long_normal_is_the_formula() -> None:
    assert evaluate("reflect", [(1.0, -1.0), (0.0, 2.0)]) == (1.0, 7.0)


def test_refract_is_zero_where_all_is_reflected() -> None:
    assert evaluate("refract", [(1.0, 0.0), (0.0, 1.0), (1.5,)]) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("nl", "nh", "power", "expected"),
    [
        (0.5, 0.5, 2.0, (1.0, 0.5, 0.25, 1.0)),
        (-0.5, 0.5, 2.0, (1.0, 0.0, 0.0, 1.0)),
        (0.5, -0.5, 0.0, (1.0, 0.5, 0.0, 1.0)),
        (0.0, 0.0, 0.0, (1.0, 0.0, 1.0, 1.0)),
    ],
)
def test_lit(nl: float, nh: float, power: float, expected: tuple[float, ...]) -> None:
    assert evaluate("lit", [(nl,), (nh,), (power,)]) == expected


@pytest.mark.parametrize("size", [2, 3, 4])
def test_inverse_of_a_singular_matrix_is_the_zero_matrix(size: int) -> None:
    ones = ((1.0,) * size,) * size
    assert evaluate("inverse", [ones]) == ((0.0,) * size,) * size


@pytest.mark.parametrize("size", [2, 3, 4])
def test_inverse_undoes(size: int) -> None:
    m = tuple(tuple(1.0 / (1 + i + j) + (i == j) for j in range(size)) for i in range(size))
    product = evaluate("mul", [m, evaluate("inverse", [m])])
    for i, column in enumerate(product):
        assert column == pytest.approx([float(i == j) for j in range(size)], abs=1e-12)


def test_matrices_are_columns_and_act_on_columns() -> None:
    m = ((1.0, 2.0), (3.0, 4.0))
    assert evaluate("mul", [m, (1.0, 10.0)]) == (31.0, 42.0)
    assert evaluate("mul", [m, (2.0,)]) == evaluate("mul", [(2.0,), m]) == ((2.0, 4.0), (6.0, 8.0))
    assert evaluate("add", [m, m]) == ((2.0, 4.0), (6.0, 8.0))
    assert evaluate("transpose", [m]) == ((1.0, 3.0), (2.0, 4.0))
    assert evaluate("determinant", [m]) == (-2.0,)


def test_rounding_may_carry_a_product_of_directions_past_one() -> None:
    cosine = BUILTINS["dot"].range((UNIT, UNIT), False)
    assert not BUILTINS["acos"].domain((cosine,))
    assert not BUILTINS["acos"].domain((UNIT,))


@pytest.mark.parametrize(
    ("name", "facts"),
    [
        ("div", (UNKNOWN, Fact(1.0, 512.0))),
        ("div", (UNKNOWN, Fact(nonzero=True))),
        ("sqrt", (BUILTINS["dot"].range((UNKNOWN, UNKNOWN), True),)),
        ("sqrt", (BUILTINS["mul"].range((UNKNOWN, UNKNOWN), True),)),
        ("sqrt", (BUILTINS["sub"].range((Fact(1.0, 1.0), Fact(0.0, 1.0)), False),)),
        ("pow", (BUILTINS["saturate"].range((UNKNOWN,), False), Fact(1.0, 512.0))),
        ("pow", (BUILTINS["max"].range((UNKNOWN, Fact(0.001, 0.001)), False), UNKNOWN)),
        ("normalize", (BUILTINS["reflect"].range((UNIT, UNIT), False),)),
        ("normalize", (BUILTINS["neg"].range((UNIT,), False),)),
        ("smoothstep", (Fact(0.0, 0.25), Fact(0.5, 1.0), UNKNOWN)),
        ("clamp", (UNKNOWN, Fact(0.0, 1.0), Fact(1.0, 2.0))),
    ],
)
def test_safe_operands_need_no_guard(name: str, facts: tuple[Fact, ...]) -> None:
    assert BUILTINS[name].domain(facts)

"""Exact numbers: what they say of their errors holds, and infinite ones do not raise."""

from __future__ import annotations

import math
from fractions import Fraction
from random import Random

import pytest

from burnish.compiler.reference import rationals
from burnish.compiler.reference.functions import evaluate
from burnish.compiler.reference.rationals import Rational

THIRD = Rational(Fraction(1, 3))


def holds(x: Rational, true: Fraction) -> bool:
    return abs(x.value - true) <= x.error


def test_arithmetic_of_fractions_has_no_error() -> None:
    found = (THIRD + 1.0) * THIRD - THIRD / 7.0
    assert (found.value, found.error) == (Fraction(4, 9) - Fraction(1, 21), 0)
    assert (2.0 - THIRD).value == Fraction(5, 3)
    assert (1.0 / THIRD).value == 3
    assert (-abs(-THIRD)).value == Fraction(-1, 3)


def test_errors_add_up() -> None:
    chance = Random(3)
    for _ in range(300):
        (x, a), (y, b) = [
            (Rational(Fraction(chance.uniform(-2, 2)), Fraction(1, 1000)), chance.uniform(-1, 1))
            for _ in range(2)
        ]
        true_x, true_y = x.value + x.error * Fraction(a), y.value + y.error * Fraction(b)
        assert holds(x + y, true_x + true_y)
        assert holds(x - y, true_x - true_y)
        assert holds(x * y, true_x * true_y)
        quotient = rationals.divide(x, y)
        if abs(y.value) > y.error:
            assert holds(quotient, true_x / true_y)
        else:
            assert math.isnan(quotient), "the divisor may be zero"


def test_constants_that_stand_for_longer_numbers() -> None:
    assert Rational.of(0.5).error == 0
    assert Rational.of(math.pi).error == Fraction(math.pi) / 2**53
    assert Rational.of(1e300).error > 0


def test_roots() -> None:
    assert rationals.sqrt(Rational(Fraction(9, 4))).error == 0
    for number in (Fraction(2), Fraction(2) ** -149, Fraction(2) ** 127 * 3):
        root = rationals.sqrt(Rational(number))
        assert (root.value - root.error) ** 2 < number < (root.value + root.error) ** 2
        assert root.error < root.value / 2**200
    assert math.isnan(rationals.sqrt(Rational(Fraction(-1))))


def test_functions_are_as_precise_as_they_say() -> None:
    one = rationals.exp(Rational(Fraction(1)))
    assert holds(one, sum((Fraction(1, math.factorial(n)) for n in range(60)), Fraction(0)))
    assert 0 < one.error < Fraction(1, 2**48)


@pytest.mark.parametrize(
    ("found", "expected"),
    [
        (rationals.exp(Rational(Fraction(10**6))), math.inf),
        (rationals.divide(THIRD, 0.0), math.inf),
        (rationals.divide(-THIRD, 0.0), -math.inf),
        (rationals.floor(math.inf), math.inf),
        (THIRD + math.inf, math.inf),
        (float(Rational(Fraction(-(10**400)))), -math.inf),
    ],
)
def test_what_is_infinite(found: float, expected: float) -> None:
    assert found == expected


def test_whole_numbers() -> None:
    numbers = [Rational(Fraction(n, 2)) for n in (-5, -3, -1, 1, 3, 5)]
    of = {name: [evaluate(name, [(n,)], rationals)[0].value for n in numbers]
          for name in ("floor", "ceil", "round", "trunc")}  # fmt: skip
    assert of == {
        "floor": [-3, -2, -1, 0, 1, 2], "ceil": [-2, -1, 0, 1, 2, 3],
        "round": [-2, -2, 0, 0, 2, 2], "trunc": [-2, -1, 0, 0, 1, 2],
    }  # fmt: skip
    assert rationals.int64(numbers[0]) == -2
    assert rationals.int64(math.nan) == 0
    assert rationals.remainder(Rational(Fraction(-11, 2)), 2.0).value == Fraction(1, 2)
    assert math.isnan(rationals.remainder(THIRD, 0.0))

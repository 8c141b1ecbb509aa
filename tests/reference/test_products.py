"""The bounds of products of many factors, in any order, also where partial products are extreme."""

from __future__ import annotations

import math
from itertools import permutations

import numpy as np
import pytest

from burnish.compiler.reference.bounds import Bounded, exact, given

pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")


def product(*factors: Bounded) -> Bounded:
    return math.prod(factors[1:], start=factors[0])


def lane(*numbers: float) -> Bounded:
    return exact(np.array(numbers))


def orders(*factors: Bounded) -> list[np.ndarray[tuple[int, ...], np.dtype[np.float32]]]:
    """What float32 makes of the factors, in every order."""
    numbers = [np.asarray(factor.value, np.float32) for factor in factors]
    return [math.prod(some[1:], start=some[0]) for some in permutations(numbers)]


LARGE, SMALL, PART = 2.0**65, 2.0**-70, 2.0**-100
EXTREME: dict[str, tuple[tuple[float, ...], tuple[float, ...]]] = {
    "constants overflow first": ((0.25, -3.0, 1e-30), (LARGE, LARGE)),
    "constants vanish first": ((3.0, -0.5, 2.0**60), (LARGE, SMALL, SMALL)),
    "a subnormal number is off by half of itself": (
        (1.5, 1.25), (2.0**-75, 2.0**-74, LARGE, LARGE),
    ),
    "some vanish, others overflow": ((2.0**20, 1.0), (LARGE, LARGE, PART, 2.0**-20)),
}  # fmt: skip
"""Numbers, and constants by which they are multiplied."""


@pytest.mark.parametrize("case", EXTREME)
def test_no_order_leaves_the_bounds(case: str) -> None:
    numbers, constants = EXTREME[case]
    factors = [lane(*numbers), *(exact(np.float64(each)) for each in constants)]
    found = product(*factors)
    for got in orders(*factors):
        assert ((found.low <= got) & (got <= found.high)).all(), (got, found.low, found.high)


def test_zero_times_infinity_may_be_anything() -> None:
    """Mesa multiplies the constants first."""
    found = product(lane(0.0, 2.0), exact(np.float64(LARGE)), exact(np.float64(LARGE)))
    assert (found.low[0], found.high[0]) == (-np.inf, np.inf)
    assert found.low[1] > 0
    assert found.high[1] == np.inf


def test_a_sign_is_known_whatever_the_order() -> None:
    found = product(lane(-3.0), exact(np.float64(SMALL)), exact(np.float64(SMALL)))
    assert found.high[0] == 0
    assert found.low[0] < 0


def test_usual_products_have_a_few_ulps() -> None:
    factors = given(np.array([0.1, 300.7, -1e-6])), given(np.array([7.3, 1e9, 2e-3]))
    found = product(*factors, given(np.array([1e-3, 1e12, 1e-3])), given(np.array([5.0, 2e3, 1e5])))
    assert (found.radius <= 9 * 2.0**-23 * np.abs(found.value)).all()

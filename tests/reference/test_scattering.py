"""The results of scattering, and the bounds of a device's elements."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.compiler.ir.kernel import ScatterOperator
from burnish.compiler.ir.leaves import Buffer
from burnish.compiler.ir.shader import Store
from burnish.compiler.ir.types import INT, UINT, RuntimeArray
from burnish.compiler.reference.bounds import Bounded, exact
from burnish.compiler.reference.scattering import joined

YES = exact(np.full(4, True))


def numbers(*values: int) -> Bounded:
    return exact(np.array(values, np.int64))


def store(operator: ScatterOperator, *, signed: bool = True) -> Store:
    element = INT if signed else UINT
    return Store(Buffer("few", RuntimeArray(element), "draw"), operator=operator)


def between(low: list[int], value: list[int], high: list[int]) -> Bounded:
    lows, values, highs = (np.array(each, np.int64) for each in (low, value, high))
    return Bounded(values, lows, highs)


@pytest.mark.parametrize(
    ("operator", "signed", "found"),
    [
        ("add", True, [1 + 4, 2 + 8, 0]),
        ("min", True, [1, 2, 2**31 - 1]),
        ("max", True, [4, 8, -(2**31)]),
        ("or", False, [5, 10, 0]),
        ("and", False, [0, 0, 2**32 - 1]),
    ],
)
def test_values_are_joined(operator: ScatterOperator, signed: bool, found: list[int]) -> None:
    value, places = numbers(1, 2, 4, 8), numbers(0, 1, 0, 1)
    for ends in joined(store(operator, signed=signed), 3, value, places, YES):
        assert ends.tolist() == found


def test_what_does_not_exist_or_hold_is_lost() -> None:
    holds = exact(np.array([True, False, True, True]))
    ends = joined(store("add"), 2, numbers(1, 2, 4, 8), numbers(0, 0, -1, 2), holds)
    assert [each.tolist() for each in ends] == [[1, 0]] * 3


def test_sums_wrap_around() -> None:
    large, first = numbers(2**31 - 1, 2, 0, 0), numbers(0, 0, 0, 0)
    signed, *_ = joined(store("add"), 1, large, first, YES)
    unsigned, *_ = joined(store("add", signed=False), 1, numbers(2**32 - 1, 2, 0, 0), first, YES)
    assert (signed.tolist(), unsigned.tolist()) == ([-(2**31) + 1], [1])


def ends_of(operator: ScatterOperator, value: Bounded, place: Bounded) -> list[NDArray[np.int64]]:
    return list(joined(store(operator), 3, value, place, YES))


def test_a_device_may_choose_either_element_where_rounding_tips() -> None:
    places = between([0, 0, 2, 2], [0, 1, 2, 2], [0, 1, 2, 2])
    value, low, high = ends_of("add", numbers(1, 10, 100, 1000), places)
    assert value.tolist() == [1, 10, 1100]
    assert low.tolist() == [1, 0, 1100]
    assert high.tolist() == [11, 10, 1100]


def test_a_device_may_join_another_value_where_rounding_tips() -> None:
    values = between([1, 5, 7, 7], [1, 6, 7, 7], [1, 6, 7, 7])
    value, low, high = ends_of("max", values, numbers(0, 1, 2, 2))
    assert value.tolist() == [1, 6, 7]
    assert low[1] <= 5 and high[1] == 6
    assert (low[0], high[0]) == (1, 1)


def test_a_device_may_join_or_not_where_rounding_tips() -> None:
    may = Bounded(np.array([True] * 4), np.array([True, False] * 2), np.array([True] * 4))
    value, low, high = joined(store("add"), 1, numbers(1, 10, 100, 1000), numbers(0, 0, 0, 0), may)
    assert (value.tolist(), low.tolist(), high.tolist()) == ([1111], [101], [1111])


def test_what_is_joined_for_certain_counts_with_the_least_that_it_may_be() -> None:
    values = between([4, 5, 0, 0], [5, 5, 0, 0], [7, 6, 0, 0])
    found = ends_of("add", values, numbers(0, 0, 2, 2))
    assert [each[0] for each in found] == [10, 9, 13]
    found = ends_of("min", values, numbers(0, 0, 2, 2))
    assert [each[0] for each in found] == [5, 4, 6]


def test_of_bits_that_rounding_tips_nothing_is_known() -> None:
    values = between([1, 2, 4, 8], [1, 2, 4, 8], [1, 3, 4, 8])
    found, low, high = ends_of("or", values, between([0, 1, 2, 2], [0, 1, 2, 2], [0, 1, 2, 3]))
    assert found.tolist() == [1, 2, 12]
    assert (low[0], high[0]) == (1, 1)
    assert (low[1:] == -(2**31)).all() and (high[1:] == 2**31 - 1).all()


def test_places_that_nobody_knows_may_be_any_element() -> None:
    places = between([-(2**31)] * 4, [0, 1, 2, 0], [2**32 - 1] * 4)
    found, low, high = ends_of("max", numbers(3, 1, 7, 2), places)
    assert (found.tolist(), high.tolist()) == ([3, 1, 7], [7, 7, 7])
    assert (low == -(2**31)).all()

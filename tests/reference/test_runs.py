"""Runs of neighbours: the same as looking at each number of each run."""

from __future__ import annotations

import numpy as np
import pytest

from burnish.compiler.reference.runs import Extremes, added_to_runs, joined_with_runs

COUNT = 21
FIRST, LAST = (each.ravel() for each in np.triu_indices(COUNT))
"""Every run of these numbers."""
NUMBERS = np.random.default_rng(1).integers(-99, 99, COUNT)
VALUES = np.random.default_rng(2).integers(-99, 99, len(FIRST))


@pytest.mark.parametrize("choose", [np.minimum, np.maximum])
def test_the_extremes_of_runs(choose: np.ufunc) -> None:
    found = Extremes(choose, NUMBERS).of(FIRST, LAST)
    runs = zip(FIRST, LAST, strict=True)
    assert found.tolist() == [choose.reduce(NUMBERS[first : last + 1]) for first, last in runs]


def test_what_is_unknown_in_a_run_makes_its_extreme_unknown() -> None:
    found = Extremes(np.minimum, np.array([1.0, np.nan, 3.0])).of(
        np.array([0, 2]), np.array([2, 2])
    )
    assert np.isnan(found).tolist() == [True, False]


def test_a_single_run() -> None:
    assert Extremes(np.maximum, NUMBERS).of(np.array(3), np.array(9)) == NUMBERS[3:10].max()


@pytest.mark.parametrize("chosen", [slice(None), slice(5, 9), slice(0, 0)])
def test_values_are_joined_with_all_numbers_of_their_runs(chosen: slice) -> None:
    first, last, values = FIRST[chosen], LAST[chosen], VALUES[chosen]
    wanted, sums = NUMBERS.copy(), NUMBERS.copy()
    for at, end, value in zip(first, last, values, strict=True):
        wanted[at : end + 1] = np.minimum(wanted[at : end + 1], value)
        sums[at : end + 1] += value
    found = joined_with_runs(np.minimum, 1000, NUMBERS, first, last, values)
    assert found.tolist() == wanted.tolist()
    assert added_to_runs(NUMBERS, first, last, values).tolist() == sums.tolist()

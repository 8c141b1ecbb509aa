"""Arrays that are read at many positions: all numbers at once are what each by itself would be."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference import tables
from burnish.compiler.reference.bounds import Bounded, Bounds, as_bounded, between, exact
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.operations import _at
from burnish.compiler.reference.tables import in_table

POSITIONS = np.array([[0, 2, 1], [-1, 3, 7]])
"""Some of them are outside of the array, whose first number is then read."""
KNOWN: tuple[tuple[Any, ...], ...] = (
    (0.5, -0.0, 0.25),
    (4, 5, -6),
    (True, False, True),
    (np.float64(1.5), 2.5, np.float64("inf")),
)
BOUNDS = Bounds(Errors(("vulkan",)))


def both(numbers: Sequence[Any], position: Any, xp: Any, patch: pytest.MonkeyPatch) -> list[Any]:
    """What is read at once, and number by number."""
    whole = tuple((number,) for number in numbers)
    at_once = _at(whole, position, xp)[0]
    patch.setattr(tables, "in_table", lambda _numbers, _position: None)
    return [at_once, _at(whole, position, xp)[0]]


@pytest.mark.parametrize("numbers", KNOWN, ids=str)
def test_numbers_of_arrays(numbers: tuple[Any, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    assert in_table(numbers, POSITIONS) is not None
    first, second = both(numbers, POSITIONS, np, monkeypatch)
    assert first.dtype == second.dtype
    np.testing.assert_array_equal(first, second)


@pytest.mark.parametrize("numbers", KNOWN, ids=str)
def test_exact_lanes(numbers: tuple[Any, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    lanes = tuple(map(as_bounded, numbers))
    assert in_table(lanes, exact(POSITIONS)) is not None
    found = both(lanes, exact(POSITIONS), BOUNDS, monkeypatch)
    assert all(isinstance(each, Bounded) and each.is_exact for each in found)
    first, second = (each.value for each in found)
    assert first.dtype == second.dtype
    np.testing.assert_array_equal(first, second)


@pytest.mark.parametrize(
    ("numbers", "position"),
    [
        ((between(1.0, 0.9, 1.1), as_bounded(2.0)), exact(POSITIONS)),
        ((as_bounded(0.1), as_bounded(2.0)), exact(POSITIONS)),
        ((exact(np.ones(3)), as_bounded(2.0)), exact(POSITIONS)),
        ((as_bounded(1.0), as_bounded(2.0)), between(POSITIONS, POSITIONS - 1, POSITIONS)),
        ((np.ones(3), 2.0), POSITIONS),
    ],
)
def test_what_is_not_known_exactly_is_chosen_by_itself(numbers: Any, position: Any) -> None:
    assert in_table(numbers, position) is None

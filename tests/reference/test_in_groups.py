"""The joined values of work groups, against loops that follow devices invocation by invocation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.compiler.reference.bounds import Bounded, exact
from burnish.compiler.reference.functions import evaluate
from burnish.compiler.reference.in_groups import InGroups
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import Fact

SIZES = (1, 2, 32, 37, 64)
COUNTS = (0, 1, 31, 64, 70, 200)


def _no_error(_name: str, _operand: object, _result: object) -> float:
    return 0.0


def _groups(values: NDArray[np.float32], size: int) -> list[list[np.float32]]:
    singles = [np.float32(value) for value in values]
    return [singles[first : first + size] for first in range(0, len(singles), size)]


def _in_pairs(group: list[np.float32], size: int) -> list[np.float32]:
    """A sum as a device adds it, in float32: the further half of the group to the nearer one."""
    shared = list(group)
    reach = 1
    while reach * 2 < size:
        reach *= 2
    while reach and size > 1:
        for place in range(min(reach, len(group))):
            if place + reach < len(group):
                shared[place] = shared[place] + shared[place + reach]
        reach //= 2
    return [shared[0]] * len(group)


def _through(group: list[np.float32], size: int) -> list[np.float32]:
    """Prefix sums as a device adds them: at every step from twice as far."""
    shared = list(group)
    reach = 1
    while reach < size:
        before = list(shared)
        for place in range(reach, len(group)):
            shared[place] = before[place - reach] + before[place]
        reach *= 2
    return shared


def _values(count: int) -> NDArray[np.float32]:
    return np.random.default_rng(count).uniform(-1, 1, count).astype(np.float32)


def _joined(found: Bounded, meant: Sequence[np.float32], exactly: Sequence[float]) -> None:
    """The value is the exact one, and what a device has lies within the bounds."""
    assert np.allclose(found.value, exactly, rtol=1e-14, atol=1e-14)
    device = np.array(meant, np.float64)
    assert (np.asarray(found.low) <= device).all() and (device <= np.asarray(found.high)).all()
    assert (np.asarray(found.high) - np.asarray(found.low) < 1e-4).all()


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("count", COUNTS)
def test_sums(size: int, count: int) -> None:
    values = _values(count)
    groups, library = _groups(values, size), InGroups(_no_error, count, size)
    lane = exact(values.astype(np.float64))
    found = library.all_joined(lambda x, y, /: x + y, lane)
    meant = [value for group in groups for value in _in_pairs(group, size)]
    exactly = [sum(map(float, group)) for group in groups for _ in group]
    _joined(found, meant, exactly)
    through = library.joined_through(lambda x, y, /: x + y, lane)
    meant = [value for group in groups for value in _through(group, size)]
    exactly = [float(v) for g in groups for v in np.cumsum(np.array(g, np.float64))]
    _joined(through, meant, exactly)
    before = library.at_the_one_before(through, 0)
    shifted = [v for g in groups for v in (0.0, *np.cumsum(np.array(g, np.float64))[:-1])]
    assert np.allclose(before.value, shifted, rtol=1e-14, atol=1e-14)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("count", COUNTS)
def test_the_least_and_the_greatest(size: int, count: int) -> None:
    values = _values(count)
    library = InGroups(_no_error, count, size)
    lane = exact(values.astype(np.float64))
    for join, of in ((library.minimum, min), (library.maximum, max)):
        found = library.all_joined(join, lane)
        assert found.is_exact
        assert found.value.tolist() == [of(g) for g in _groups(values, size) for _ in g]


def test_what_is_the_same_everywhere_counts_once_for_each_invocation() -> None:
    library = InGroups(_no_error, 70, 64)
    found = library.all_joined(lambda x, y, /: x + y, 1.0)
    assert found.value.tolist() == [64.0] * 64 + [6.0] * 6


@pytest.mark.parametrize("name", ["group_min", "group_max"])
def test_the_least_and_the_greatest_stay_in_their_range(name: str) -> None:
    values = _values(70)
    lane = exact(values.astype(np.float64))
    (found,) = evaluate(name, [(lane,)], InGroups(_no_error, 70, 64))
    claimed = BUILTINS[name].range((Fact(values.min(), values.max()),), False)
    assert (claimed.lo, claimed.hi) == (values.min(), values.max())
    assert claimed.lo <= np.min(found.value) <= np.max(found.value) <= claimed.hi

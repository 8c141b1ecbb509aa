"""Processes that judge subjects are busy until the end: simulated, with the real estimates."""

from __future__ import annotations

import heapq
import random
from collections.abc import Sequence
from pathlib import Path

import pytest

import burnish
from burnish.api import entry_points as api
from burnish.targets.conformance.costs import cost_of
from burnish.targets.conformance.scheduling import begun

FOLDER = Path(burnish.__file__).parent / "examples"
EXAMPLES = sorted([*FOLDER.glob("*.burnish"), *FOLDER.glob("frames/*.burnish")])
PROFILE = "glsl:vulkan"

pytestmark = pytest.mark.xdist_group("scheduling")  # One process estimates the costs.


def share(costs: Sequence[float], order: Sequence[int], processes: int) -> float:
    """The part of the time of one process that several need, if each begins with the next piece of
    work as soon as it has ended one."""
    free = [0.0] * processes
    for number in order:
        heapq.heapreplace(free, free[0] + costs[number])
    return max(free) / sum(costs)


def estimates() -> list[float]:
    """The estimated costs of all subjects of the examples, in the order of the files."""
    found: list[float] = []
    for path in EXAMPLES:
        variants = api.variants(path)
        if api.has_frames(path):
            variants = tuple(dict.fromkeys((rig, None) for rig, _pass in variants))
        for rig, pass_ in variants:
            result = burnish.compile(path, [PROFILE], rig=rig, pass_=pass_, partial=True)
            found += map(cost_of, result.frames or result.materials)
    return found


@pytest.fixture(scope="module")
def costs() -> list[float]:
    return estimates()


@pytest.mark.parametrize("processes", [2, 4, 16])
@pytest.mark.parametrize("off", [1.0, 2.0, 4.0])
def test_all_examples(off: float, processes: int, costs: list[float]) -> None:
    """Nobody waits long for the last one, even where each estimate is several times ``off``."""
    chance = random.Random(0)
    order = begun(costs, processes)
    for _ in range(10):
        real = [cost * off ** chance.uniform(-1, 1) for cost in costs]
        longest = max(real) / sum(real)
        ideal = max(1 / processes, longest)
        assert share(real, order, processes) <= 1.12 * ideal


def test_the_longest_example(costs: list[float]) -> None:
    """No more processes than this help, as a subject is judged by one process."""
    assert max(costs) <= 0.12 * sum(costs)


def test_the_order_of_files() -> None:
    """Only what is long comes earlier than in the order of the files, the longest first."""
    costs = [1.0, 2.0, 1.0, 300.0, 1.0, 500.0, *[1.0] * 60]
    assert begun(costs, 4) == [5, 3, 0, 1, 2, 4, *range(6, 66)]


def test_a_single_process() -> None:
    """It begins in the order of the files, as no order is faster."""
    assert begun([1.0, 300.0, 2.0, 500.0], 1) == [0, 1, 2, 3]


def test_no_order_is_far_from_the_best() -> None:
    """The last process ends at most the time of a subject that is not long behind the ideal."""
    chance = random.Random(1)
    for _ in range(300):
        processes = chance.randint(1, 20)
        costs = [chance.expovariate(1) ** 3 + 0.01 for _ in range(chance.randint(1, 200))]
        ideal = max(1 / processes, max(costs) / sum(costs))
        assert sorted(begun(costs, processes)) == list(range(len(costs)))
        # Of the long ones alone, any order that begins with the longest is within 4/3 of the best.
        assert share(costs, begun(costs, processes), processes) <= 4 / 3 * ideal + 1 / processes


def test_empty() -> None:
    assert begun([], 4) == []

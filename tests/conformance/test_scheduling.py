"""Processes that judge subjects are busy until the end: simulated, by estimates and real times."""

from __future__ import annotations

import json
import random
from collections.abc import Sequence
from pathlib import Path

import pytest

import burnish
from burnish.api import entry_points as api
from burnish.targets.conformance.cases import SIZE
from burnish.targets.conformance.costs import cost_of, frame_phases, shared_cost_of
from burnish.targets.conformance.judged_frames import judged_host
from burnish.targets.conformance.scheduling import begun, saved
from burnish.targets.runner.frames.subjects import is_frame

from .simulated import Simulation, Work, shortest, whole

FOLDER = Path(burnish.__file__).parent / "examples"
EXAMPLES = sorted([*FOLDER.glob("*.burnish"), *FOLDER.glob("frames/*.burnish")])
PROFILE = "glsl:vulkan"
MEASURED = Path(__file__).with_name("measured_costs.json")
"""Seconds of CPU that one process took to compile and to judge the subjects of the examples by the
four lavapipe routes, from nothing."""

pytestmark = pytest.mark.xdist_group("scheduling")  # One process estimates the costs.


def share(works: Sequence[Work], order: Sequence[int], processes: int) -> float:
    """The part of the time of one process that several need."""
    return Simulation(works, order, processes).end() / sum(map(whole, works))


def estimated() -> dict[str, Work]:
    """The estimated costs of all subjects of the examples by label, in the order of the files."""
    found: dict[str, Work] = {}
    for path in EXAMPLES:
        variants = api.variants(path)
        if api.has_frames(path):
            variants = tuple(dict.fromkeys((rig, None) for rig, _pass in variants))
        for rig, pass_ in variants:
            result = burnish.compile(path, [PROFILE], rig=rig, pass_=pass_, partial=True)
            for subject in result.frames or result.materials:
                label = " × ".join([f"{path.name}: {subject.name}", *filter(None, (rig, pass_))])
                work: Work = [cost_of(subject)]
                if is_frame(subject) and shared_cost_of(subject):
                    phases = frame_phases(judged_host(subject, SIZE))
                    work = [cost_of(subject) - whole(phases), *phases]
                found[label] = work
    return found


@pytest.fixture(scope="module")
def estimates() -> dict[str, Work]:
    return estimated()


def scaled(work: Work, factor: float) -> Work:
    """Work of the same phases that takes longer."""
    return [
        tuple(part * factor for part in phase) if isinstance(phase, tuple) else phase * factor
        for phase in work
    ]


@pytest.mark.parametrize("processes", [2, 4, 16])
@pytest.mark.parametrize(("off", "most"), [(1.0, 1.12), (2.0, 1.12), (4.0, 1.2)])
def test_all_examples(off: float, most: float, processes: int, estimates: dict[str, Work]) -> None:
    """Nobody waits long for the last one, even where each estimate is several times ``off``."""
    chance = random.Random(0)
    works = list(estimates.values())
    order = begun([whole(work) for work in works], processes)
    for _ in range(10):
        real = [scaled(work, off ** chance.uniform(-1, 1)) for work in works]
        longest = max(map(shortest, real)) / sum(map(whole, real))
        ideal = max(1 / processes, longest)
        assert share(real, order, processes) <= most * ideal


def as_measured(processes: int, estimates: dict[str, Work]) -> tuple[list[Work], list[int]]:
    """The works of the examples with real times, and their order by the estimates."""
    seconds = json.loads(MEASURED.read_text("utf-8"))
    known = {label: work for label, work in estimates.items() if label in seconds}
    assert len(known) > 0.9 * len(estimates), "most examples are still there"
    works = [scaled(work, seconds[label] / whole(work)) for label, work in known.items()]
    return works, begun([whole(work) for work in known.values()], processes)


@pytest.mark.parametrize("processes", [2, 4, 8, 16])
def test_all_examples_as_measured(processes: int, estimates: dict[str, Work]) -> None:
    """The order is that of the estimates, and the times are real ones."""
    works, order = as_measured(processes, estimates)
    assert share(works, order, processes) <= 1.06 / processes
    assert max(map(shortest, works)) <= 0.06 * sum(map(whole, works))


def test_help_is_worth_while(estimates: dict[str, Work]) -> None:
    """Many processes end earlier if those that have nothing to do help with long subjects."""
    works, order = as_measured(32, estimates)
    alone = [[whole(work)] for work in works]
    assert share(alone, order, 32) >= 1.3 * share(works, order, 32)


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
        works = [[cost] for cost in costs]
        assert share(works, begun(costs, processes), processes) <= 4 / 3 * ideal + 1 / processes


def test_help_ends_no_later_than_it_must() -> None:
    """All is done once, and nobody is idle while there is a part to begin with."""
    chance = random.Random(2)
    for _ in range(300):
        processes = chance.randint(1, 6)
        works: list[Work] = [
            [chance.random(), tuple(chance.random() for _ in range(chance.randint(1, 9)))]
            for _ in range(chance.randint(1, 4))
        ]
        end = Simulation(works, range(len(works)), processes).end()
        total, longest = sum(map(whole, works)), max(map(shortest, works))
        assert max(total / processes, longest) - 1e-9 <= end <= total / processes + 2 * longest
        if processes == 1:
            assert end == pytest.approx(total)


def test_processes_save_what_others_can_do() -> None:
    """The rest of a subject is done by one process, one thing after the other."""
    assert saved([], 4) == 0
    assert saved([(10.0, 0.0)], 4) == 0
    assert saved([(10.0, 0.0), (4.0, 0.0)], 4) == 4
    assert saved([(10.0, 8.0)], 4) == 7.5
    assert saved([(10.0, 8.0)], 100) == 8
    assert saved([(10.0, 8.0), (6.0, 0.0)], 1) == 0


def test_empty() -> None:
    assert begun([], 4) == []

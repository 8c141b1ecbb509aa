"""The experiment in small: a material, a route, and errors of which is known what finds them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import burnish
from burnish.targets.runner.routes import ROUTES
from burnish.targets.toolchain import Toolchain

from .errors import HOST_ERRORS, HostError
from .experiment import BOUNDS, MisledRunner, Outcome, outcome_of
from .rules import RULES
from .summary import Numbers, best, document, printed, sums
from .verdicts import KEPT_ROUTE

PLASTIC = Path(burnish.__file__).parent / "examples" / "plastic.burnish"
OTHER = "swiftshader:glsl"
PLANTED = ("red and blue exchanged", "values as half floats", "texels of 16 bits")
HOSTS = [error for error in HOST_ERRORS if error.name in PLANTED]
NOTHING = HostError("nothing", lambda job: job)


@pytest.fixture(scope="module")
def outcome() -> Iterator[Outcome]:
    """What is found of one material on two routes, with three errors and what is none."""
    routes = [ROUTES[KEPT_ROUTE], ROUTES[OTHER]]
    (material,) = burnish.compile(PLASTIC, [route.profile for route in routes]).materials
    hosts = [*HOSTS, NOTHING]
    with MisledRunner(routes) as runner, Toolchain() as toolchain:
        yield outcome_of("plastic", material, routes, runner, toolchain, count=1, hosts=hosts)


def test_correct_pictures_are_in_bounds(outcome: Outcome) -> None:
    assert [each.route for each in outcome.correct] == [KEPT_ROUTE, OTHER]
    assert not any(any(each.beyond.values()) for each in outcome.correct)
    assert [each.pictures for each in outcome.correct] == [4, 4]


def test_another_driver_makes_tolerances_cry_wolf(outcome: Outcome) -> None:
    kept, other = (each.beside_kept for each in outcome.correct)
    assert kept is None
    assert other is not None
    assert other.refused["8 bits: no lane off by more than 2 %"]


def test_larger_pictures_have_a_smaller_share_of_edges(outcome: Outcome) -> None:
    (larger,) = outcome.larger
    small = outcome.correct[1].beside_kept
    assert small is not None
    share = "share of pixels off by more than 2 %"
    assert 0 < larger.worst[share] < small.worst[share]


def test_errors_are_found_by_bounds(outcome: Outcome) -> None:
    found = {each.kind: each for each in outcome.planted}
    for kind in PLANTED:
        assert set(BOUNDS) <= {*found[kind].found}, kind
        assert found[kind].apart > 0
    assert "PSNR of at least 30 dB" not in found["texels of 16 bits"].found


def test_what_changes_no_picture_is_left_out(outcome: Outcome) -> None:
    assert outcome.unseen >= 1
    assert NOTHING.name not in {each.kind for each in outcome.planted}
    planted = len(outcome.planted) + outcome.unseen + outcome.refused
    assert planted == len(HOSTS) + 1 + 1


def test_numbers_are_summed_up(outcome: Outcome) -> None:
    numbers = Numbers()
    numbers.add(outcome)
    bounds, others = [*sums(numbers)][:3], [*sums(numbers)][3:]
    assert [each.rule for each in bounds] == [*BOUNDS]
    assert [each.rule for each in others] == [rule.name for rule in RULES]
    assert bounds[0].alarms_beside_kept is None
    same = next(each for each in others if each.rule == "8 bits: the same")
    assert same.alarms_beside_kept == 1
    for each in best(numbers):
        assert each.found <= len(outcome.planted)
    assert document(numbers, 2)["tests_beside_kept"] == 1
    assert BOUNDS[0] in printed(numbers)

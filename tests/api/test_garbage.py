"""The thresholds of Python's garbage collector during and after a call of the library."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from threading import Barrier

import pytest

from burnish.support.garbage import SELDOM, seldom_collected

from ..suite.processes import LIMIT, Background

USUAL = (700, 10, 10)


@pytest.fixture(autouse=True)
def _usual_thresholds() -> Iterator[None]:
    before = gc.get_threshold()
    gc.set_threshold(*USUAL)
    yield
    gc.set_threshold(*before)


@seldom_collected
def thresholds() -> tuple[int, int, int]:
    return gc.get_threshold()


def test_thresholds_are_raised_while_a_call_runs() -> None:
    assert thresholds() == SELDOM
    assert gc.get_threshold() == USUAL


def test_a_call_that_fails_restores_them_too() -> None:
    @seldom_collected
    def fails() -> None:
        raise KeyError

    with pytest.raises(KeyError):
        fails()
    assert gc.get_threshold() == USUAL


def test_a_call_within_a_call_leaves_them_raised() -> None:
    @seldom_collected
    def outer() -> tuple[int, int, int]:
        thresholds()
        return gc.get_threshold()

    assert outer() == SELDOM
    assert gc.get_threshold() == USUAL


def test_the_last_of_several_threads_restores_them() -> None:
    together = Barrier(2)
    seen = []

    @seldom_collected
    def first() -> None:
        together.wait(timeout=LIMIT)
        together.wait(timeout=LIMIT)
        seen.append(gc.get_threshold())

    @seldom_collected
    def second() -> None:
        together.wait(timeout=LIMIT)

    running = [Background(first), Background(second)]
    running[1].returned()
    together.wait(timeout=LIMIT)
    running[0].returned()
    assert seen == [SELDOM]
    assert gc.get_threshold() == USUAL


@pytest.mark.parametrize(
    ("host", "during"),
    [
        ((0, 10, 10), (0, 10, 10)),
        ((500_000, 10, 200), (500_000, 50, 200)),
    ],
    ids=["off", "higher"],
)
def test_a_host_that_collects_less_still_keeps_its_thresholds(
    host: tuple[int, int, int], during: tuple[int, int, int]
) -> None:
    gc.set_threshold(*host)
    assert thresholds() == during
    assert gc.get_threshold() == host


def test_thresholds_that_are_set_during_a_call_stay() -> None:
    @seldom_collected
    def sets() -> None:
        gc.set_threshold(1234, 5, 6)

    sets()
    assert gc.get_threshold() == (1234, 5, 6)

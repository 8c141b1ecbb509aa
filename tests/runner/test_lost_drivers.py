"""A driver's process that is killed costs one answer: the next one comes from a new process."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from burnish.targets.runner.drivers.device import DriverError, EndedError
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import MOST_DEATHS, Runner
from burnish.targets.toolchain.children import Child
from burnish.targets.toolchain.workers import Worker

ROUTE = ROUTES["llvmpipe:gl330"]


@pytest.fixture
def killing(monkeypatch: pytest.MonkeyPatch) -> Callable[[int], list[Child]]:
    """Kills the first few processes as soon as they are started; returns the list of all."""

    def kill(count: int) -> list[Child]:
        found: list[Child] = []
        start = Worker._start

        def started(worker: Worker) -> Child:
            found.append(start(worker))
            if len(found) <= count:
                found[-1].process.kill()
            return found[-1]

        monkeypatch.setattr(Worker, "_start", started)
        return found

    return kill


def test_the_next_question_is_answered(killing: Callable[[int], list[Child]]) -> None:
    killed = killing(1)
    with Runner([ROUTE]) as runner:
        with pytest.raises(EndedError, match=r"^llvmpipe crashed: "):
            runner.device(ROUTE)
        title = runner.device(ROUTE).title
        assert "llvmpipe" in title
        assert runner.device(ROUTE).title == title
    assert len(killed) == 2


def test_a_driver_that_always_dies_is_given_up(killing: Callable[[int], list[Child]]) -> None:
    killed = killing(100)
    with Runner([ROUTE]) as runner:
        for _ in range(MOST_DEATHS + 2):
            with pytest.raises(DriverError, match=r"^llvmpipe crashed: "):
                runner.device(ROUTE)
    assert len(killed) == MOST_DEATHS

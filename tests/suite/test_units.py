"""Neighbouring tests run in one worker, slow ones first, and each test runs once."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest

from .processes import run
from .quick import TESTS
from .units import OF_QUICK, OF_SLOW, Units, is_slow, units_of

QUICK, SLOW = "tests/syntax/test_cache.py", "tests/conformance/test_planted.py"


def names(module: str, count: int) -> list[str]:
    return [f"{module}::test_it[{number}]" for number in range(count)]


def test_neighbours_are_in_one_unit() -> None:
    collected = names(QUICK, 50) + names(SLOW, 100) + names(QUICK, 100)[50:]
    units = units_of(collected)
    assert list(units) == collected
    assert [units[test] for test in names(QUICK, 100)] == [
        f"{QUICK} {number // OF_QUICK}" for number in range(100)
    ]
    assert [units[test] for test in names(SLOW, 100)] == [
        f"{SLOW} {number // OF_SLOW}" for number in range(100)
    ]


def test_a_group_is_a_unit() -> None:
    grouped = [f"{SLOW}::test_it[{name}]@all" for name in ("one", "a@b", "other")]
    assert {*units_of([*grouped, f"{QUICK}::test_it@all"]).values()} == {"all"}
    assert units_of([f"{QUICK}::test_it[a@b]"]) == {f"{QUICK}::test_it[a@b]": f"{QUICK} 0"}


def test_modules_of_slow_folders_are_slow() -> None:
    assert is_slow(SLOW)
    assert is_slow("tests/cli/test_kills.py")
    assert not is_slow(QUICK)
    assert (TESTS.parent / QUICK).exists()


class Worker:
    """A worker that notes which tests it shall run."""

    gateway = SimpleNamespace(id="worker")
    shutting_down = False

    def __init__(self) -> None:
        self.given: list[int] = []

    def send_runtest_some(self, numbers: list[int]) -> None:
        self.given += numbers

    def shutdown(self) -> None:
        """Called when nothing is left."""


class Config:
    """The part of pytest's configuration that the scheduler asks for."""

    option = SimpleNamespace(loadscopereorder=True)

    def getvalue(self, _name: str) -> list[str]:
        return ["2*popen"]


def test_slow_units_are_handed_out_first() -> None:
    """Also those that workers get at the very beginning."""
    collected = names(QUICK, 5 * OF_QUICK) + names(SLOW, 4 * OF_SLOW)
    scheduler = Units(cast(pytest.Config, Config()), None)
    workers = [Worker(), Worker()]
    for worker in workers:
        scheduler.add_node(worker)
        scheduler.add_node_collection(worker, collected)
    scheduler.schedule()
    given = [collected[number] for worker in workers for number in worker.given]
    assert given == names(SLOW, 2 * OF_SLOW)


def test_workers_run_each_test_once(tmp_path: Path) -> None:
    (tmp_path / "test_many.py").write_text(
        "import pytest\n"
        "@pytest.mark.parametrize('number', range(100))\n"
        "def test_it(number, tmp_path):\n"
        "    with open('ran', 'a') as file: file.write(f'{number}\\n')\n"
    )
    command = [sys.executable, "-m", "pytest", "-q", "-p", "burnish.tests.suite.units"]
    run([*command, "-n", "2", "--dist", "loadgroup", "."], cwd=tmp_path, check=True)
    ran = (tmp_path / "ran").read_text().split()
    assert sorted(map(int, ran)) == list(range(100))

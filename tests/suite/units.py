"""The units in which pytest-xdist hands tests to its workers: a plugin of pytest.

Tests that are neighbours often share what they compile or draw, which fixtures and caches keep for
a while. So a worker gets several neighbours at once, and all tests of a group. Units of modules
that take long are small and come first, so that no worker is left with a long one at the end.

The scheduler of ``--dist loadgroup``, which this one replaces, hands out each test by itself. It
also looks through all finished tests after each further one: quadratic time, for 25 000 tests.
"""

from __future__ import annotations

from collections import Counter, OrderedDict
from collections.abc import Mapping, Sequence
from functools import cache, cached_property
from typing import Any

import pytest
from xdist.scheduler import LoadScopeScheduling

from .quick import TESTS, is_left_out

OF_SLOW, OF_QUICK = 8, 40
"""The most tests in a unit of a module that takes long, and of another one."""


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Units | None:
    """Called in the main process before its workers start; with ``None``, pytest-xdist chooses."""
    return Units(config, log) if config.getoption("dist") == "loadgroup" else None


class Units(LoadScopeScheduling):  # type: ignore[misc]  # pytest-xdist brings no types
    """A scheduler whose scopes are units."""

    workqueue: OrderedDict[str, dict[str, bool]]
    """The units that no worker has got yet; of each, which of its tests are complete."""

    _is_sorted = False

    def schedule(self) -> None:
        """Called when all workers have collected the tests, and again after one was replaced."""
        self._is_sorted = False
        super().schedule()

    def _assign_work_unit(self, node: Any) -> None:
        """Called by ``schedule``, when all units are known, and whenever a worker needs more."""
        if not self._is_sorted:
            ordered = sorted(self.workqueue.items(), key=lambda unit: _place(list(unit[1])))
            self.workqueue = OrderedDict(ordered)
            self._is_sorted = True
        super()._assign_work_unit(node)

    def mark_test_complete(self, node: Any, item_index: int, duration: float = 0.0) -> None:
        """Called after each test; a unit whose tests are all complete is forgotten."""
        super().mark_test_complete(node, item_index, duration)
        unit = self._split_scope(self.registered_collections[node][item_index])
        if all(self.assigned_work[node][unit].values()):
            del self.assigned_work[node][unit]

    def _split_scope(self, nodeid: str) -> str:
        return self._units[nodeid]

    @cached_property
    def _units(self) -> Mapping[str, str]:
        return units_of(self.collection or ())


def units_of(collected: Sequence[str]) -> dict[str, str]:
    """The name of each test's unit. Names of tests end with that of their group, if they have
    one."""
    before: Counter[str] = Counter()
    units = {}
    for test in collected:
        module = _module(test)
        if test.rfind("@") > test.rfind("]"):
            units[test] = test.rpartition("@")[2]
            continue
        size = OF_SLOW if is_slow(module) else OF_QUICK
        units[test] = f"{module} {before[module] // size}"
        before[module] += 1
    return units


@cache
def is_slow(module: str) -> bool:
    """True if a module takes long, or lies in a folder whose modules do."""
    path = TESTS.parent / module
    return is_left_out(path) or any(map(is_left_out, path.parents))


def _place(tests: Sequence[str]) -> tuple[bool, int]:
    """The place of a unit among the others: slow ones first, and of these the largest."""
    return not is_slow(_module(tests[0])), -len(tests)


def _module(test: str) -> str:
    return test.partition("::")[0]

"""Texts with mistakes neither upset the compiler, nor become shaders that others refuse.

``make fuzz`` tries other texts, for as long as one likes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest

from burnish.targets.toolchain import Toolchain

from ..suite.verdicts import refused
from .mutations import mutated
from .robustness import jobs, problem

TEXTS, AT_ONCE = 800, 50
CHECKED = range(1, 160, 2)
"""The seeds of texts with a single change each; about one in fifteen still compiles."""


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


@pytest.mark.parametrize("first", range(0, TEXTS, AT_ONCE))
def test_mistakes_are_reported_not_raised(first: int) -> None:
    for seed in range(first, first + AT_ONCE):
        trouble = problem(mutated(seed), native_stages=seed % 4 < 2)
        assert trouble is None, f"seed {seed}: {trouble}\n{mutated(seed)}"


def test_what_is_accepted_is_accepted_by_others(toolchain: Toolchain) -> None:
    asked = [
        replace(job, name=f"seed {seed}: {job.name}")
        for seed in CHECKED
        for job in jobs(mutated(seed))
    ]
    wrong = [f"{each.report()}\n{each.job.text}" for each in refused(asked, toolchain)]
    assert asked and not wrong, "\n".join(wrong)


def test_a_seed_always_gives_the_same_text() -> None:
    assert mutated(57) == mutated(57) != mutated(59)

"""Texts with mistakes neither upset the compiler, nor become shaders that others refuse.

``make fuzz`` tries other texts, for as long as one likes.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from burnish.targets.toolchain import Toolchain

from .mutations import mutated
from .robustness import problem, refused

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
    for seed in CHECKED:
        trouble = refused(mutated(seed), toolchain)
        assert trouble is None, f"seed {seed}: {trouble}\n{mutated(seed)}"


def test_a_seed_always_gives_the_same_text() -> None:
    assert mutated(57) == mutated(57) != mutated(59)

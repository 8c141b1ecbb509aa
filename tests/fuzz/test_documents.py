"""Plans and reflections with mistakes are refused in words, or are good: a few of them.

``make fuzz`` tries other ones, for as long as one likes.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from .hostile.plans import NAMES, mistaken, outcome, received, trouble

DOCUMENTS, AT_ONCE = 240, 30


@pytest.mark.parametrize("first", range(0, DOCUMENTS, AT_ONCE))
def test_mistakes_are_told_not_raised(tmp_path: Path, first: int) -> None:
    for name in NAMES:
        received(name).write(tmp_path)
    for number in range(first, first + AT_ONCE):
        found = trouble(mistaken(number).write_documents(tmp_path))
        assert found is None, f"{number}: {found}"


@pytest.mark.parametrize("name", NAMES)
def test_nothing_is_said_of_what_is_good(tmp_path: Path, name: str) -> None:
    assert outcome(received(name).write(tmp_path)) == ""


def test_a_number_always_gives_the_same_mistakes() -> None:
    assert mistaken(7) == mistaken(7) != mistaken(8)

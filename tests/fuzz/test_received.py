"""A few hostile things of each kind; ``make fuzz`` tries others, for as long as one likes."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from . import received
from .received import KINDS, Received

TRIALS = 15


@pytest.mark.parametrize("kind", KINDS)
def test_hostile_things_are_answered(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    # The process of a test has drawn and compiled before.
    monkeypatch.setattr(received, "MEMORY", 1 << 62)
    trials = Received([kind])
    for number in range(TRIALS):
        assert trials.trouble(kind, f"test:{number}") is None


def test_what_is_raised_is_trouble(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(_random: Random, _folder: Path) -> None:
        raise KeyError("wrap")

    monkeypatch.setitem(KINDS, "broken", lambda: fails)
    trouble = Received(["broken"]).trouble("broken", "1:2")
    assert trouble is not None
    assert trouble.name == "broken:1:2"
    assert trouble.text.endswith("KeyError: 'wrap'\n")


def test_what_takes_long_is_trouble(monkeypatch: pytest.MonkeyPatch) -> None:
    def waits(_random: Random, _folder: Path) -> None:
        for _ in iter(int, 1):
            pass

    monkeypatch.setattr(received, "SECONDS", 1)
    monkeypatch.setitem(KINDS, "slow", lambda: waits)
    trouble = Received(["slow"]).trouble("slow", "1:2")
    assert trouble is not None
    assert "no answer within 1 s" in trouble.text

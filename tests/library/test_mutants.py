"""A few errors that are planted in the library are found, and the tool tells the others.

``python -m tests.library.mutants`` plants all of them.
"""

from __future__ import annotations

import random

import pytest

from .changes import Change, changes
from .mutants import EQUIVALENT, all_changes, judged, text_of

pytestmark = pytest.mark.xdist_group("library_mutants")  # One process finds all changes.

FEW = 8
SEED = 5


def chosen() -> list[Change]:
    return random.Random(SEED).sample(all_changes(), FEW)


@pytest.mark.parametrize("number", range(FEW))
def test_planted_errors_are_found(number: int) -> None:
    change = chosen()[number]
    told = change.told(text_of(change.file))
    assert told in EQUIVALENT or judged(change)["verdict"] == "caught", told


def test_a_change_without_an_effect_survives() -> None:
    """The length of a vector that is normalised does not count."""
    text = text_of("lights")
    start = text.index("vec3(0, -1, 0)")
    change = Change("lights", "std.lights.Directional", start, start, " ")
    assert judged(change)["verdict"] == "survived"


def test_each_expression_has_changes() -> None:
    text = "fn f(x: float, y: float) -> float = if x < 2 then min(x, -y) else (x + y * 3).x"
    found = {change.applied(text).partition("= ")[2] for change in changes("some", text)}
    assert found >= {
        "if x > 2 then min(x, -y) else (x + y * 3).x",
        "if x < 3 then min(x, -y) else (x + y * 3).x",
        "if x < 2 then (x + y * 3).x else min(x, -y)",
        "if x < 2 then max(x, -y) else (x + y * 3).x",
        "if x < 2 then min(x, y) else (x + y * 3).x",
        "if x < 2 then min(x, -y) else (x - y * 3).x",
        "if x < 2 then min(x, -y) else (x + y / 3).x",
        "if x < 2 then min(x, -y) else (x + y * 4).x",
        "if x < 2 then min(x, -y) else (x + y * 3).y",
    }

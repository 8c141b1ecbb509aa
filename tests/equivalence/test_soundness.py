"""Nothing is proven of random pairs of programs that the reference tells apart at some point."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from random import Random

import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.equivalence.comparing import Settings, compare
from burnish.compiler.equivalence.programs import NotComparableError, TooLargeError

from ..fuzz.programs import program
from ..fuzz.rewritings import rewritten
from ..passes.kit import shaders
from .kit import apart

POINTS = 400
EXCHANGED = (
    (" + ", " - "), (" < ", " <= "), (" * ", " + "), ("min(", "max("), ("sin(", "cos("),
    (".x", ".y"), ("saturate(", "abs("), ("floor(", "round("),
)  # fmt: skip


def _changed(text: str, chance: Random) -> Iterator[str]:
    """The program with a small mistake."""
    numbers = list(re.finditer(r"(?<![\w.#])\d+\.\d+(?![\w.])", text))
    if numbers:
        found = chance.choice(numbers)
        value = float(found[0]) * 1.01 + chance.choice([0.01, 1e-5, 0.5])
        yield text[: found.start()] + repr(value) + text[found.end() :]
    for one, other in EXCHANGED:
        places = [found.start() for found in re.finditer(re.escape(one), text)]
        if places:
            at = chance.choice(places)
            yield text[:at] + other + text[at + len(one) :]


@pytest.mark.parametrize("number", range(8))
def test_what_is_proven_of_random_programs_is_so(number: int) -> None:
    chance = Random(number)
    tree = program(f"same {number}")
    text = str(tree)
    others = [*_changed(text, chance)]
    chance.shuffle(others)
    for other in others[:2]:
        try:
            first, second = shaders(text)[-1], shaders(other)[-1]
            found = compare(first, second, Settings(boxes=100))
        except (CompileError, NotComparableError, TooLargeError):
            continue
        if found.verdict != "same":
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for name, difference in apart(first, second, POINTS, number):
                assert difference <= 1e-4, (name, other)


@pytest.mark.parametrize("number", range(8, 12))
def test_no_point_tells_programs_apart_that_mean_the_same(number: int) -> None:
    tree = program(f"same {number}")
    found = list(rewritten(tree, str(number)))
    Random(number).shuffle(found)
    for name, other in found[:2]:
        if name == "declare more":  # It may deliver more than the original.
            continue
        try:
            first, second = shaders(str(tree))[-1], shaders(str(other))[-1]
            verdict = compare(first, second, Settings(boxes=100)).verdict
        except (CompileError, NotComparableError, TooLargeError):
            continue
        assert verdict != "different", name

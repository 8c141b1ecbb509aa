"""The turns that loops certainly take, said before anything is computed."""

from __future__ import annotations

import pytest

from burnish.compiler.reference.evaluate import Evaluator
from burnish.compiler.reference.turns import least_turns

from .kit import shader

LOOPS = {
    "sum i in 0..10 : float(i)": 10,
    "sum i in 2..10 : float(i)": 8,
    "sum i in 0..10 : sum j in 0..20 : float(i * j)": 10 * (1 + 20),
    "sum i in 0..10 : float(i) * (sum j in 0..20 : float(j))": 10,  # One is kept.
    "twice(sum i in 0..10 : float(i))": 10,
    "sum i in 0..10 : called(float(i))": 10 * (1 + 7),
    "if (sum i in 0..10 : i) > 9 then (sum i in 0..30 : float(i)) else 1.0": 10,
    "iterate t from 1.0 for i in 0..20 : t + (sum j in 0..5 : t * float(j))": 0,
    "iterate t from (sum j in 0..5 : float(j)) for i in 0..20 : t + 1.0": 5,
}
FUNCTIONS = """
fn twice(x: float) -> float = 2 * x
fn called(x: float) -> float = sum j in 0..7 : x * float(j)
"""


@pytest.mark.parametrize("text", LOOPS)
def test_turns_are_counted_without_computing(text: str) -> None:
    (result,) = shader(f"{FUNCTIONS} material M {{ alpha = {text} }}").results_of("target")
    alpha = result.value.operands[-1]
    assert least_turns(alpha) == LOOPS[text]
    evaluator = Evaluator(most_operations=10**6)
    evaluator.value(alpha)
    assert LOOPS[text] <= evaluator.computed


def test_nobody_knows_what_values_from_outside_are_computed_from() -> None:
    text = "material M { alpha = uv.x * (sum i in 0..10 : float(i)) }"
    (result,) = shader(text).results_of("target")
    assert least_turns(result.value) == 0

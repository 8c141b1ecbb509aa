"""The process that measures compiles finds the functions that it measures."""

from __future__ import annotations

from pathlib import Path

from .checkout import Checkout

ROOT = Path(__file__).parents[2]


def test_a_worker_says_what_each_phase_took() -> None:
    with Checkout("this", ROOT).worker() as worker:
        answer = worker.compile(ROOT / "examples" / "plastic.burnish", runs=1, limit=60.0)
    assert answer is not None and answer["codes"] == []
    phases = {"parse", "semantics", "passes", "emission", "reflection", "all"}
    assert set(answer["seconds"]) == phases

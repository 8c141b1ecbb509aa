"""The process that measures compiles finds the functions that it measures."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

from .checkout import Checkout

ROOT = Path(__file__).parents[2]


def test_a_worker_says_what_each_phase_took() -> None:
    with Checkout("this", ROOT).worker() as worker:
        answer = worker.compile(ROOT / "examples" / "plastic.burnish", runs=1, limit=60.0)
    assert answer is not None and answer["codes"] == []
    phases = {"parse", "semantics", "passes", "emission", "reflection", "all"}
    assert set(answer["seconds"]) == phases


def test_a_worker_imports_a_document_before_it_compiles_it() -> None:
    path = ROOT / "tests" / "bench" / "open_pbr.mtlx"
    with Checkout("this", ROOT).worker() as worker:
        answer = worker.compile(path, ("wgsl",), runs=1, limit=60.0)
    assert answer is not None
    if find_spec("MaterialX") is None:
        assert answer == {"failed": "ModuleNotFoundError"}
    else:
        assert answer["codes"] == [] and answer["seconds"]["semantics"] > 0

"""Durations, measured so that a busy machine spoils them least."""

from __future__ import annotations

import gc
from collections.abc import Callable
from statistics import median
from time import perf_counter


def seconds(work: Callable[[], object], runs: int = 1) -> list[float]:
    """How long each of ``runs`` runs of ``work`` took, each from a collected heap."""
    found = []
    for _ in range(runs):
        gc.collect()
        start = perf_counter()
        work()
        found.append(perf_counter() - start)
    return found


def milliseconds(durations: list[float]) -> dict[str, float]:
    """The typical and the best duration."""
    return {"median ms": 1000 * median(durations), "best ms": 1000 * min(durations)}

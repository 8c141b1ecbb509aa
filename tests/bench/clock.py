"""Durations, measured so that a busy machine spoils them least."""

from __future__ import annotations

import gc
from collections.abc import Callable
from statistics import median
from time import perf_counter

PATIENCE = 1800.0
"""Seconds after which a command that is measured is taken to hang."""


def seconds(work: Callable[[], object], runs: int = 1) -> list[float]:
    """The times of ``runs`` runs of ``work``, each from a collected heap."""
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


class Laps:
    """Times phases that follow one another."""

    def __init__(self) -> None:
        self.found: dict[str, list[float]] = {}
        self._since = 0.0

    def start(self) -> None:
        """The first phase begins."""
        gc.collect()
        self._since = perf_counter()

    def lap(self, phase: str) -> None:
        """``phase`` has ended, and the next one begins."""
        now = perf_counter()
        self.found.setdefault(phase, []).append(now - self._since)
        self._since = perf_counter()

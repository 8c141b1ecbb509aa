"""Frames: how long the deferred one takes to compile and to draw, and how much memory the results
of the example with the most steps need."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from time import process_time

import burnish

from ..frames.kit import EXAMPLES, compiled, memory_share
from .aims import DEFERRED
from .drawing import command_times
from .table import Row, Section

TARGETS = ("hlsl", "glsl", "wgsl")
COMPILE_AIM, RENDER_AIM, MEMORY_AIM = 0.1, 3.0, 0.6
RUNS = 12
"""The number of runs; the best one counts."""
COMMANDS = 3
"""Likewise."""


def measure() -> Iterator[Section]:
    """A row for each number."""
    rows = [
        _row("deferred: all passes and the plan, three targets, warm, s of CPU", _compile(),
             COMPILE_AIM),
        _row(f"memory of the results of {_largest().stem} after sharing, as a share",
             memory_share(compiled(_largest())), MEMORY_AIM),
    ]  # fmt: skip
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        picture = str(folder / "deferred.png")
        render = ("render", str(DEFERRED), "-o", picture, "--size", "512", "--on", "lavapipe:glsl")
        times = [command_times(folder / "cache", *render) for _ in range(COMMANDS)]
    rows += [
        _row("deferred on lavapipe, 512 × 512, a fresh process, s by the clock",
             min(wall for _, wall in times), RENDER_AIM),
        _row("the same, s of CPU", min(cpu for cpu, _ in times), RENDER_AIM),
    ]  # fmt: skip
    yield Section("frames", "Frames: time and memory", rows)


def _row(what: str, found: float, aim: float) -> Row:
    return {"what": what, "found": round(found, 3), "at most": aim, "within": found <= aim}


def _largest() -> Path:
    return max(EXAMPLES, key=lambda path: len(compiled(path).plan.steps))


def _compile() -> float:
    return _best(lambda: [frame.plan for frame in burnish.compile(DEFERRED, TARGETS).frames])


def _best(do: Callable[[], object]) -> float:
    do()
    found = []
    for _ in range(RUNS):
        start = process_time()
        do()
        found.append(process_time() - start)
    return min(found)

"""The times of pictures: the reference's own, and a conformance run, from nothing and again."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage

from burnish.targets.toolchain.tools import cache_folder

from .clock import PATIENCE
from .table import Row, Section

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.burnish"))
PICTURE_LIMIT = 2.0
COLD_LIMIT, WARM_LIMIT = 300.0, 20.0
RUNS = 3


def measure() -> Iterator[Section]:
    """A picture of 512 × 512 pixels, and all examples on the four ways to lavapipe."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        plastic = ROOT / "examples" / "plastic.burnish"
        picture = ("render", str(plastic), "-o", str(folder / "plastic.png"))
        best = min(_seconds(folder, *picture) for _ in range(RUNS))
        yield Section(
            "render", "A fresh process draws plastic by the reference, 512 × 512",
            [_row("best of three", best, PICTURE_LIMIT)],
        )  # fmt: skip
        run = ("conform", *map(str, EXAMPLES), "--routes", "lavapipe")
        rows = [
            _row("from nothing", _seconds(folder / "store", *run), COLD_LIMIT),
            _row("again", _seconds(folder / "store", *run), WARM_LIMIT),
        ]
        yield Section("conform", "All examples on the four lavapipe routes", rows)


def _row(what: str, taken: float, limit: float) -> Row:
    return {"what": what, "s": round(taken, 2), "at most": limit, "within": taken <= limit}


def _seconds(cache: Path, *arguments: str) -> float:
    """The wall-clock time of one command in a fresh process, with caches in a folder of its own."""
    return command_times(cache, *arguments)[1]


def command_times(cache: Path, *arguments: str) -> tuple[float, float]:
    """Seconds of CPU of one command, with all processes that it starts, and by the clock."""
    moved = {"BURNISH_CACHE": str(cache), "BURNISH_TOOLS": str(cache_folder())}
    command = [sys.executable, "-m", "burnish", *arguments]
    before, started = getrusage(RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(
        command, check=True, timeout=PATIENCE, stdout=subprocess.DEVNULL, env=os.environ | moved
    )
    after, taken = getrusage(RUSAGE_CHILDREN), time.perf_counter() - started
    user, system = after.ru_utime - before.ru_utime, after.ru_stime - before.ru_stime
    return user + system, taken

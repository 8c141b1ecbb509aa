"""The parts of a compile's time: its phases, its functions, and the imports of a fresh process."""

from __future__ import annotations

import cProfile
import os
import pstats
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, cast

import burnish
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.frontend import Frontend
from burnish.compiler.passes import pipeline
from burnish.targets import registry
from burnish.targets.emit.emitter import EmitOptions, emit
from burnish.targets.legalise.legalise import legalise

from .clock import PATIENCE, Laps, milliseconds
from .table import Row, Section

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "plastic.burnish"
RUNS = 60
SHOWN = 20

Call = tuple[str, int, str]
"""A function as the profiler names it: file, line, name."""
Timings = tuple[int, int, float, float, dict[Call, tuple[int, int, float, float]]]
"""The profiler's numbers of a function: calls, own time, time with callees, the same by caller."""


def measure() -> Iterator[Section]:
    """The phases of a warm compile, what the profiler says of it, and the imports of a cold one."""
    yield Section("phases", f"Phases of a warm compile to three targets, {RUNS} runs", _phases())
    timings = _profile()
    yield Section("passes", "Its middle end, as the profiler sees it", _passes(timings))
    yield Section("functions", "Its most costly functions, likewise", _functions(timings))
    yield Section("imports", "The slowest imports of a fresh process", _imports())


def _compile() -> object:
    return burnish.compile(EXAMPLE)


def _phases() -> list[Row]:
    laps = Laps()
    targets = [registry.load(name) for name in registry.defaults()]
    for _ in range(RUNS):
        laps.start()
        frontend = Frontend(Report())
        module = frontend.open_file(EXAMPLE)
        assert module is not None
        laps.lap("parse, with imports")
        (shader,) = frontend.shaders(module, None, None, None)
        laps.lap("semantics")
        staged = pipeline.stage(shader, pipeline.Options())
        laps.lap("passes")
        for target in targets:
            legal = legalise(staged.program, target, target.profiles[0], staged.undecided)
            laps.lap(f"legalise {target.name}")
            emit(legal, EmitOptions())
            laps.lap(f"emit {target.name}")
    return [{"phase": phase, **milliseconds(found)} for phase, found in laps.found.items()]


# --- the profiler --------------------------------------------------------------------------------


def _profile() -> dict[Call, Timings]:
    profiler = cProfile.Profile()
    for _ in range(RUNS // 3):
        profiler.runcall(_compile)
    stats = cast(Any, pstats.Stats(profiler))
    return cast(dict[Call, Timings], stats.stats)


def _whole(timings: dict[Call, Timings]) -> float:
    return sum(own for _, _, own, _, _ in timings.values())


def _passes(timings: dict[Call, Timings]) -> list[Row]:
    """Everything that ``pipeline.stage`` calls, by its share of the compile."""
    inside = {name for name in timings if name[2] == "stage" and name[0].endswith("pipeline.py")}
    whole = _whole(timings)
    shares: list[tuple[float, str]] = []
    for (_, _, name), (*_, callers) in timings.items():
        share = sum(callers[caller][3] for caller in inside & callers.keys()) / whole
        if share >= 0.001:
            shares.append((share, name))
    return [{"pass": name, "share": share} for share, name in sorted(shares, reverse=True)]


def _functions(timings: dict[Call, Timings]) -> list[Row]:
    costly = sorted(timings.items(), key=lambda item: item[1][2], reverse=True)
    whole = _whole(timings)
    return [
        {
            "function": f"{_place(path)}{name}",
            "own share": own / whole,
            "with callees": cumulated / whole,
            "calls": calls // (RUNS // 3),
        }
        for (path, _, name), (_, calls, own, cumulated, _) in costly[:SHOWN]
    ]


def _place(path: str) -> str:
    """A file's name for people: within the checkout, or the last part of it."""
    if path.startswith(str(ROOT)):
        return f"{Path(path).relative_to(ROOT)}: "
    return "" if path == "~" else f"{Path(path).name}: "


# --- fresh processes -----------------------------------------------------------------------------


def _command(*options: str) -> list[str]:
    compile_ = ["compile", str(EXAMPLE), "--target", "wgsl", "-o", "-"]
    return [sys.executable, *options, "-m", "burnish", *compile_]


def _run(command: list[str]) -> str:
    """The error output of a command; byte code is cached as for any user."""
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    done = subprocess.run(
        command, env=environment, capture_output=True, text=True, check=True, timeout=PATIENCE
    )
    return done.stderr


def _imports() -> list[Row]:
    """The times of imports.

    They are from ``-X importtime``, with lines ``import time: own | with imports | module``.
    """
    own: dict[str, float] = {}
    for line in _run(_command("-X", "importtime")).splitlines():
        _, _, figures = line.partition("import time:")
        parts = [part.strip() for part in figures.split("|")]
        if len(parts) == 3 and parts[0].isdigit():
            own[parts[2]] = int(parts[0]) / 1000
    slowest = sorted(own.items(), key=lambda item: item[1], reverse=True)[:SHOWN]
    rows: list[Row] = [{"module": name, "own ms": found} for name, found in slowest]
    return [{"module": f"all {len(own)}", "own ms": sum(own.values())}, *rows]

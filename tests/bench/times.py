"""How long a compile takes: warm, phase by phase, and from a cold start."""

from __future__ import annotations

import cProfile
import os
import pstats
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from statistics import median

import burnish
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.frontend import Frontend
from burnish.compiler.passes import pipeline
from burnish.targets import registry
from burnish.targets.emit.emitter import EmitOptions, emit

from .clock import milliseconds, seconds
from .table import Row, Section

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "plastic.burnish"
RUNS = 60
WARM_LIMIT = 15.0
COLD_RUNS = 15
COLD_LIMIT = 150.0
FUNCTIONS_SHOWN = 20
MODULES_SHOWN = 20

Call = tuple[str, int, str]
"""A function as the profiler names it: file, line, name."""


def measure() -> Iterator[Section]:
    """Warm totals with their phases, then cold starts with their imports."""
    durations = seconds(_compile, RUNS)
    total = milliseconds(durations)
    within = total["median ms"] <= WARM_LIMIT
    row: Row = {"what": "plastic, three targets", **total, f"at most {WARM_LIMIT}": within}
    yield Section("warm", f"Warm compile, {RUNS} runs", [row])
    yield Section("phases", "Phases of a warm compile", _phases())
    stats = _profile()
    yield Section("passes", "Middle end: share of each pass, after the profiler", _passes(stats))
    yield Section("functions", "Where the time goes, after the profiler", _functions(stats))
    yield Section("cold", f"Fresh processes, {COLD_RUNS} of each", list(_cold()))
    yield Section("imports", "Slowest modules to import, without what they import", _imports())


def _compile() -> object:
    return burnish.compile(EXAMPLE)


def _phases() -> list[Row]:
    """Each phase's own time, over whole compiles taken apart."""
    found: dict[str, list[float]] = {}

    def timed(phase: str, work: object) -> None:
        assert callable(work)
        found.setdefault(phase, []).extend(seconds(work))

    for _ in range(RUNS):
        frontend = Frontend(Report())
        module = frontend.open_file(EXAMPLE)
        assert module is not None
        (shader,) = frontend.shaders(module, None, None, None)
        staged = pipeline.stage(shader, pipeline.Options())
        timed("parse, with imports", lambda: Frontend(Report()).open_file(EXAMPLE))
        timed("parse and semantics", _front)
        timed("parse, semantics and passes", lambda: pipeline.stage(_front(), pipeline.Options()))
        for name in registry.names():
            target = registry.load(name)
            profile = target.profiles[0]
            timed(
                f"emit {name}",
                lambda target=target, profile=profile: emit(
                    staged.program, target, profile, EmitOptions()
                ),
            )
    return [{"phase": phase, **milliseconds(durations)} for phase, durations in found.items()]


def _front() -> pipeline.Shader:
    frontend = Frontend(Report())
    module = frontend.open_file(EXAMPLE)
    assert module is not None
    return frontend.shaders(module, None, None, None)[0]


def _profile() -> pstats.Stats:
    profiler = cProfile.Profile()
    for _ in range(RUNS // 3):
        profiler.runcall(_compile)
    return pstats.Stats(profiler)

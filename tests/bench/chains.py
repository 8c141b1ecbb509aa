"""Long programs: the time a node takes must not grow, and long text must be taken downstream."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from time import perf_counter

import burnish
from burnish.targets import registry
from burnish.targets.toolchain import Job, Toolchain

from .clock import seconds
from .lean import STAGES
from .table import Row, Section

LENGTHS = (10, 100, 1000, 10_000)
LONGEST = 40_000
"""As long as a file may be. Measured of the plainest shape only, by ``aims``: it takes long."""
DEPTHS = (10, 20, 30)
ACCEPTED = 5000
TIME_LIMIT = 300.0
PATIENCE = 10.0
"""Seconds: a shape that takes longer is not tried at greater lengths, nor downstream."""
NODES_A_RUN = 3000
"""Short chains are compiled more often, for a steadier median."""


def measure() -> Iterator[Section]:
    """Time a node at each length, and every checker's answer at one."""
    rows = {name: list(_lengths(name, text)) for name, text in SHAPES.items()}
    everything = [row for found in rows.values() for row in found]
    yield Section("chains", "Time a node, text to all targets", everything)
    doubled = list(map(_doubled, DEPTHS))
    yield Section("doublings", "What would double at each step if sharing were lost", doubled)
    bearable = [name for name, found in rows.items() if len(found) == len(LENGTHS)]
    answers = [row for name in bearable for row in _answers(name, SHAPES[name](ACCEPTED))]
    yield Section("accepted", f"Chains of {ACCEPTED} nodes downstream", answers)


def equations(length: int) -> str:
    """A material of equations, each of which needs the one before."""
    return _chain("fract(uv.x)", length)


def affine(length: int) -> str:
    """A chain over an interpolated value, which the vertex stage can compute as a whole."""
    return _chain("uv.x", length)


def _chain(start: str, length: int) -> str:
    steps = "\n".join(f"x{i + 1} = x{i} * a + b" for i in range(length))
    head = f"param a : float\nparam b : float\nx0 = {start}"
    return _material(f"{head}\n{steps}\ncolor = vec3(x{length})")


def total(length: int) -> str:
    """A material with one long sum."""
    terms = " + ".join(f"sin(uv.x * {i + 1}.5)" for i in range(length))
    return _material(f"total = {terms}\ncolor = vec3(total)")


def doublings(depth: int) -> str:
    """Values and functions that each use the one before twice."""
    steps = "\n".join(f"x{i + 1} = twice(x{i}) + twice(x{i})" for i in range(depth))
    function = "fn twice(x: float) -> float = half(half(x) + half(x))\n"
    function += "fn half(x: float) -> float = sin(x + x)\n"
    return function + _material(f"x0 = uv.x\n{steps}\ncolor = vec3(x{depth})")


SHAPES: dict[str, Callable[[int], str]] = {
    "equations": equations,
    "affine": affine,
    "sum": total,
}


def _doubled(depth: int) -> Row:
    source = doublings(depth)
    (material,) = burnish.compile(source).materials
    best = min(seconds(partial(burnish.compile, source), 10))
    lines = material.text("wgsl", "fragment").count("\n")
    return {"depth": depth, "best ms": 1000 * best, "lines of WGSL": lines}


def _material(body: str) -> str:
    return f"material Long {{\n{body}\n}}\n"


def _lengths(name: str, shape: Callable[[int], str]) -> Iterator[Row]:
    shorter: float | None = None
    for length in LENGTHS:
        runs = 1 + NODES_A_RUN // length
        best = min(seconds(partial(burnish.compile, shape(length)), runs))
        each = 1e6 * best / length
        growth = None if shorter is None else each / shorter
        yield {
            "shape": name,
            "nodes": length,
            "best ms": 1000 * best,
            "us a node": each,
            "to the row above": growth,
        }
        shorter = each
        if best > PATIENCE:
            return


def _answers(name: str, source: str) -> Iterator[Row]:
    with Toolchain(time_limit=TIME_LIMIT) as toolchain:
        for job in _jobs(source, name):
            start = perf_counter()
            (verdict,) = toolchain.check([job])
            yield {
                "text": job.name,
                "checker": job.checker,
                "verdict": verdict.status,
                "seconds": perf_counter() - start,
            }


def _jobs(source: str, shape: str) -> list[Job]:
    targets = [registry.load(name) for name in registry.names()]
    names = [f"{target.name}:{profile.name}" for target in targets for profile in target.profiles]
    (material,) = burnish.compile(source, names).materials
    return [
        Job(checker, STAGES[file.stage], file.text, name=f"{shape}: {file.name}")
        for file in material.files
        if len(file.text) > ACCEPTED
        for checker in file.checkers
    ]

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
ACCEPTED = 5000
TIME_LIMIT = 300.0
NODES_A_RUN = 3000
"""Short chains are compiled more often, for a steadier median."""


def measure() -> Iterator[Section]:
    """Time a node at each length, and every checker's answer at one."""
    rows = [row for text in SHAPES.values() for row in _lengths(text)]
    yield Section("chains", "Time a node, text to all targets", rows)
    yield Section("accepted", f"Chains of {ACCEPTED} nodes downstream", _answers())


def equations(length: int) -> str:
    """A material of equations, each of which needs the one before."""
    steps = "\n".join(f"x{i + 1} = x{i} * a + b" for i in range(length))
    return _material(
        f"param a : float\nparam b : float\nx0 = uv.x\n{steps}\ncolor = vec3(x{length})"
    )


def total(length: int) -> str:
    """A material with one long sum."""
    terms = " + ".join(f"sin(uv.x * {i + 1}.5)" for i in range(length))
    return _material(f"total = {terms}\ncolor = vec3(total)")


SHAPES: dict[str, Callable[[int], str]] = {"equations": equations, "sum": total}


def _material(body: str) -> str:
    return f"burnish 1\nmaterial Long {{\n{body}\n}}\n"


def _lengths(shape: Callable[[int], str]) -> Iterator[Row]:
    first: float | None = None
    for length in LENGTHS:
        text = shape(length)
        best = min(seconds(partial(burnish.compile, text), 1 + NODES_A_RUN // length))
        each = 1e6 * best / length
        first = first if length > 1000 else each
        yield {
            "shape": shape.__name__,
            "nodes": length,
            "best ms": 1000 * best,
            "us a node": each,
            "to 1000 nodes": None if first is None or length < 1000 else each / first,
        }


def _answers() -> list[Row]:
    rows: list[Row] = []
    with Toolchain(time_limit=TIME_LIMIT) as toolchain:
        for shape, text in SHAPES.items():
            jobs = _jobs(text(ACCEPTED), shape)
            for job in jobs:
                start = perf_counter()
                (verdict,) = toolchain.check([job])
                rows.append(
                    {
                        "text": job.name,
                        "checker": job.checker,
                        "verdict": verdict.status,
                        "seconds": perf_counter() - start,
                    }
                )
    return rows


def _jobs(source: str, shape: str) -> list[Job]:
    targets = [registry.load(name) for name in registry.names()]
    names = [f"{target.name}:{profile.name}" for target in targets for profile in target.profiles]
    (material,) = burnish.compile(source, names).materials
    return [
        Job(checker, STAGES[file.stage], file.text, name=f"{shape}: {file.name}")
        for file in material.files
        if file.stage == "fragment"
        for checker in file.checkers
    ]

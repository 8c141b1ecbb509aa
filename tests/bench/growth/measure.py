"""The table of growth: each shape at doubling sizes, phase by phase, until it takes too long."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import log2
from pathlib import Path

from ..checkout import Checkout
from ..table import Row, Section
from . import declarations, graphs, mistakes, texts
from .shape import MAIN, SHAPES, Shape

__all__ = ["measure", "select"]

_DECLARING = (graphs, declarations, texts, mistakes)
"""Importing these fills ``SHAPES``."""

PHASES = ("parse", "semantics", "passes", "emission", "reflection", "messages")
LIMIT = 4.0
"""The CPU seconds of a compile after which a shape is not taken any further."""
PATIENCE = 8.0
"""CPU seconds after which a compile is ended."""
LEAST = 0.02
"""CPU seconds below which a phase says nothing about growth: it may all be fixed cost."""


@dataclass(frozen=True, slots=True)
class Point:
    """The time and memory of a compile of one size."""

    size: int
    seconds: dict[str, float]
    """The times by phase, and ``all`` together."""
    megabytes: float


@dataclass(frozen=True, slots=True)
class Curve:
    """A shape as far as it could be taken."""

    shape: Shape
    points: tuple[Point, ...]
    end: str
    """The end of the curve: ``compiles``, ``reported``, or the reason why it went no further."""

    def exponent(self, phase: str) -> float | None:
        """The power of the size with which a phase grows at the end of the curve.

        ``None`` where too little was measured, or too little time was spent to say.
        """
        if len(self.points) < 2:
            return None
        last = self.points[-1]
        before = self.points[-3] if len(self.points) > 2 else self.points[-2]
        after, earlier = last.seconds.get(phase, 0.0), before.seconds.get(phase, 0.0)
        if after < LEAST or earlier <= 0:
            return None
        return log2(after / earlier) / log2(last.size / before.size)

    def row(self) -> Row:
        """The curve as a row of the table."""
        last = self.points[-1] if self.points else None
        seconds = last.seconds.get("all") if last else None
        return {
            "shape": self.shape.name,
            "size": last.size if last else None,
            "s": seconds,
            "MB": round(last.megabytes) if last else None,
            "all": self.exponent("all"),
            **{phase: self.exponent(phase) for phase in PHASES},
            "end": self.end,
        }


def select(wanted: Sequence[str]) -> list[Shape]:
    """The shapes whose names contain one of the given texts; all where none is given."""
    return [
        each for each in SHAPES.values() if not wanted or any(text in each.name for text in wanted)
    ]


def measure(shapes: Sequence[Shape], checkouts: Sequence[Checkout]) -> Iterator[Section]:
    """A table for each checkout, one shape after the other in turn, so that both are alike busy."""
    rows: dict[str, list[Row]] = {checkout.name: [] for checkout in checkouts}
    for shape in shapes:
        for checkout in checkouts:
            curve = _curve(shape, checkout)
            rows[checkout.name].append(curve.row())
            print(f"{shape.name}, {checkout.name}: {curve.end}", file=sys.stderr, flush=True)
    for checkout in checkouts:
        title = f"Exponents of growth (1 is linear) and time of the largest size, {checkout.name}"
        yield Section(f"growth {checkout.name}".strip(), title, rows[checkout.name])


def _curve(shape: Shape, checkout: Checkout) -> Curve:
    """Compile a shape at its sizes until it takes too long, or is refused."""
    points: list[Point] = []
    expected = [shape.says] if shape.says else []
    with tempfile.TemporaryDirectory() as name, checkout.worker() as worker:
        for size in shape.sizes():
            path = _written(Path(name), shape, size)
            answer = worker.compile(path, limit=PATIENCE)
            if answer is None:
                return Curve(shape, tuple(points), f"over {PATIENCE:g} s at {size}")
            if "failed" in answer:
                return Curve(shape, tuple(points), f"{answer['failed']} at {size}")
            if answer["codes"] != expected:
                codes = ", ".join(answer["codes"]) or "nothing"
                return Curve(shape, tuple(points), f"refused by {codes} at {size}")
            points.append(Point(size, answer["seconds"], answer["megabytes"]))
            if answer["seconds"]["all"] > LIMIT:
                return Curve(shape, tuple(points), f"over {LIMIT:g} s at {size}")
    return Curve(shape, tuple(points), f"says {shape.says}" if shape.says else "compiles")


def _written(folder: Path, shape: Shape, size: int) -> Path:
    for name, text in shape.files(size).items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder / MAIN

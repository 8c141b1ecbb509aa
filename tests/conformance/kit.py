"""Draws small programs with every route and the reference, for tests that know the picture."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

import burnish
from burnish.api.entry_points import CompiledMaterial
from burnish.compiler.diagnostics.source import Span
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.closing import Closing
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import Request, compile_all, compile_one
from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.drivers.frame_job import FrameDraw, FrameJob
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.frames.states import draw_states, outcomes
from burnish.targets.runner.reference import expected
from burnish.targets.runner.routes import ROUTES, Route
from burnish.targets.runner.runner import Runner
from burnish.targets.runner.scene_state import CLEAR, SceneState
from burnish.targets.toolchain import Toolchain

Floats = NDArray[np.float64]
Key = TypeVar("Key", bound=Hashable)
Found = TypeVar("Found")

FOLDER = Path(__file__).parent
REFERENCE = "reference"
PROFILES = tuple(sorted({route.profile for route in ROUTES.values()}))


@dataclass(frozen=True, slots=True)
class HandWritten:
    """A text with one stage or several that Burnish has not written, as compilers of routes take
    it."""

    name: str
    target: str
    profile: str
    entry_points: Mapping[str, str]
    text: str
    spans: Mapping[int, Span] = field(default_factory=dict)


class Studio(Closing):
    """Draws with worker processes that all tests share."""

    def __init__(self) -> None:
        self.runner = Runner(ROUTES.values())
        self.toolchain = Toolchain()

    def close(self) -> None:
        """End all workers."""
        self.runner.close()
        self.toolchain.close()

    def prepare(self, *materials: CompiledMaterial) -> None:
        """Compile the texts of many materials for all routes in parallel; the results are
        cached."""
        by_compiler = {route.compiler: route for route in ROUTES.values() if route.compiler}
        requests = [
            Request(route, material.files)
            for material in materials
            for route in by_compiler.values()
        ]
        compile_all(requests, self.toolchain)

    def pictures(
        self, route: Route, job: FrameJob, states: Sequence[SceneState]
    ) -> list[tuple[Floats, ...]]:
        """The pictures of a job that ``states_job`` has made, or one made of such a job."""
        found = self.runner.draw_frame(route, job)
        return [each.pictures for each in outcomes(job, found, states)]

    def draw(self, where: str, material: CompiledMaterial, state: SceneState) -> tuple[Floats, ...]:
        """The targets that a route or the reference draws, each of shape (height, width, 4).

        Targets are float32 and have exactly what the shader writes. If a route lacks a tool, the
        test fails: ``make test`` installs them all.
        """
        if where == REFERENCE:
            rules = RasterRules(state.width, state.height)
            return expected(material.shader, state, rules).targets
        route = ROUTES[where]
        problem = self.runner.problem(route)
        assert problem is None, f"{where} cannot be drawn: {problem}"
        exact = Exact.of(material)
        codes = compile_one(route, material.files, self.toolchain)
        made = pipeline(exact.reflection, route, codes)
        (found,) = draw_states(exact, [state], route, made, self.runner)
        return found.pictures

    def judged(self, route: str, name: str, subject: CompiledMaterial) -> Row:
        """The row of ``conform`` for a material or a kernel."""
        (row,) = conform([(name, subject)], [ROUTES[route]], self.runner, self.toolchain)
        return row


def compiled(source: str | Path, **options: Any) -> CompiledMaterial:
    """The only material of a text, or of a file of this folder, compiled for all routes."""
    where = FOLDER / source if isinstance(source, str) and source.endswith(".burnish") else source
    (material,) = burnish.compile(where, PROFILES, **options).materials
    return material


def redrawn(job: FrameJob, change: Callable[[Draw], Draw]) -> FrameJob:
    """A job that draws something else."""
    return replace(
        job,
        steps=tuple(
            replace(step, draws=tuple(_redrawn(drawn, change) for drawn in step.draws))
            for step in job.steps
        ),
    )


def _redrawn(drawn: FrameDraw, change: Callable[[Draw], Draw]) -> FrameDraw:
    return drawn if drawn.draw is None else replace(drawn, draw=change(drawn.draw))


def assert_one_picture(found: Floats, expected: Floats) -> None:
    """Two pictures are the same to the bit, and show something."""
    assert (found == expected).all()
    covered = (expected != np.array(CLEAR, np.float32)).any(axis=-1)
    assert covered.sum() > 100
    assert len(np.unique(expected[covered], axis=0)) > 5


@lru_cache(maxsize=1)
def all_of(file: Path) -> burnish.CompileResult:
    """All of a file, each of it compiled for those of the routes' profiles that have what it
    needs."""
    return burnish.compile(file, PROFILES, partial=True)


def keeping_the_last(find: Callable[[Key], Found]) -> Callable[[Key], Found]:
    """``find``, which keeps what it has found last, for tests that all ask for the same.

    It forgets that before it finds something else: the pictures of a material take a hundred
    megabytes, and those of all would fill gigabytes.
    """
    kept: dict[Key, Found] = {}

    def found(key: Key) -> Found:
        if key not in kept:
            kept.clear()
            kept[key] = find(key)
        return kept[key]

    return found

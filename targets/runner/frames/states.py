"""Draws a single shader in several states: each is a frame of one step, and all are one job.

``conform`` and tests draw materials and run kernels by it. States with targets of one size, and
with the same clear values and blend constant, share their targets. But each run of a kernel that
writes images has images of its own, which start black: so texels that it leaves out are the same
in each run, whatever was drawn before.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ....support.frozen import changed
from ..drivers.frame_job import Found, FrameJob
from ..drivers.pipeline import Pipeline
from ..kernels import pictures_of
from ..routes import Route
from ..runner import Runner
from ..scene_state import CLEAR, SceneState
from ..subject import Subject
from .by_route import Floats, HostSteps, upright
from .host import FrameHost
from .job_resources import JobParts
from .scenery import Scenery
from .single_plan import single_plan
from .step_draws import StepDraws
from .subjects import SingleFrame


@dataclass(frozen=True, eq=False, slots=True)
class Outcome:
    """Everything that a shader leaves in one state."""

    pictures: tuple[Floats, ...]
    """The render targets, or the images that a kernel writes, each of shape (height, width, 4); one
    layer is below the other."""
    elements: Mapping[str, bytes]
    """The elements of each buffer that a kernel writes, by name."""


def draw_states(
    subject: Subject,
    states: Sequence[SceneState],
    route: Route,
    bound: Pipeline,
    runner: Runner,
    *,
    keep: bool = True,
) -> list[Outcome]:
    """Everything that a material or a kernel leaves in each state, by its pipeline on a route.

    ``keep`` is that of ``draw_frame``. Raises ``DriverError``, ``PlanError``, and ``BudgetError``
    for jobs that are too large.
    """
    job = states_job(subject, states, bound)
    return list(outcomes(job, runner.draw_frame(route, job, keep=keep), states))


def states_job(subject: Subject, states: Sequence[SceneState], bound: Pipeline) -> FrameJob:
    """The job that draws a material, or runs a kernel, in each state, and reads back everything
    that it leaves."""
    parts = JobParts((bound,))
    stages: dict[object, _Stage] = {}
    for number, state in enumerate(states):
        run = number if bound.images else None
        settings = state.width, state.height, state.clear, state.blend_constant, run
        if settings not in stages:
            stages[settings] = _Stage.of(subject, state, parts)
        first = len(parts.steps)
        stages[settings].add(state)
        named = (replace(step, name=f"draw {number}") for step in parts.steps[first:])
        parts.steps[first:] = named
    return parts.whole()


def outcomes(job: FrameJob, found: Found, states: Sequence[SceneState]) -> Iterator[Outcome]:
    """The results of a job that ``states_job`` has made for these states."""
    pictures, buffers = upright(job, found), iter(found.buffers)
    for state in states:
        reflection, counts = state.instance.reflection, state.instance.result_counts()
        yield Outcome(
            tuple(np.concatenate(next(pictures)) for _ in pictures_of(reflection)),
            {
                row.name: next(buffers)[: counts[row.name] * row.stride]
                for row in reflection.results
            },
        )


@dataclass(slots=True)
class _Stage:
    """A host with targets of one size, with one set of clear values, and one blend constant."""

    draws: StepDraws
    steps: HostSteps
    outputs: Sequence[str]
    drawn: int = 0
    """The number of states so far, each of which is a frame."""

    @classmethod
    def of(cls, subject: Subject, state: SceneState, parts: JobParts) -> _Stage:
        """The host for states like this one."""
        reflection = subject.reflection
        rows = zip(reflection.targets, state.clear, strict=True)
        cleared = changed(
            reflection, targets=tuple(changed(row, clear=clear) for row, clear in rows)
        )
        plan = single_plan(cleared, CLEAR, state.blend_constant)
        frame = SingleFrame(subject.name, plan, (subject,))
        # A kernel says itself how much it writes.
        size = (1, 1) if reflection.extent is not None else (state.width, state.height)
        host = FrameHost(frame, Scenery(()), size)
        draws = StepDraws(host)
        steps = HostSteps(host, draws, parts, writes_to_black=True)
        return cls(draws, steps, [row.name for row in plan.outputs])

    def add(self, state: SceneState) -> None:
        """Draw a state, and read everything back."""
        self.draws.given = state
        self.steps.add_frame(self.drawn)
        self.steps.add_reading(self.outputs)
        self.drawn += 1

"""The jobs that are made of plans: what is counted before them, and how their steps are called."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.targets.runner.codes import Codes
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.pipeline import Code
from burnish.targets.runner.frames.by_route import frame_job
from burnish.targets.runner.frames.counting import bytes_of_blocks
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.runner.routes import ROUTES

from .kit import FOLDER

ROUTE = ROUTES["lavapipe:glsl"]

NAMES = ("shadows", "cascades", "light_by_light", "ripples")
"""Frames that draw models, layers, light by light, and that run kernels."""


ALL = pytest.mark.parametrize("path", [FOLDER / f"{name}.burnish" for name in NAMES], ids=NAMES)


def made(path: Path) -> tuple[FrameHost, FrameJob]:
    """The host of a frame, and its job, with texts that nobody reads."""
    (frame,) = burnish.compile(path, (ROUTE.profile,)).frames
    tags = {row.name: row.materials for row in frame.plan.models}
    materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
    host = FrameHost(frame, in_a_row(materials, tags, "cube"), (8, 8))
    codes = [
        Codes({stage: Code(name) for file in shader.files for stage, name in
               file.entry_points.items()})
        for shader in frame.shaders
    ]  # fmt: skip
    names = [row.name for row in frame.plan.outputs if row.texture is not None]
    return host, frame_job(host, ROUTE, codes, names, 1)


@ALL
def test_blocks_are_counted_as_they_are_sent(path: Path) -> None:
    host, job = made(path)
    sent = sum(
        len(block) for step in job.steps for draw in step.draws for block in draw.values.blocks
    )
    assert 0 < sent <= bytes_of_blocks(host) <= 2 * sent


@ALL
def test_errors_name_the_steps_of_the_plan(path: Path) -> None:
    host, job = made(path)
    plan = host.plan
    known = {f"{plan.frame}, {step.name}" for step in plan.steps}
    known |= {f"{plan.frame}, the end", f"the outputs of {plan.frame}"}
    assert {job.called(number) for number in range(len(job.steps))} <= known

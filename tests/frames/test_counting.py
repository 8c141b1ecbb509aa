"""The memory of a frame is counted before it is drawn: no less than a job then has."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.targets.runner.codes import Codes
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


@pytest.mark.parametrize("path", [FOLDER / f"{name}.burnish" for name in NAMES], ids=NAMES)
def test_blocks_are_counted_as_they_are_sent(path: Path) -> None:
    (frame,) = burnish.compile(path, (ROUTE.profile,)).frames
    tags = {row.name: row.materials for row in frame.plan.models}
    materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
    host = FrameHost(frame, in_a_row(materials, tags, "cube"), (8, 8))
    codes = [
        Codes({stage: Code(name) for file in shader.files for stage, name in
               file.entry_points.items()})
        for shader in frame.shaders
    ]  # fmt: skip
    job = frame_job(host, ROUTE, codes, [], 1)
    sent = sum(
        len(block) for step in job.steps for draw in step.draws for block in draw.values.blocks
    )
    assert 0 < sent <= bytes_of_blocks(host) <= 2 * sent

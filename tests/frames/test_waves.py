"""The waves of an example beside the same steps with NumPy."""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.targets.runner.frames.by_reference import ReferenceFrames
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row

from .kit import FOLDER
from .tracing import Floats

GRID = 96
DAMPING = 0.004
FRAMES = 4
APART = 3
STRENGTH = 0.3

SHOWING_HEIGHTS = """
frame Heights : Ripples {
    output heights = waves.heights
}
"""


def step(height: Floats, speed: Floats, push: Floats) -> tuple[Floats, Floats]:
    """A step of the wave equation; what is beyond the sides is as high as they are."""
    wide = np.pad(height, 1, mode="edge")
    beside = (wide[1:-1, 2:] + wide[1:-1, :-2] + wide[2:, 1:-1] + wide[:-2, 1:-1]) / 4
    faster = (1 - DAMPING) * (speed + 1.5 * (beside - height)) - push
    return height + faster, faster


def test_waves_run_as_by_numpy() -> None:
    text = (FOLDER / "ripples.burnish").read_text("utf-8") + SHOWING_HEIGHTS
    compiled = burnish.compile(text, ("wgsl",), material="Heights", search_path=[FOLDER])
    (frame,) = compiled.frames
    tags = {row.name: row.materials for row in frame.plan.models}
    host = FrameHost(frame, in_a_row(tags["scene"], tags, "sphere"), (8, 8))
    host.set_text("apart", str(APART))
    row, column = np.mgrid[:GRID, :GRID].astype(float)
    height, speed, still = np.zeros((GRID, GRID)), np.zeros((GRID, GRID)), np.zeros((GRID, GRID))
    for x, y in ((52, 70), (22, 58), (78, 44)):
        away = np.hypot(column - x, row - y)
        height -= 0.12 * np.cos(0.7 * away) * np.exp(-0.01 * away**2)
    frames = ReferenceFrames(host)
    for number in range(FRAMES):
        frames.draw()
        push = still
        if number and number % APART == 0:
            turn = number // APART
            fallen = (np.array([0.4, 0.2]) + turn * np.array([0.754878, 0.569840])) % 1
            x, y = GRID * (0.25 + 0.5 * fallen)
            push = STRENGTH * np.exp(-((np.hypot(column - x, row - y) / 2.5) ** 2))
        height, speed = step(*step(height, speed, push), still)
        found = frames.output("heights").levels[0][0, 0]
        assert found[..., 0] == pytest.approx(height, abs=1e-5)
        assert found[..., 1] == pytest.approx(speed, abs=1e-5)

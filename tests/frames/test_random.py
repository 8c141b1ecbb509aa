"""Random frames are planned so that the checks of plans agree, with shared textures and without."""

from __future__ import annotations

import burnish
from burnish.targets.runner.frames.checking import check_plan

from .random_frames import random_frame

COUNT = 60


def test_random_frames_are_planned_without_contradictions() -> None:
    planned = 0
    for seed in range(COUNT):
        try:
            (frame,) = burnish.compile(random_frame(seed), ("wgsl",)).frames
        except burnish.CompileError:
            continue
        reflections = [shader.reflection for shader in frame.shaders]
        check_plan(frame.plan, reflections)
        check_plan(frame.plan_of_reference, reflections)
        planned += 1
    assert planned > COUNT / 2

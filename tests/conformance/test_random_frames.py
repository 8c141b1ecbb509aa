"""Random frames, three in a row, by drivers and by the reference, which shares no textures."""

from __future__ import annotations

import pytest

import burnish
from burnish.targets.conformance import judged_frames
from burnish.targets.conformance.frames import FrameTrial
from burnish.targets.runner.routes import ROUTES

from ..frames.random_frames import random_frame
from .kit import Studio

COUNT = 8
SIZE = (8, 8)


@pytest.mark.parametrize("name", ["lavapipe:glsl", "llvmpipe:gl450"])
def test_random_frames_agree(studio: Studio, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(judged_frames, "SEVERAL", 3)
    route, drawn = ROUTES[name], 0
    for seed in range(COUNT):
        try:
            (frame,) = burnish.compile(random_frame(seed), (route.profile,)).frames
        except burnish.CompileError:
            continue
        made, device = FrameTrial(f"{seed}", frame, SIZE), studio.runner.device(route)
        for result in made.results(route, device, studio.runner, studio.toolchain):
            assert not result.comparison.wrong, f"{seed}: {result.case}"
            drawn += 1
    assert drawn >= COUNT

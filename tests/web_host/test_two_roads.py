"""Frames in a browser, of which the host executes the plan, or Python does with frame jobs.

Both end with the same renderers, so their pictures are equal to the last bit, if the host in
JavaScript and the one in Python understand plans alike.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import burnish
from burnish.targets.conformance.judged_frames import host_of
from burnish.targets.runner.frames import by_route
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain
from burnish.targets.web_host.drawing import draw_frames

from ..frames.kit import FOLDER

pytestmark = pytest.mark.xdist_group("two roads")  # One process starts the drivers, for all tests.

NAMES = ("chromium:webgpu", "chromium:webgl2")
SIZE = (24, 20)
FRAMES = 2


@pytest.fixture(scope="module")
def runner() -> Iterator[Runner]:
    with Runner([ROUTES[name] for name in NAMES], reuse=False) as opened:
        yield opened


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    "example", ["reaction", "light_by_light", "shadow_volumes", "smooth_edges"]
)
def test_pictures_are_the_same(runner: Runner, example: str, name: str) -> None:
    """The examples keep results, draw for each light, use stencil values, and several samples."""
    route = ROUTES[name]
    (frame,) = burnish.compile(FOLDER / f"{example}.burnish", (route.profile,)).frames
    with Toolchain() as toolchain:
        of_package, of_job = (
            draw(host_of(frame, SIZE), route, runner, toolchain, FRAMES)
            for draw in (draw_frames, by_route.draw_frames)
        )
    for found, wanted in zip(of_package, of_job, strict=True):
        assert found.keys() == wanted.keys()
        for output, texels in found.items():
            assert np.ptp(texels) > 0
            assert np.array_equal(texels, wanted[output], equal_nan=True), output

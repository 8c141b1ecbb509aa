"""Every example of a frame against the reference, each by one of the routes that draw frames."""

from __future__ import annotations

import zlib
from pathlib import Path

import pytest

import burnish
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import EVERY_DRIVER, ROUTES, Route

from ..frames.kit import EXAMPLES
from .kit import PROFILES, Studio

FRAME_ROUTES = [route for route in ROUTES.values() if EVERY_DRIVER[route.driver].draws_frames]
LEAST_COVERED = 0.1
"""Of the pixels of an output."""

PROVE_LITTLE = frozenset((("light_map", "webgl2"),))
"""Examples and drivers that tell so little of how they round that many pixels are open."""
ON_SWIFTSHADER = frozenset(("swiftshader", "webgpu", "webgl2"))
"""Drivers that draw by SwiftShader."""
DIFFERING = frozenset(("image_based",))
"""Examples with triangles that reach behind the eye, and that show it. SwiftShader interpolates
across what it has clipped of these with large errors: it was seen to find x = -0.755 for 0.826,
where Mesa is right to six digits."""


def chosen(path: Path, lacking: frozenset[str]) -> Route:
    """A route that can draw an example: the same one, whichever other examples there are."""
    left_out = ON_SWIFTSHADER if path.stem in DIFFERING else frozenset()
    able = [
        route
        for route in FRAME_ROUTES
        if route.profile not in lacking and route.driver not in left_out
    ]
    return able[zlib.crc32(path.stem.encode()) % len(able)]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_it_agrees(studio: Studio, path: Path) -> None:
    (frame,) = burnish.compile(path, PROFILES, partial=True).frames
    lacking = frozenset(profile for shader in frame.shaders for profile in shader.lacking)
    route = chosen(path, lacking)
    (row,) = conform([(path.stem, frame)], [route], studio.runner, studio.toolchain)
    if (path.stem, route.driver) in PROVE_LITTLE:
        assert row.status in {"agrees", "proves little"}, "\n".join([row.status, *details(row)])
        return
    assert row.status == "agrees", "\n".join([route.name, row.status, *details(row)])
    assert row.covered > LEAST_COVERED * sum(r.comparison.pixels for r in row.results)

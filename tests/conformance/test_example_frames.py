"""Every example of a frame against the reference, on some of the routes that draw frames: each
example by two of them, and all of them in turn."""

from __future__ import annotations

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


def in_turn(path: Path, lacking: frozenset[str]) -> list[Route]:
    """Two routes that can draw an example, from different halves of all."""
    able = [route for route in FRAME_ROUTES if route.profile not in lacking]
    first, half = EXAMPLES.index(path), len(able) // 2
    return [able[(first + start) % len(able)] for start in (0, half)]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_it_agrees(studio: Studio, path: Path) -> None:
    (frame,) = burnish.compile(path, PROFILES, partial=True).frames
    lacking = frozenset(profile for shader in frame.shaders for profile in shader.lacking)
    routes = in_turn(path, lacking)
    for row in conform([(path.stem, frame)], routes, studio.runner, studio.toolchain):
        assert row.status == "agrees", "\n".join(details(row)) or row.status
        assert row.covered > LEAST_COVERED * sum(r.comparison.pixels for r in row.results)

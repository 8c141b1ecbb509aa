"""Random materials that read textures agree, on a route of each driver of Vulkan.

``BURNISH_READS`` says how many materials there are: ``BURNISH_READS=500 make test`` takes hours.
"""

from __future__ import annotations

import os

import pytest

import burnish
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES

from .kit import Studio
from .reads import Reads

COUNT = int(os.environ.get("BURNISH_READS", "3"))


@pytest.mark.parametrize("route", ["lavapipe:glsl", "swiftshader:wgsl-naga"])
@pytest.mark.parametrize("seed", range(COUNT))
def test_they_agree(studio: Studio, seed: int, route: str) -> None:
    text = Reads(seed).text()
    (material,) = burnish.compile(text, ROUTES[route].profile, pass_="Read").materials
    rows = conform(
        [("reads", material)], [ROUTES[route]], studio.runner, studio.toolchain, seed=seed
    )
    assert rows[0].status == "agrees", "\n".join([text, rows[0].status, *details(rows[0])])

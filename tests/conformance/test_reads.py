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

DECIDED = 0.75
"""The share of a picture that has to be decided.

Single texels and comparisons have so many borders that a picture of nothing else may well be more
undecided than a material's should be.
"""


@pytest.mark.parametrize("route", ["lavapipe:glsl", "swiftshader:wgsl-naga"])
@pytest.mark.parametrize("seed", range(COUNT))
def test_they_agree(studio: Studio, seed: int, route: str) -> None:
    text = Reads(seed).text()
    (material,) = burnish.compile(text, ROUTES[route].profile, pass_="Read").materials
    (row,) = conform(
        [("reads", material)], [ROUTES[route]], studio.runner, studio.toolchain, seed=seed
    )
    told = "\n".join([text, row.status, *details(row)])
    assert row.status in ("agrees", "proves little"), told
    comparisons = [result.comparison for result in row.results]
    proven, covered = (sum(getattr(c, name) for c in comparisons) for name in ("proven", "covered"))
    assert proven > DECIDED * covered, told

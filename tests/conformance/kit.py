"""Draws small programs on every route and by the reference, for pictures that are known by hand."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import burnish
from burnish.api import CompiledMaterial
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.closing import Closing
from burnish.targets.runner.codes import Request, compile_all, compile_one
from burnish.targets.runner.drivers.draw import Cull, Job
from burnish.targets.runner.drivers.readback import arrays
from burnish.targets.runner.pipeline import pipeline
from burnish.targets.runner.reference import expected
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import Runner
from burnish.targets.runner.shots import Shot
from burnish.targets.toolchain import Toolchain

Floats = NDArray[np.float64]

FOLDER = Path(__file__).parent
REFERENCE = "reference"
PROFILES = tuple(sorted({route.profile for route in ROUTES.values()}))


class Studio(Closing):
    """Draws, with workers that all tests share."""

    def __init__(self) -> None:
        self.runner = Runner(ROUTES.values())
        self.toolchain = Toolchain()

    def close(self) -> None:
        """Ends all workers."""
        self.runner.close()
        self.toolchain.close()

    def prepare(self, *materials: CompiledMaterial) -> None:
        """Has the routes' compilers work on many texts at the same time; what they make is kept."""
        by_compiler = {route.compiler: route for route in ROUTES.values() if route.compiler}
        requests = [
            Request(route, material.files)
            for material in materials
            for route in by_compiler.values()
        ]
        compile_all(requests, self.toolchain)

    def draw(
        self, where: str, material: CompiledMaterial, shot: Shot, cull: Cull = "none"
    ) -> tuple[Floats, ...]:
        """Each target, (height, width, 4), as a route or the reference draws it.

        Targets keep what the shader writes. A route that lacks a tool is a failure: ``make test``
        installs them all.
        """
        if where == REFERENCE:
            rules = RasterRules(shot.width, shot.height, cull=cull)
            return expected(material.shader, shot, rules).targets
        route = ROUTES[where]
        problem = self.runner.problem(route)
        assert problem is None, f"{where} cannot be drawn: {problem}"
        codes = compile_one(route, material.files, self.toolchain)
        made = pipeline(material.reflection, route, codes, exact=True, cull=cull)
        (picture,) = self.runner.draw(route, Job(made, (shot.draw(),)))
        return arrays(picture)


def compiled(source: str | Path, **options: Any) -> CompiledMaterial:
    """The only material of a text, or of a file of this folder, for the profiles of all routes."""
    where = FOLDER / source if isinstance(source, str) and source.endswith(".burnish") else source
    (material,) = burnish.compile(where, PROFILES, **options).materials
    return material

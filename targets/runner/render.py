"""Shots as arrays of what their targets hold, by the reference or by a route."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...compiler.reference.picture import RasterRules
from ..toolchain import Toolchain
from .codes import compile_one
from .drivers.draw import Job
from .drivers.readback import arrays
from .pipeline import pipeline
from .reference import Progress, expected
from .routes import Route
from .runner import Runner
from .shots import Shot
from .subject import Subject

Floats = NDArray[np.float64]


def by_reference(
    subject: Subject, shot: Shot, progress: Progress | None = None
) -> tuple[Floats, ...]:
    """Each target, (height, width, 4), not rounded to its format."""
    return expected(subject.shader, shot, RasterRules(shot.width, shot.height), progress).targets


def by_route(
    subject: Subject, shot: Shot, route: Route, runner: Runner, toolchain: Toolchain
) -> tuple[Floats, ...]:
    """Each target, (height, width, 4); not rounded to its format unless the pass blends.

    Raises ``CodeError`` if the route's compiler refuses the texts, and ``DriverError``.
    """
    codes = compile_one(route, subject.files, toolchain)
    blends = any(row["blend"] != "none" for row in subject.reflection["targets"])
    shader_pipeline = pipeline(subject.reflection, route, codes, exact=not blends)
    (picture,) = runner.draw(route, Job(shader_pipeline, (shot.draw(),)))
    return arrays(picture)

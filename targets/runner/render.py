"""Draws one picture with the reference or with a route; ``burnish render`` calls it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...compiler.promises import promises
from ...compiler.reference.picture import RasterRules
from ..toolchain import Toolchain
from .binding import pipeline, shows_less
from .codes import compile_one
from .drivers.readback import arrays
from .job_sizes import check_work
from .kernels import drawable, pictures_of
from .reference import Progress, expected
from .routes import Route
from .runner import Runner
from .scene_state import SceneState
from .subject import Subject

Floats = NDArray[np.float64]


def by_reference(
    subject: Subject, state: SceneState, progress: Progress | None = None
) -> tuple[tuple[Floats, ...], tuple[str, ...]]:
    """The reference's targets, each of shape (height, width, 4), not rounded to their formats.

    The second result are the values that are zero somewhere although they were promised not to be.
    """
    rules = RasterRules(state.width, state.height)
    drawn = expected(drawable(subject.shader), state, rules, progress=progress)
    kept = promises(subject.shader)
    return drawn.targets, tuple(one.value for one in kept if one.node.id in drawn.broken)


def by_route(
    subject: Subject, state: SceneState, route: Route, runner: Runner, toolchain: Toolchain
) -> tuple[Floats, ...]:
    """A route's targets, each of shape (height, width, 4).

    They are rounded to their formats only if the pass blends, or has several samples for each
    pixel. Raises ``CodeError`` if the route's compiler refuses the texts, ``DriverError``, and
    ``BudgetError`` for a picture that is too large, or would take too long.
    """
    check_work(subject.shader)
    codes = compile_one(route, subject.files, toolchain)
    exact = not shows_less(subject.reflection)
    shader_pipeline = pipeline(subject.reflection, route, codes, exact=exact)
    draws = (state.draw(),)
    (picture,) = pictures_of(route, runner, subject.reflection, shader_pipeline, draws)
    return arrays(picture)

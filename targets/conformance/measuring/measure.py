"""Measures the device of a route: draws all probes, and derives its precision from the pictures.

``burnish conform --measure`` calls it, for one route of each driver.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ...runner.binding import pipeline
from ...runner.codes import compile_one
from ...runner.frames.states import draw_states
from ...runner.routes import Route
from ...runner.runner import Runner
from ...runner.scene_state import SceneState
from ...runner.subject import Subject
from ...toolchain import Toolchain
from ..drivers import Hardware
from .derivation import MeasuringError, Pictures, derived
from .probes import PROBES, Probe

Draw = Callable[[Subject, Sequence[SceneState]], Sequence[Pictures]]
"""Draws a material in several states."""
Compile = Callable[[Probe, str], Subject]
"""Compiles the material of a probe for a profile; callers know the compiler, this package does
not."""


def measured(
    route: Route, assumed: Hardware, compiled: Compile, runner: Runner, toolchain: Toolchain
) -> Hardware:
    """The precision of the device that a route draws with; what cannot be measured is as assumed.

    Raises ``CodeError``, ``DriverError`` and ``MeasuringError``.
    """

    if runner.device(route).subpixel_bits < 1:
        raise MeasuringError(
            "it reports 0 bits for the places of vertices, so no picture of it can be compared"
        )

    def draw(material: Subject, states: Sequence[SceneState]) -> Sequence[Pictures]:
        codes = compile_one(route, material.files, toolchain)
        bound = pipeline(material.reflection, route, codes)
        # A device is asked again each time: only so a driver that has changed is noticed.
        outcomes = draw_states(material, states, route, bound, runner, keep=False)
        return [outcome.pictures for outcome in outcomes]

    subjects = [compiled(probe, route.profile) for probe in PROBES]
    return measured_by(draw, subjects, assumed, bottom_up=route.bottom_up)


def measured_by(
    draw: Draw, subjects: Sequence[Subject], assumed: Hardware, *, bottom_up: bool
) -> Hardware:
    """The precision of a device that draws the probes so; ``subjects`` are their materials."""
    found = {}
    for probe, material in zip(PROBES, subjects, strict=True):
        pictures = draw(material, probe.states(material))
        if not all(np.isfinite(target).all() for each in pictures for target in each):
            raise MeasuringError(f"it drew what is not a number for the probe `{probe.material}`")
        found[probe.material] = pictures
    return derived(found, assumed, bottom_up=bottom_up)

"""Shaders read the values that a host writes: value for value, on every route.

Nothing but the values that were set says what has to come out, and it has to be exactly that.
"""

from __future__ import annotations

import secrets
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest

from burnish.api.entry_points import CompiledMaterial
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import SceneState, set_up

from .declarations import Unit
from .kit import REFERENCE, Floats, Studio, compiled
from .layouts import PASS, Layout, every_element, every_neighbour, every_type, random_layout

pytestmark = pytest.mark.xdist_group("layout")  # One process makes the programs, for all tests.

SEEDS = range(24)
FRESH = secrets.randbelow(2**32)
"""A seed that no run had before; a failure tells it."""
SMALL = 8
"""Pixels of a program from a fresh seed: lavapipe 22.3.6 crashes on one in 200 of those that are
three times as large, where it makes constants of uniforms."""


@dataclass(frozen=True, eq=False, slots=True)
class Program:
    """A layout, compiled and ready to be drawn."""

    layout: Layout
    material: CompiledMaterial
    state: SceneState


def program_of(layout: Layout, *, hoist: bool) -> Program:
    """With ``hoist``, what shaders have of some values is what the host derives from them."""
    material = compiled(layout.text, pass_=PASS, hoist=hoist)
    state = set_up(material.instance(), plane(1), Scene(), (len(layout.units), 1))
    for parameter, value in layout.values.items():
        state.instance.set(parameter, value)
    return Program(layout, material, state)


@pytest.fixture(scope="module")
def programs(studio: Studio) -> dict[str, Program]:
    """Programs by name, which the routes' compilers have all seen."""
    made = {
        "every type, hoisted": program_of(every_type(), hoist=True),
        "every type": program_of(every_type(), hoist=False),
        "every element": program_of(every_element(), hoist=False),
        "every neighbour": program_of(every_neighbour(), hoist=False),
        **{f"seed {n}": program_of(random_layout(n), hoist=n % 2 == 0) for n in SEEDS},
    }
    studio.prepare(*(program.material for program in made.values()))
    return made


NAMES = [
    "every type, hoisted", "every type", "every element", "every neighbour",
    *(f"seed {n}" for n in SEEDS),
]  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("route", [REFERENCE, *ROUTES])
def test_layout(studio: Studio, programs: dict[str, Program], route: str, name: str) -> None:
    assert not differences(studio, route, programs[name])


@cache
def fresh_programs() -> list[Program]:
    return [
        program_of(random_layout(FRESH + i, SMALL), hoist=hoist)
        for i, hoist in enumerate((False, True, False))
    ]


@pytest.mark.parametrize("route", ROUTES)
def test_fresh_layouts(studio: Studio, route: str) -> None:
    for i, program in enumerate(fresh_programs()):
        assert not differences(studio, route, program), f"seed {FRESH + i}, of {SMALL} pixels"


def differences(studio: Studio, route: str, program: Program) -> list[str]:
    """A line for each pixel that does not show what was set."""
    (got,) = studio.draw(route, program.material, program.state)
    shown = zip(program.layout.units, got[0], strict=True)
    return [line for unit, pixel in shown for line in _difference(unit, pixel)]


def _difference(unit: Unit, pixel: Floats) -> Sequence[str]:
    wanted = np.zeros(4)
    wanted[: len(unit.lanes)] = np.array(unit.lanes, np.float32)
    if np.array_equal(pixel, wanted):
        return []
    return [f"{unit.name} is {pixel.tolist()} and not {wanted.tolist()}"]

"""Calls overloads of builtins on devices, with the operands of ``samples.py``.

``tests/conformance/test_builtins.py`` compares the results with the reference's bounds, and
``measure.py`` measures how far off they are.
"""

from __future__ import annotations

from functools import cache

import burnish
from burnish.api.entry_points import CompiledMaterial
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.frames.states import draw_states
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.routes import ROUTES, Route
from burnish.targets.runner.runner import Runner
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import set_up
from burnish.targets.runner.textures.texture import Texture
from burnish.targets.toolchain import Toolchain

from .overloads import Program
from .samples import SIDE, Floats, Integers, float_operands, integer_operands

PROFILES = tuple(sorted({route.profile for route in ROUTES.values()}))


@cache
def floats() -> list[Floats]:
    """The contents of the textures of floats."""
    return float_operands()


@cache
def integers() -> list[Integers]:
    """The contents of the textures of integers."""
    return integer_operands()


@cache
def textures() -> dict[str, Texture]:
    """The operands as textures with a single level."""
    of_floats = {
        f"f{number}": Texture("rgba32float", SIDE, SIDE, (array.astype("<f4").tobytes(),))
        for number, array in enumerate(floats())
    }
    return of_floats | {
        f"i{number}": Texture("rgba32sint", SIDE, SIDE, (array.astype("<i4").tobytes(),))
        for number, array in enumerate(integers())
    }


def compiled(program: Program) -> CompiledMaterial:
    """A program for all routes."""
    (material,) = burnish.compile(program.text, PROFILES, pass_="Returned").materials
    return material


def returned(
    material: CompiledMaterial, route: Route, runner: Runner, toolchain: Toolchain
) -> list[Floats]:
    """The values that a device returns for each lane of a program, as pictures."""
    instance = material.instance()
    wanted = {row.name for row in material.reflection.textures}
    for name, texture in textures().items():
        if name in wanted:
            instance.set(name, texture)
    state = set_up(instance, plane(1), Scene(), (SIDE, SIDE))
    codes = compile_one(route, material.files, toolchain)
    exact = Exact.of(material)
    made = pipeline(exact.reflection, route, codes)
    # The results of all programs are larger than the store, and would drive the pictures out of it.
    (outcome,) = draw_states(exact, [state], route, made, runner, keep=False)
    return [target[..., lane] for target in outcome.pictures for lane in range(4)]

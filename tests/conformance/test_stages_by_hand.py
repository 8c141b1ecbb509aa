"""Stages written by hand do what Burnish's do, with the blocks and buffers of Burnish's reflection.

The folder ``by_hand`` has a program, and GLSL of the same meaning that somebody might write who
knows only where the reflection says that everything is bound. Nothing on the way is rounded, so
that pictures and elements are the same to the last bit.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.ir.stages import STAGES
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.drivers.pipeline import Pipeline
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.frames.states import draw_states
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.kernels import elements_state
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import SceneState, set_up

from .kit import Floats, HandWritten, Studio

FOLDER = Path(__file__).with_name("by_hand")
ROUTE = ROUTES["lavapipe:glsl"]
SIZE = (96, 80)
CLEAR = (9.0, 9.0, 9.0, 9.0)
SEEN = {
    "view_projection": (0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, -0.125, 0, 0, 0, 0.5, 1),
    "object_to_world": (1, 0, 0, 0, -0.25, 1, 0, 0, 0, 0, 1, 0, -0.5, 0.25, 0, 1),
}
"""Matrices, column after column; the object is sheared and moved."""

Values = Mapping[str, Any]
DRAWN: Mapping[str, tuple[Values, ...]] = {
    "Copies": (
        {"copies": 3, "shift": (0.25, -0.125), "tints": [(1, 2, 3), (4, 0.5, 1), (0, 2, 5)]},
        {"copies": 4, "shift": (-0.5, 0.25), "tints": [(3, 1, 2), (0.25, 4, 1)]},
    ),
    "Bumps": (
        {"level": 4, "height": 0.5, "bumps": [1, -2, 3]},
        {"level": 2, "height": -1, "bumps": [0.5, 2]},
    ),
}
"""The materials that are drawn, each with some values."""
CASES = [(name, values) for name, each in DRAWN.items() for values in each]


@cache
def compiled(name: str) -> CompiledMaterial:
    """A material or kernel of Burnish's."""
    path = FOLDER / "subjects.burnish"
    return burnish.compile(path, ROUTE.profile, material=name, native_stages=True)[name]


def by_hand(studio: Studio, name: str, *, instead_of: str = "", given: str = "") -> Pipeline:
    """The pipeline of Burnish's reflection, with all stages by hand; ``given`` stands in a text
    instead of something else."""
    texts = {
        stage: (FOLDER / f"{name}.{STAGES[stage].suffix}.glsl").read_text(encoding="utf-8")
        for stage in ours(studio, name).stages
    }
    assert any(instead_of in text for text in texts.values())
    files = [
        HandWritten(name, "glsl", "vulkan", {stage: "main"}, text.replace(instead_of, given))
        for stage, text in texts.items()
    ]
    codes = compile_one(ROUTE, files, studio.toolchain)
    return replace(ours(studio, name), stages=codes.stages)


def ours(studio: Studio, name: str) -> Pipeline:
    """The pipeline with all stages by Burnish."""
    material = compiled(name)
    codes = compile_one(ROUTE, material.files, studio.toolchain)
    return pipeline(Exact.of(material).reflection, ROUTE, codes)


def drawn(studio: Studio, made: Pipeline, name: str, values: Values) -> Floats:
    """A pipeline's picture of a plane."""
    exact, states = Exact.of(compiled(name)), [state_of(name, values)]
    (outcome,) = draw_states(exact, states, ROUTE, made, studio.runner)
    return outcome.pictures[0]


def state_of(name: str, values: Values) -> SceneState:
    """A plane of quads whose corners lie at multiples of a half."""
    state = set_up(compiled(name).instance(), plane(4), Scene(), SIZE, CLEAR)
    for parameter, value in (SEEN | dict(values)).items():
        state.instance.set(parameter, value)
    return state


@pytest.mark.parametrize(("name", "values"), CASES)
def test_they_draw_the_same_picture(studio: Studio, name: str, values: Values) -> None:
    found = drawn(studio, ours(studio, name), name, values)
    expected = drawn(studio, by_hand(studio, name), name, values)
    assert (found == expected).all()
    covered = (expected != np.array(CLEAR)).any(axis=-1)
    assert covered.sum() > 1000
    assert len(np.unique(expected[covered], axis=0)) > 100


MISTAKES = {
    "the next tint": ("Copies", "tints[min(number,", "tints[min(number + 1,"),
    "another first primitive": ("Copies", "gl_PrimitiveIDIn + number", "gl_PrimitiveIDIn + 1"),
    "turned over": ("Copies", "gl_FrontFacing ? tint : -tint", "gl_FrontFacing ? -tint : tint"),
    "a finer edge": ("Bumps", "float[](level, level", "float[](level, level + 1.0"),
    "another bump": ("Bumps", "gl_PrimitiveID % 3", "0"),
    "patches the other way round": ("Bumps", "u * v, (1.0 - u) * v", "(1.0 - u) * v, u * v"),
}


@pytest.mark.parametrize(("name", "instead_of", "given"), MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_shows(studio: Studio, name: str, instead_of: str, given: str) -> None:
    values = DRAWN[name][0]
    wrong = by_hand(studio, name, instead_of=instead_of, given=given)
    right = drawn(studio, ours(studio, name), name, values)
    assert (drawn(studio, wrong, name, values) != right).any()


# --- kernels -------------------------------------------------------------------------------------

HEAT = np.random.default_rng(7).integers(0, 16, 150).astype(np.float32)
"""Neither a whole number of work groups nor of the elements that count."""


def computed(studio: Studio, made: Pipeline) -> dict[str, NDArray[Any]]:
    """A pipeline's results for ``HEAT``."""
    instance = Instance(compiled("Spreading").reflection)
    instance.set("heat", HEAT)
    states = [elements_state(instance)]
    (outcome,) = draw_states(compiled("Spreading"), states, ROUTE, made, studio.runner)
    found = outcome.elements
    return {
        "next": np.frombuffer(found["next"], "<f4"),
        "crossed": np.frombuffer(found["crossed"], "<i4"),
    }


def test_kernels_compute_the_same(studio: Studio) -> None:
    before = np.pad(HEAT, 1, mode="edge")
    after = 0.5 * HEAT + 0.25 * (before[:-2] + before[2:])
    crossed = np.bincount(np.flatnonzero(after > 2) % 4, minlength=4)
    for made in (ours(studio, "Spreading"), by_hand(studio, "Spreading")):
        found = computed(studio, made)
        assert (found["next"] == after).all()
        assert (found["crossed"] == crossed).all()


@pytest.mark.parametrize(
    ("result", "instead_of", "given"),
    [("next", "cell == 0 ? 0", "cell == 0 ? 1"), ("crossed", "cell & 3", "cell & 1")],
)
def test_a_mistake_of_a_kernel_shows(
    studio: Studio, result: str, instead_of: str, given: str
) -> None:
    wrong = by_hand(studio, "Spreading", instead_of=instead_of, given=given)
    right = computed(studio, ours(studio, "Spreading"))
    assert (computed(studio, wrong)[result] != right[result]).any()

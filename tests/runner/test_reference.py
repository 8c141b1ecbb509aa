"""The reference's pictures are found again for the same question only."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.picture import Expected, RasterRules
from burnish.stdlib.builtins.accuracy import Error, Within
from burnish.targets.runner import reference
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.reference import Program, remembered
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import SceneState, set_up
from burnish.targets.runner.store import Store

from ..suite.processes import run

ROOT = Path(__file__).parents[2]
TEXT = "material M { map m : texture2d  param k : float = 1  color = m(uv).rgb * k }"
RULES = RasterRules(8, 8, 8)
ERRORS = Errors(("vulkan",))


def asked(
    text: str = TEXT, width: int = 2, height: int = 1, k: float = 1.0
) -> tuple[Program, SceneState]:
    material = burnish.compile(text, ["wgsl"])["M"]
    instance = material.instance()
    texels = np.arange(8, dtype=np.uint8).reshape(height, width, 4)
    instance.set("m", burnish.Texture.of_array(texels))
    instance.set("k", k)
    return Program.of(material.shader), set_up(instance, plane(2), Scene(), (8, 8))


def name(
    question: tuple[Program, SceneState], rules: RasterRules = RULES, errors: Errors | None = None
) -> str:
    return reference._digest(*question, errors, rules)


def test_every_allowed_error_has_a_part_in_the_name() -> None:
    names = {name(asked(), errors=Errors((platform,))) for platform in ("vulkan", "wgsl")}
    measured = Errors(("vulkan",), (("sin", Within(Error(ulp=1.0))),))
    assert len(names | {name(asked(), errors=measured)}) == 3


def test_the_same_question_has_the_same_name() -> None:
    assert name(asked()) == name(asked())


@pytest.mark.parametrize(
    "other",
    [
        lambda: name(asked(width=1, height=2)),
        lambda: name(asked(k=2.0)),
        lambda: name(asked(TEXT.replace("* k", "+ k"))),
        lambda: name(asked(TEXT.replace("texture2d", "texture2d with { wrap = clamp }"))),
        lambda: name(asked(), replace(RULES, subpixel_bits=4)),
        lambda: name(asked(), errors=Errors(("vulkan",))),
    ],
    ids=["texture's shape", "value", "graph", "sampler", "rules", "errors"],
)
def test_another_question_has_another_name(other: Callable[[], str]) -> None:
    assert other() != name(asked())


def test_what_was_drawn_is_the_same_when_it_is_found_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))
    question, store = asked(), Store("pictures")
    drawn = remembered(*question, RULES, store, ERRORS)
    monkeypatch.setattr(reference, "draw", None)
    found = remembered(*question, RULES, store, ERRORS)
    assert [found.covered.dtype, found.targets[0].dtype] == [np.dtype(bool), np.dtype(float)]
    for before, after in (
        (drawn.covered, found.covered),
        (drawn.undecided, found.undecided),
        *zip(drawn.targets, found.targets, strict=True),
        (drawn.layers, found.layers),
        *zip(drawn.low, found.low, strict=True),
        *zip(drawn.high, found.high, strict=True),
    ):
        assert np.array_equal(before, after, equal_nan=before.dtype != np.bool_)


LEVEL = """
pass Level {
    clip_position : point<clip> = vec4(
        if vertex_index == 1 then 3 else -1,
        if vertex_index == 2 then -3 else 0.125,
        0, 1
    )
    target value : rgba8 = vec4(1)
}
material M { }
"""
"""The upper edge of what is drawn goes through the middles of the pixels of the fourth row."""


@pytest.mark.parametrize("is_level", [False, True])
def test_a_picture_is_kept_for_all_rules_by_which_it_is_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, is_level: bool
) -> None:
    """If no edge goes through the middles of pixels, it does not matter who owns such pixels."""
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))
    (program, state), store = asked(), Store("pictures")
    expected = reference.expected
    if is_level:
        program = Program.of(burnish.compile(LEVEL, ["wgsl"], pass_="Level")["M"].shader)
    below, drawn = replace(RULES, owns_bottom=True), 0

    def draw(*of: Any) -> Expected:
        nonlocal drawn
        drawn += 1
        return expected(*of)

    monkeypatch.setattr(reference, "expected", draw)
    pictures = [remembered(program, state, rules, store) for rules in 2 * (RULES, below)]
    assert drawn == 1 + is_level
    rows = [int(picture.covered.any(axis=1).argmax()) for picture in pictures]
    assert rows == ([3, 4, 3, 4] if is_level else [rows[0]] * 4)


def test_a_vertex_input_that_nothing_needs_has_any_numbers() -> None:
    """A square is not negative, so the coordinate is not needed, and nothing binds it."""
    material = burnish.compile(
        "material M { color = if uv.x * uv.x >= 0 then vec3(0.25) else vec3(1) }", ["wgsl"]
    )["M"]
    state = set_up(material.instance(), plane(2), Scene(), (8, 8))
    assert "vertex_uv" not in state.attributes
    drawn = reference.expected(material.shader, state, RULES)
    assert drawn.covered.any()
    assert (drawn.targets[0][drawn.covered][:, :3] == 0.25).all()


CLOSURE = """
import sys
import burnish.compiler.reference.picture
for module in list(sys.modules.values()):
    file = getattr(module, "__file__", None) or ""
    if module.__name__.startswith("burnish."):
        print(file)
"""


def test_all_code_that_the_reference_is_made_of_has_a_part_in_the_name() -> None:
    ran = run([sys.executable, "-c", CLOSURE], check=True)
    folders = {Path(line).relative_to(ROOT).parts[0] for line in ran.stdout.split()}
    # What is generated follows from the code that looks for it.
    assert folders <= {"compiler", "generated", "stdlib", "support"}, folders

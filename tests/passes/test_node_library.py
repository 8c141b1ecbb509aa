"""Constants that a library of nodes passes down leave nothing of what they switch off."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from tests.golden import assert_golden

FOLDER = Path(__file__).parent / "nodes"
NAMES = ("Off", "Placed")


@pytest.fixture(scope="module")
def made() -> dict[str, burnish.CompiledMaterial]:
    compiled = burnish.compile(FOLDER / "nodes.burnish", "glsl")
    return {material.name: material for material in compiled.materials}


@pytest.mark.parametrize("name", NAMES)
def test_only_what_counts_is_left(name: str, made: dict[str, burnish.CompiledMaterial]) -> None:
    (text,) = (file.text for file in made[name].files if file.stage == "fragment")
    assert_golden(text, FOLDER / f"{name}.frag.glsl")


def test_no_stage_reads_a_texture_that_is_switched_off(
    made: dict[str, burnish.CompiledMaterial],
) -> None:
    found = [made[name].reflection.textures for name in NAMES]
    assert [[texture.stages for texture in each] for each in found] == [[()], [("fragment",)]]

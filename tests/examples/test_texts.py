"""Whole texts of a few examples, to be read in review.

``BURNISH_UPDATE_GOLDEN=1`` writes them anew.
"""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

import pytest

import burnish

from ..targets.standings import PROFILES
from .kit import FOLDER

GOLDEN = Path(__file__).parent / "golden"
READ = (
    *(("plastic", "Plastic", profile) for profile in PROFILES),
    ("gouraud", "PerVertex", "wgsl:webgpu"),
    ("gouraud", "PerVertex", "glsl:es300"),
    ("clear_coat", "CarPaint", "wgsl:webgpu"),
    ("marble", "Marble", "hlsl:sm6"),
    ("shadow_map", "Stage", "hlsl:sm6"),
    ("texture_array", "Terrain", "glsl:vulkan"),
    ("indexed", "Indexed", "glsl:es300"),
    ("environment", "Chrome", "wgsl:webgpu"),
    ("confetti", "Confetti", "hlsl:sm6"),
    ("confetti", "Confetti", "glsl:es300"),
    ("sprites", "Balls", "glsl:es300"),
    ("fur", "Cat", "wgsl:webgpu"),
)
"""Example, material and profile."""


@cache
def compiled(example: str, profile: str) -> burnish.CompileResult:
    return burnish.compile(FOLDER / f"{example}.burnish", (profile,))


@pytest.mark.parametrize(("example", "material", "profile"), READ, ids="-".join)
def test_text(example: str, material: str, profile: str) -> None:
    for file in compiled(example, profile)[material].files:
        path = GOLDEN / file.name
        if os.environ.get("BURNISH_UPDATE_GOLDEN"):
            path.write_text(file.text, encoding="utf-8")
        assert file.text == path.read_text(encoding="utf-8")


def test_no_golden_file_is_left_over() -> None:
    names = {
        file.name for example, material, profile in READ
        for file in compiled(example, profile)[material].files
    }  # fmt: skip
    assert {path.name for path in GOLDEN.iterdir()} == names


@pytest.mark.parametrize(("material", "stage"), [("PerPixel", "fragment"), ("PerVertex", "vertex")])
def test_one_word_decides_where_light_is_computed(material: str, stage: str) -> None:
    texts = compiled("gouraud", "wgsl:webgpu")[material]
    assert {s for s in ("vertex", "fragment") if "pow(" in texts.text("wgsl", s)} == {stage}

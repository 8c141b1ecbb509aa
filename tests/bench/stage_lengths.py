"""The lengths of geometry and tessellation stages beside stages that are written by hand.

The ``twins`` compute the same as the examples with the same meaning: if an interpolated normal may
vanish, they take care of it, too.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import burnish
from burnish.compiler.ir.stages import STAGES
from burnish.targets.toolchain import Job, Toolchain, count_instructions, optimise

from .table import Row, Section

TWINS = Path(__file__).with_name("twins")
EXAMPLES = Path(__file__).parents[2] / "examples"
COMPILERS = {"glsl": ("glslang-vulkan", "glsl:vulkan"), "hlsl": ("dxc-spirv", "hlsl:sm6")}
"""The compiler to SPIR-V of each language, and the profile whose texts it takes."""
LIMIT = 1.05

MEASURED = (
    ("sprites", "", "geometry", "balls.geom.glsl"),
    ("sprites", "", "geometry", "balls.geom.hlsl"),
    ("particles", "", "geometry", "sparks.geom.glsl"),
    ("fur", "", "geometry", "shells.geom.glsl"),
    ("fur", "", "geometry", "shells.geom.hlsl"),
    ("outlines", "", "geometry", "ink.geom.glsl"),
    ("fins", "Fins", "geometry", "hairs.geom.glsl"),
    ("shadow_volume", "", "geometry", "volume.geom.glsl"),
    ("cube_map", "Surroundings", "geometry", "faces.geom.glsl"),
    ("normals", "Normals", "geometry", "needles.geom.glsl"),
    ("thorns", "", "geometry", "thorns.geom.glsl"),
    ("thorns", "", "control", "ripples.tesc.glsl"),
    ("thorns", "", "evaluation", "cactus.tese.glsl"),
    ("displacement", "", "control", "ripples.tesc.glsl"),
    ("displacement", "", "control", "ripples.tesc.hlsl"),
    ("displacement", "", "evaluation", "ripples.tese.glsl"),
    ("displacement", "", "evaluation", "ripples.tese.hlsl"),
    ("level_of_detail", "", "control", "dents.tesc.glsl"),
    ("level_of_detail", "", "evaluation", "dents.tese.glsl"),
    ("growing_steps", "", "control", "hills.tesc.glsl"),
    ("growing_steps", "", "evaluation", "hills.tese.glsl"),
    ("splines", "", "control", "spline.tesc.glsl"),
    ("splines", "", "evaluation", "spline.tese.glsl"),
    ("threads", "", "control", "strands.tesc.glsl"),
    ("threads", "", "evaluation", "strands.tese.glsl"),
)
"""Examples, the pass that draws each if it is its own, a stage, and its twin."""


def measure() -> Iterator[Section]:
    """Instructions of the examples' stages and of their twins."""
    title = f"Instructions in stages, as spirv-opt -O leaves them, at most {LIMIT} of the twin's"
    yield Section("stage_lengths", title, [_row(*each) for each in MEASURED])


def _row(example: str, pass_: str, stage: str, twin: str) -> Row:
    language = twin.rpartition(".")[2]
    checker, profile = COMPILERS[language]
    compiled = burnish.compile(
        EXAMPLES / f"{example}.burnish", profile, pass_=pass_ or None, native_stages=True
    )
    material = compiled.materials[0]
    own, by_hand = (
        _count(checker, stage, text)
        for text in (material.text(profile, stage), (TWINS / twin).read_text(encoding="utf-8"))
    )
    ratio = own / by_hand
    return {
        "example": example,
        "stage": stage,
        "language": language,
        "burnish": own,
        "twin": by_hand,
        "ratio": ratio,
        f"at most {LIMIT}": ratio <= LIMIT,
    }


def _count(checker: str, stage: str, text: str) -> int:
    """The instructions of a stage's functions."""
    job = Job(checker, STAGES[stage].suffix, text)
    with Toolchain() as toolchain:
        (verdict,) = toolchain.check([job], keep_modules=True)
    if verdict.spirv is None:
        raise SystemExit(verdict.report())
    return count_instructions(optimise(verdict.spirv))

"""A specialised surface is as short as one that is pruned by hand, and means what it did."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

import burnish
from burnish.api.specialising import specialised
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.targets.toolchain import Job, Toolchain, count_instructions, optimise
from tests.passes.agreement import disagreements
from tests.passes.kit import World, shaders

HERE = Path(__file__).parent
WHOLE, PRUNED = HERE / "whole.burnish", HERE / "open_pbr.burnish"
LOBES = ("coat_weight", "fuzz_weight", "base_metalness", "thin_film_weight")
OTHERS = ("subsurface_weight", "specular_roughness_anisotropy")
BY_HAND = {0: "None", 1: "Coat", 2: "CoatAndFuzz", 4: "Four"}
"""The material that was pruned by hand to so many of the lobes."""
LIMIT = 1.02


def without(lobes: int) -> dict[str, float]:
    """The values that leave only the first lobes."""
    return dict.fromkeys((*LOBES[lobes:], *OTHERS), 0)


@cache
def lengths() -> dict[str, int]:
    """The instructions of the fragment shader of each, after glslang and the optimiser."""
    texts = {}
    for count, name in BY_HAND.items():
        (by_hand,) = burnish.compile(PRUNED, "glsl", material=name)
        (by_proof,) = burnish.compile(WHOLE, "glsl", values=without(count))
        texts[f"{count} by hand"] = by_hand.text("glsl", "fragment")
        texts[f"{count} by proof"] = by_proof.text("glsl", "fragment")
    jobs = [Job("glslang-vulkan", "frag", text, name=name) for name, text in texts.items()]
    with Toolchain() as toolchain:
        verdicts = toolchain.check(jobs, keep_modules=True)
    return {v.job.name: count_instructions(optimise(v.spirv)) for v in verdicts if v.spirv}


@pytest.mark.parametrize("lobes", BY_HAND)
def test_a_specialised_surface_is_as_short_as_one_pruned_by_hand(lobes: int) -> None:
    found = lengths()
    assert found[f"{lobes} by proof"] <= LIMIT * found[f"{lobes} by hand"], found


@pytest.mark.parametrize("lobes", (0, 2))
def test_a_specialised_surface_means_what_it_did(lobes: int) -> None:
    report = Report()
    values = [(name, str(value)) for name, value in without(lobes).items()]
    (shader,) = specialised(shaders(WHOLE), values, report)
    assert not report.failed
    assert not disagreements(shader, [World(seed, traps=seed == 0) for seed in range(3)])

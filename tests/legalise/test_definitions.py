"""Builtins that a profile has not, or has otherwise, become functions of the text, type by type."""

from __future__ import annotations

import pytest

from burnish.targets.legalise.legalise import legalise
from burnish.targets.registry import select

from .kit import staged

MATERIAL = """
material M {
    attribute a : ivec3
    attribute u : uvec2
    spread = dot(normal, to_eye) + float(dot(a, a.zyx))
    color = vec3(spread + float(count_bits(u.x)), float(first_leading_bit(u.y)), 0)
}
"""
COUNTED = "count_bits uint"
LEADING = "first_leading_bit uint"
NEEDED = {
    "glsl:vulkan": {"dot ivec3 ivec3"},
    # The function for the leading bit counts bits itself.
    "glsl:es300": {"dot ivec3 ivec3", COUNTED, LEADING},
    "glsl:gl450": {"dot ivec3 ivec3"},
    # It has words for them, but their results are `lowp`.
    "glsl:es310": {"dot ivec3 ivec3", COUNTED, LEADING},
    "msl": {"dot ivec3 ivec3", LEADING},
    "hlsl": set(),
    "wgsl": set(),
}


@pytest.mark.parametrize("profile", NEEDED)
def test_only_what_a_profile_lacks_for_these_operands_is_defined(profile: str) -> None:
    legal = legalise(staged(MATERIAL).program, *select(profile))
    uses = {" ".join([name, *map(str, types)]) for name, types in legal.definitions}
    assert uses == NEEDED[profile]
    functions = {each.body for stage in legal.program.stages for each in stage.functions}
    assert functions >= {each.body for each in legal.definitions.values()}


def test_a_definition_stands_behind_those_that_it_calls() -> None:
    (_, fragment) = legalise(staged(MATERIAL).program, *select("glsl:es300")).program.stages
    names = [function.name for function in fragment.functions]
    assert names.index("count_bits") < names.index("first_leading_bit")

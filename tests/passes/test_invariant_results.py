"""Positions that have to be invariant are the same operations, whatever else a shader computes."""

from __future__ import annotations

from pathlib import Path

import pytest

from ..examples.kit import EXAMPLES, FOLDER, VARIANTS
from .positions import differing

PROFILES = ("glsl:es300", "wgsl:webgpu")
"""Two profiles that differ in the guards that they need, and in the features that they lack."""
UNLIT = ("Early", "Surfaces")
"""Passes without lights, which take long to compile."""


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_passes_over_one_material_place_it_by_the_same_operations(path: Path) -> None:
    rig = next(variant.rig for variant in VARIANTS if variant.path == path)
    assert not differing(path.read_text("utf-8"), PROFILES, rig, [FOLDER], UNLIT)


PROGRAMS = {
    "a function that others call as well": """
        fn bent(v: vec3) -> vec3 = normalize(v + sin(v.yzx)) * sqrt(1 + dot(v, v.zxy))
        material M {
            position = inherited.position + 0.1 * bent(inherited.normal)
            color    = bent(position) + bent(normal) * bent(vec3(uv, 1))
        }
    """,
    "a root that is used elsewhere without a condition": """
        material M {
            x : float = vertex_position.x
            position = inherited.position * (if x > 0.5 then 1 + sqrt(x) else 1)
            color    = vec3(@vertex (sqrt(x)), uv)
        }
    """,
    "a sum whose terms others need": """
        material M {
            param many : int in 0..8 = 4
            one : float = sum i in 0..many : sin(float(i) * vertex_position.x)
            two : float = sum i in 0..many : cos(float(i) * vertex_position.y)
            some : float = one + vertex_position.z
            position = inherited.position * (some + two)
            color    = vec3(@vertex (some), uv)
        }
    """,
}


@pytest.mark.parametrize("text", PROGRAMS.values(), ids=PROGRAMS.keys())
def test_what_others_need_has_no_say(text: str) -> None:
    assert not differing(text, PROFILES)

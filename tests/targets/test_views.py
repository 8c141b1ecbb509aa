"""The texts of passes that draw several views, and what is said where one draw cannot.

``BURNISH_UPDATE_GOLDEN=1`` writes the texts anew.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.diagnostics.render import render
from burnish.targets.toolchain import Toolchain

from ..examples.kit import jobs_of
from ..golden import assert_golden
from ..suite.verdicts import remarks

GOLDEN = Path(__file__).parent / "golden" / "views"
NATIVE = ("glsl:vulkan", "hlsl:sm6")
"""The profiles for which one draw reaches several views."""
OTHERS = ("glsl:gl330", "glsl:gl450", "glsl:es300", "glsl:es310", "wgsl:webgpu", "msl:metal2")

EYES = """
material M {
    attribute shift : vec3 per instance
    position = inherited.position + 0.1 * float(view_index) * shift
    color    = vec3(uv, 0)
}
/// Both eyes of a viewer.
pass Eyes : Forward {
    views of 2
    param cameras : transform<world, clip>[2] per view
    param tints   : rgb[2]
    clip_position = cameras[view_index] * position
    color         = tints[view_index] * (if view_index == 0 then inherited.color else vec3(1))
}
"""
EXPANDED = """
pass Eyes : Forward {
    views of 2
    expand triangle { strip of 3 as i { position = corner[i].position } }
    clip_position = view_projection * position + vec4(float(view_index), 0, 0, 0)
}
material M { color = vec3(uv, 0) }
"""


def compiled(text: str, *profiles: str, native: bool, pass_: str = "Eyes") -> CompiledMaterial:
    (made,) = burnish.compile(text, profiles, pass_=pass_, native_stages=native).materials
    return made


def told(text: str, profile: str) -> list[str]:
    """The errors about views that one draw cannot reach."""
    with pytest.raises(burnish.CompileError) as caught:
        compiled(text, profile, native=True)
    return [render(found) for found in caught.value.diagnostics]


@pytest.mark.parametrize("native", [True, False])
def test_the_texts(native: bool) -> None:
    profiles = NATIVE if native else (*NATIVE, "wgsl:webgpu")
    material = compiled(EYES, *profiles, native=native)
    for file in material.files:
        folder = "native" if native else "lowered"
        assert_golden(file.text, GOLDEN / f"{folder}.{file.name}.txt")
    with Toolchain() as toolchain:
        assert remarks(list(jobs_of(material)), toolchain) == []


def test_only_compilers_that_know_views_check_them() -> None:
    """The value came to glslang's HLSL later than it is required to be here."""
    names = ("M.Eyes.vert.hlsl", "M.Eyes.frag.hlsl")
    checkers = {file.name: file.checkers for file in compiled(EYES, "hlsl:sm6", native=True).files}
    assert checkers == dict.fromkeys(names, ("dxc-dxil", "dxc-spirv"))


@pytest.mark.parametrize("profile", OTHERS)
def test_a_profile_without_multiview(profile: str) -> None:
    (found,) = told(EYES, profile)
    assert found.startswith(f"error[B0701]: {profile} has no draws of several views\n")
    assert found.endswith("= help: without `--native-stages`, each view is a draw of its own")
    compiled(EYES, profile, native=False)


@pytest.mark.parametrize("profile", NATIVE)
def test_expansions_of_views_are_drawn_one_by_one(profile: str) -> None:
    """Few devices have several views in a geometry stage."""
    (found,) = told(EXPANDED, profile)
    feature = "draws of several views with a geometry stage"
    assert found.startswith(f"error[B0701]: {profile} has no {feature}\n")
    assert found.endswith("= help: without `--native-stages`, each view is a draw of its own")
    lowered = compiled(EXPANDED, profile, native=False)
    assert lowered.reflection.draw.expanded_by == "instances"
    assert lowered.reflection.draw.layers is not None
    assert lowered.reflection.draw.layers.parameter == "draw.view_index"


@pytest.mark.parametrize("native", [True, False])
def test_a_pass_that_says_nothing_of_views_draws_the_first_one(native: bool) -> None:
    """The texts are those of the number 0."""
    read, zero = (
        compiled(text, "glsl:vulkan", native=native, pass_="Forward")
        for text in (EYES, EYES.replace("float(view_index) * shift", "float(0) * shift"))
    )
    assert [file.text for file in read.files] == [file.text for file in zero.files]
    assert read.reflection.draw.layers is None


def test_the_number_of_a_view_is_in_range() -> None:
    """So an element for each view is read without a guard."""
    for native in (True, False):
        vertex, fragment = compiled(EYES, "glsl:vulkan", native=native).files
        for text in (vertex.text, fragment.text):
            assert "clamp(" not in text and "min(" not in text

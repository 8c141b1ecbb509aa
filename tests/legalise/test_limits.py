"""What a profile has less of, or not at all, is told for that profile alone."""

from __future__ import annotations

import pytest

import burnish
from burnish.frozen import changed
from burnish.targets import registry
from burnish.targets.description.profile import Lack
from burnish.targets.legalise.limits import lacks

from .kit import staged


def blocked(group: int, binding: int) -> str:
    return (
        f"extern block Sky at group {group}, binding {binding} {{ tint : vec3 at 0 }}\n"
        "material M { color = tint * uv.x }"
    )


def told(text: str, target: str) -> str:
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(text, [target])
    return str(caught.value)


@pytest.mark.parametrize("target", ["wgsl", "glsl"])
def test_a_profile_has_so_many_groups(target: str) -> None:
    said = told(blocked(4, 0), target)
    profile = "wgsl:webgpu" if target == "wgsl" else "glsl:vulkan"
    assert said == f"5 bind groups of M, but {profile} has only 4"


def test_a_group_has_so_many_bindings() -> None:
    said = told(blocked(3, 1000), "wgsl")
    assert said == "1001 bindings in a group of M, but wgsl:webgpu has only 1000"


def test_the_limit_is_told_where_the_block_is_declared() -> None:
    text = blocked(7, 0)
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(text, ["wgsl"])
    (diagnostic,) = caught.value.diagnostics
    assert diagnostic.span is not None
    assert diagnostic.span.text == "Sky"


@pytest.mark.parametrize("target", ["hlsl", "glsl:gl330", "glsl:es300"])
def test_other_profiles_have_more_or_bind_by_name(target: str) -> None:
    assert burnish.compile(blocked(7, 2000), [target])["M"].files


def test_any_native_may_be_what_a_profile_cannot_do() -> None:
    target = registry.load("wgsl")
    lack = Lack("derivatives", "compute the difference yourself")
    profile = changed(target.profiles[0], cannot={"ddx": lack})
    program = staged("material M { color = vec3(ddx(uv.x)) + ddy(uv.y) }").program
    ((found, node),) = lacks(program, profile)
    assert found is lack
    assert node in {native.node for stage in program.stages for native in stage.natives}

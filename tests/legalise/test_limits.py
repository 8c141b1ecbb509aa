"""The limits and missing features of a profile are reported for that profile alone."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.ir.stages import VERTEX
from burnish.support.frozen import changed
from burnish.targets import registry
from burnish.targets.legalise.lacks import Lack, lacks
from burnish.targets.legalise.limits import Excess, demands, excesses

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


@pytest.mark.parametrize("target", ["hlsl", "glsl:gl330", "glsl:gl450", "glsl:es300"])
def test_other_profiles_have_more_or_number_them_otherwise(target: str) -> None:
    assert burnish.compile(blocked(7, 2000), [target])["M"].files


LARGE = """
pass P {
    attribute a : vec4
    attribute unread : float
    attribute b : vec3
    map low : texture2d
    map high : texture2d
    map wind : texture2d
    param tints : rgb[5]
    param gain : float per draw
    param turns : int in 0..4 per draw
    clip_position = vec4(a.xyz + wind.level(vec2(0), 0).xyz, 1)
    target x : rgba8 = a * b.x * vec4(tints[int(b.y)], 1)
    target y : rgba8 = low(a.xy) * high(a.zw)
    target z : rgba8 = vec4(a.x * gain * b.z) * waves
    waves = sum i in 0..turns : sum j in 0..turns : sin(a.x * float(i * j))
}
material M { color = #fff }
"""
HAS = {
    "varyings": 2,
    "attributes": 3,
    "textures": 2,
    "block_bytes": 80,
    "render_targets": 3,
    "nested_blocks": 2,
}
"""The number of things in ``LARGE`` for which there are limits.

Its vertex inputs have three places, although nothing reads the one at the second place.
"""


@pytest.mark.parametrize(("limit", "count"), HAS.items(), ids=HAS)
def test_a_program_may_have_as_much_as_the_limit_and_no_more(limit: str, count: int) -> None:
    program, profile = staged(LARGE, "P").program, registry.load("wgsl").profiles[0]
    beyond = Excess(limit, count, count - 1, "high" if limit == "textures" else "")
    for most, expected in ((count, []), (count - 1, [beyond])):
        limits = changed(profile.limits, asked_textures=None, **{limit: most})
        assert list(excesses(program, changed(profile, limits=limits))) == expected


SAMPLED = """material M {
    map a : texture2d
    map b : texture2d with { wrap = clamp }
    map c : texture2d
    color = a(uv).rgb + b(uv).rgb + c(uv).rgb
}"""


def test_samplers_that_may_be_shared_count_once() -> None:
    program, profile = staged(SAMPLED).program, registry.load("wgsl").profiles[0]
    for most, expected in ((3, []), (2, []), (1, [Excess("samplers", 2, 1)])):
        limits = changed(profile.limits, samplers=most)
        assert list(excesses(program, changed(profile, limits=limits))) == expected


def test_a_host_may_ask_for_more_textures_up_to_a_number() -> None:
    program, profile = staged(SAMPLED).program, registry.load("wgsl").profiles[0]
    for every, asked, demanded, exceeded in (
        (3, 4, [], []),
        (2, 3, [Excess("textures", 3, 2)], []),
        (1, 2, [], [Excess("textures", 3, 2, "c")]),
        (2, None, [], [Excess("textures", 3, 2, "c")]),
    ):
        limits = changed(profile.limits, textures=every, asked_textures=asked)
        limited = changed(profile, limits=limits)
        assert list(demands(program, limited)) == demanded
        assert list(excesses(program, limited)) == exceeded


def test_the_first_buffer_beyond_the_limit_is_shown() -> None:
    rows = "".join(f"    buffer b{i} : float[]\n" for i in range(5))
    total = " + ".join(f"b{i}[0]" for i in range(5))
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(f"material M {{\n{rows}    color = vec3({total})\n}}\n", "glsl")
    assert render_all(caught.value.diagnostics) == (
        "error[B0702]: 5 storage buffers of the fragment stage of M, but glsl:vulkan has only 4\n"
        " --> <text>:6:12\n"
        "  |\n"
        "6 |     buffer b4 : float[]\n"
        "  |            ^^\n"
        "  = help: put arrays into one buffer, whose elements are a structure with a member of "
        "each, or compile for glsl:gl450, hlsl:sm6 or wgsl:webgpu"
    )


def doubling(levels: int) -> str:
    """Functions each of which calls the one before it twice, down to one of a few operations."""
    rows = ["fn f0(x: float) -> float = sin(x) * cos(x) + sin(2 * x)"]
    rows += [
        f"fn f{i}(x: float) -> float = f{i - 1}(x) * f{i - 1}(x + 1)" for i in range(1, levels)
    ]
    return "\n".join([*rows, f"material M {{ alpha = f{levels - 1}(uv.x) }}"])


def in_place_of_calls(levels: int) -> int:
    profile = registry.load("hlsl").profiles[0]
    limits = changed(profile.limits, inlined_operations=-1)
    (found,) = excesses(staged(doubling(levels)).program, changed(profile, limits=limits))
    return found.count


def test_what_calls_come_to_doubles_with_each_function_and_is_counted_to_an_end() -> None:
    counts = [in_place_of_calls(levels) for levels in (10, 11, 12)]
    assert counts[0] > 3 * 2**8
    assert 1.9 < counts[1] / counts[0] < 2.1 and 1.9 < counts[2] / counts[1] < 2.1
    assert in_place_of_calls(100) == in_place_of_calls(200) == 10**9


def test_calls_that_nobody_could_inline_are_refused_for_all_targets() -> None:
    assert burnish.compile(doubling(9), "all", partial=True).materials[0].lacking == {}
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(doubling(60), "hlsl")
    assert render_all(caught.value.diagnostics) == (
        "error[B0702]: 1000000000 operations in place of calls of M, but hlsl:sm6 has only 10000\n"
        "  = help: compilers and drivers put the whole body of a function wherever it is called, "
        "with those of all that it calls: have an equation compute once what several calls share, "
        "or a loop what they repeat"
    )
    lacking = burnish.compile(doubling(60), "all", partial=True).materials[0].lacking
    every = [profile for name in registry.names() for profile in registry.load(name).profiles]
    assert len(lacking) == len([profile for profile in every if not profile.on_request])


def test_a_stage_that_a_profile_has_not_got_is_told_once() -> None:
    program, profile = staged(LARGE, "P").program, registry.load("wgsl").profiles[0]
    (found,) = lacks(program, changed(profile, stages=(VERTEX,)))
    assert found == Lack("fragment stage", program.stages[1].roots[0].id)


def test_a_read_that_a_profile_cannot_do_is_told_once() -> None:
    profile = changed(registry.load("wgsl").profiles[0], cannot=frozenset({"sample_level"}))
    program = staged(LARGE, "P").program
    assert [found.feature for found in lacks(program, profile)] == ["reads of levels that are said"]


def test_any_native_may_be_what_a_profile_cannot_do() -> None:
    target = registry.load("wgsl")
    profile = changed(target.profiles[0], cannot=frozenset({"ddx"}))
    program = staged("material M { color = vec3(ddx(uv.x)) + ddy(uv.y) }").program
    (found,) = lacks(program, profile)
    assert found.feature == "derivatives"
    assert found.node in {native.node.id for stage in program.stages for native in stage.natives}

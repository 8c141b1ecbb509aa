"""The texts of a kernel in every language, as whole texts to be read."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.targets.toolchain import Toolchain

from ..examples.kit import jobs_of
from ..golden import assert_golden

HERE = Path(__file__).parent
EXAMPLE = HERE.parents[1] / "examples" / "swarm.burnish"


@pytest.mark.parametrize("profile", ["glsl:vulkan", "hlsl:sm6", "wgsl:webgpu", "msl:metal2"])
def test_the_text_is_as_it_was(profile: str) -> None:
    kernel = burnish.compile(EXAMPLE, profile, partial=True)["Swarm"]
    (file,) = kernel.files
    assert file.entry_points.keys() == {"compute"}
    assert_golden(file.text, HERE / "golden" / file.name.replace("Swarm", "swarm"))


IMAGES = """
/// Darkens the corners of a picture.
kernel Vignette {
    map picture : texture2d                             /// What is darkened
    param strength : float in 0..1 = 0.5

    place = (2 * vec2(texel) + 1) / vec2(picture.size()) - 1

    /// The picture, and in its alpha how dark it became.
    result dark   : image2d<rgba16f>[picture.size()] = vec4(picture.load(texel).rgb * light, light)
    result light_ : image2d<r32f>[picture.size()]    = light
    light = 1 - strength * dot(place, place)
}
"""


@pytest.mark.parametrize(
    "profile", ["glsl:vulkan", "glsl:es310", "hlsl:sm6", "wgsl:webgpu", "msl:metal2", "glsl:es300"]
)
def test_the_text_of_a_kernel_over_images_is_as_it_was(profile: str) -> None:
    (kernel,) = burnish.compile(IMAGES, profile)
    stages = {stage for file in kernel.files for stage in file.entry_points}
    assert stages == ({"vertex", "fragment"} if profile == "glsl:es300" else {"compute"})
    for file in kernel.files:
        assert_golden(file.text, HERE / "golden" / file.name.replace("Vignette", "vignette"))


def test_compilers_have_nothing_to_remark_about_images() -> None:
    """Each of those for HLSL reads an attribute with the format, which the others do not know."""
    (kernel,) = burnish.compile(IMAGES, "hlsl:sm6")
    with Toolchain() as toolchain:
        verdicts = toolchain.check([*jobs_of(kernel)])
    assert {one.status for one in verdicts} == {"accepted"}
    assert [message.text for one in verdicts for message in one.messages] == []


def test_work_groups_may_share_too_much_for_a_profile() -> None:
    text = """kernel K {
        work_group of 1024
        x = float(index)
        joined = group_sum(vec4(x)) + group_sum(x) + group_sum(vec3(x)).xyzx
        result r : vec4[9] = joined + group_max(vec2(x)).xyxy
    }"""
    burnish.compile(text.replace("of 1024", "of 512"), "hlsl:sm6")
    with pytest.raises(burnish.CompileError) as error:
        burnish.compile(text, "hlsl:sm6")
    (found,) = error.value.diagnostics
    assert found.message == (
        "45056 bytes that a work group shares of K, but hlsl:sm6 has only 32768"
    )


GROUPS = """
/// What groups of forty numbers come to, and what is before each of these.
kernel Scanned {
    work_group of 40
    buffer numbers : float[]
    total = group_sum(numbers[index])
    result totals : vec2[] per group = vec2(total, group_max(numbers[index]))
    result before : vec3[numbers.count] = group_exclusive_sum(vec3(numbers[index], 1, 0)) / total
}
"""


@pytest.mark.parametrize("profile", ["glsl:gl450", "hlsl:sm6", "wgsl:webgpu", "msl:metal2"])
def test_the_text_of_a_kernel_that_joins_is_as_it_was(profile: str) -> None:
    (kernel,) = burnish.compile(GROUPS, profile)
    (file,) = kernel.files
    assert_golden(file.text, HERE / "golden" / file.name.replace("Scanned", "scanned"))


def test_profiles_without_kernels_say_so() -> None:
    for profile in ("glsl:gl330", "glsl:es300"):
        with pytest.raises(burnish.CompileError) as error:
            burnish.compile("kernel K { result r : int[4] = index }", profile)
        (found,) = error.value.diagnostics
        assert found.message == f"{profile} has no compute stage"
        assert str(found.hint) == (
            "compile for glsl:vulkan, glsl:gl450, glsl:es310, hlsl:sm6 or wgsl:webgpu"
        )


def test_every_statement_has_its_place_in_the_source() -> None:
    kernel = burnish.compile(EXAMPLE, "glsl:vulkan")["Swarm"]
    (file,) = kernel.files
    lines = file.text.splitlines()
    writing = [n for n, line in enumerate(lines, 1) if line.startswith("    after[index].")]
    assert writing and set(writing) <= file.spans.keys()


def _declared(profile: str, size: str) -> str:
    """The line in which the text of a kernel declares the size of its work groups."""
    text = f"kernel K {{ {size}  result r : float[9] = float(index) }}"
    (kernel,) = burnish.compile(text, profile)
    (file,) = kernel.files
    words = ("local_size", "numthreads", "workgroup_size")
    (line,) = [line for line in file.text.splitlines() if any(word in line for word in words)]
    return line


@pytest.mark.parametrize(
    ("profile", "line"),
    [
        ("glsl:vulkan", "layout(local_size_x = {}) in;"),
        ("hlsl:sm6", "[numthreads({}, 1, 1)]"),
        ("wgsl:webgpu", "@compute @workgroup_size({})"),
    ],
)
def test_a_kernel_may_say_how_large_its_work_groups_are(profile: str, line: str) -> None:
    assert _declared(profile, "") == line.format(64)
    assert _declared(profile, "work_group of 96 + 32") == line.format(128)


def test_work_groups_may_be_too_large_for_a_profile() -> None:
    text = "kernel K { work_group of 256  result r : float[9] = 1 }"
    burnish.compile(text, "wgsl:webgpu")
    with pytest.raises(burnish.CompileError) as error:
        burnish.compile(text, "glsl:vulkan")
    (found,) = error.value.diagnostics
    assert found.message == ("256 invocations in a work group of K, but glsl:vulkan has only 128")

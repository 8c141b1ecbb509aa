"""The texts of a kernel in every language, as whole texts to be read."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish

from ..golden import assert_golden

HERE = Path(__file__).parent
EXAMPLE = HERE.parents[1] / "examples" / "swarm.burnish"


@pytest.mark.parametrize("profile", ["glsl:vulkan", "hlsl:sm6", "wgsl:webgpu", "msl:metal2"])
def test_the_text_is_as_it_was(profile: str) -> None:
    (kernel,) = burnish.compile(EXAMPLE, profile)
    (file,) = kernel.files
    assert file.entry_points.keys() == {"compute"}
    assert_golden(file.text, HERE / "golden" / file.name.replace("Swarm", "swarm"))


def test_profiles_without_kernels_say_so() -> None:
    for profile in ("glsl:gl330", "glsl:es300"):
        with pytest.raises(burnish.CompileError) as error:
            burnish.compile(EXAMPLE, profile)
        (found,) = error.value.diagnostics
        assert found.message == f"{profile} has no compute stage"
        assert str(found.hint) == "compile for glsl:vulkan, hlsl:sm6 or wgsl:webgpu"


def test_every_statement_has_its_place_in_the_source() -> None:
    (kernel,) = burnish.compile(EXAMPLE, "glsl:vulkan")
    (file,) = kernel.files
    lines = file.text.splitlines()
    writing = [n for n, line in enumerate(lines, 1) if line.startswith("    after[index].")]
    assert writing and set(writing) <= file.spans.keys()

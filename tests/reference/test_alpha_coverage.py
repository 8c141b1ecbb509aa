"""Coverage that the alpha of fragments says, against values that are worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.shader import Shader

from .kit import few_ulps, picture, shader
from .test_drawing import PASSING, triangles
from .test_samples import CONSTANT, FAR, ONE, left_of


def covered(
    more: str = "",
    raster: str = "samples = 4",
    format_: str = "rgba16f",
    material: str = CONSTANT,
) -> Shader:
    """A shader that shows a material's value, which is the parameter `c` by default."""
    return shader(
        f"""{PASSING}
        material M : Base {{ {material} }}
        pass P {{
            raster {{ {raster}, alpha_to_coverage = true }}
            {more}
            target t : {format_} = material.value
        }}""",
        "P",
    )


@pytest.mark.parametrize("alpha", [-5.0, 0.0, 1.0, 7.0])
def test_an_alpha_at_the_ends_covers_none_or_all_on_every_device(alpha: float) -> None:
    found = picture(covered(), triangles(left_of(FAR)), ONE, errors=few_ulps, c=(1, 1, 1, alpha))
    assert found.targets[0][0, 0, 0] == (alpha >= 1)
    assert not found.undecided.any()
    assert found.covered.all() == (alpha >= 1)


@pytest.mark.parametrize(("alpha", "count"), [(0.1, 0), (0.2, 1), (0.5, 2), (0.7, 3), (0.9, 4)])
def test_devices_choose_between_the_ends_and_the_reference_takes_the_nearest(
    alpha: float, count: int
) -> None:
    found = picture(covered(), triangles(left_of(FAR)), ONE, errors=few_ulps, c=(1, 1, 1, alpha))
    assert found.targets[0][0, 0, 0] == count / 4
    assert found.undecided.all()


def test_only_samples_of_the_triangle_are_covered() -> None:
    found = picture(covered(), triangles(left_of(0.5)), ONE, errors=few_ulps, c=(1, 1, 1, 1))
    assert found.targets[0][0, 0, 0] == 0.5 and not found.undecided.any()


def test_a_certain_alpha_in_front_settles_what_is_behind() -> None:
    """The second triangle is in front, and hides one that devices cover differently."""
    given = covered(material="attribute a : float  value = vec4(a)")
    mesh = triangles(
        left_of(FAR), left_of(FAR, z=(0.25, 0.25, 0.25)), a=np.repeat([0.5, 1.0], 3).tolist()
    )
    found = picture(given, mesh, ONE, errors=few_ulps)
    assert found.targets[0][0, 0, 0] == 1 and not found.undecided.any()


def test_what_alpha_leaves_out_writes_no_depth() -> None:
    """The near triangle has no alpha, and the far one behind it is seen."""
    given = covered(material="attribute a : float  value = vec4(1, 0, 0, a)")
    mesh = triangles(
        left_of(FAR, z=(0.25, 0.25, 0.25)), left_of(FAR), a=np.repeat([0.0, 1.0], 3).tolist()
    )
    found = picture(given, mesh, ONE, errors=few_ulps)
    assert found.targets[0][0, 0, 0] == 1 and not found.undecided.any()


def test_what_is_discarded_is_not_covered() -> None:
    given = covered("discard when material.value.x > 0.5")
    found = picture(given, triangles(left_of(FAR)), ONE, errors=few_ulps, c=(1, 1, 1, 0.5))
    assert not found.covered.any() and not found.undecided.any()


def test_passes_without_samples_or_an_alpha_are_told() -> None:
    with pytest.raises(CompileError, match="it has one sample for each pixel"):
        covered(raster="samples = 1")
    narrow = "rg8 = material.value.xy\n target u : rgba16f"
    with pytest.raises(CompileError, match="rg8 has no alpha"):
        covered(format_=narrow)

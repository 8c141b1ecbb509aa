"""Light out of pictures of all around, in `std.image_light`."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference.namespace import Lanes

from .kit import (
    NORMAL_IN_WORLD,
    TO_EYE,
    Floats,
    Place,
    close,
    facets,
    hammersley,
    lanes,
    mirrored_by,
    on_circle,
    shown,
    unit,
)
from .many import values
from .test_around import around
from .truth import truth

SIDE = 48
TINT = np.array((1.0, 0.5, 0.25))
BRIGHT = np.array((0.6, 0.0, 0.8))
MIRRORED = 2 * (NORMAL_IN_WORLD @ TO_EYE) * NORMAL_IN_WORLD - TO_EYE


@dataclass
class Around:
    """A cube whose light grows along an axis, and which notes where it is read."""

    reads: list[tuple[Lanes, float]] = field(default_factory=list)

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of a read, or the size."""
        if "size" in name:
            return (SIDE, SIDE)
        arrow, (level,) = operands
        self.reads.append((tuple(map(float, arrow)), float(level)))
        return (*lanes(light_of(np.array(arrow))), 1.0)


def light_of(arrow: Floats) -> Floats:
    return np.asarray((1 + arrow @ BRIGHT)[..., None] * TINT)


def read_with(density: Floats) -> Floats:
    """The levels for some numbers of samples per steradian: the solid angle of each sample over
    that of a texel, four to the power of the level.
    """
    texel = 4 * np.pi / (6 * SIDE**2)
    return np.asarray(np.maximum(np.log(1 / (density * texel)) / np.log(4), 0))


def found(expression: str) -> tuple[Floats, Around]:
    cube = Around()
    text = (
        "import std.image_light\nmaterial M { map cube : texture_cube\n"
        f"mirrored = reflect(-to_eye, normal)\ncolor = {expression} }}"
    )
    return shown(text, cube=cube), cube


def matt_samples() -> Floats:
    """The directions around +z in which matt surfaces look for light."""
    x, y = hammersley(32).T
    turn, share = np.append(x[1:], 32.5 / 32), np.append(y[1:], 1 / 64)
    return np.concatenate(
        [np.sqrt(1 - share)[:, None] * on_circle(turn), np.sqrt(share)[:, None]], 1
    )


@truth("std.image_light.matt_light_of", "std.image_light.matt_sample", "std.image_light.coarseness")
def test_matt_surfaces_gather_light() -> None:
    """A linear light seems two thirds as steep as it is."""
    color, cube = found("matt_light_of(cube, normal)")
    local = matt_samples()
    arrows = around(NORMAL_IN_WORLD, local)
    assert np.allclose([arrow for arrow, _ in cube.reads], arrows, atol=1e-9)
    levels = read_with(32 * local[:, 2] / np.pi)
    assert np.allclose([level for _, level in cube.reads], levels)
    assert color == close(light_of(arrows).mean(axis=0))
    assert color == pytest.approx((1 + 2 / 3 * NORMAL_IN_WORLD @ BRIGHT) * TINT, rel=0.03)


@truth(
    "std.image_light.glossy_light_of", "std.image_light.along_facet",
    "std.image_light.facets_beside", "std.image_light.coarseness",
)  # fmt: skip
@pytest.mark.parametrize("width", [0.04, 0.5])
def test_facets_gather_light(width: float) -> None:
    """As `std.environments.GlossyLight`, from levels as coarse as the samples lie apart."""
    color, cube = found(f"glossy_light_of(cube, mirrored, {width})")
    normals = facets(16, width)
    local = mirrored_by(normals)
    weights = np.maximum(local[:, 2], 0)
    arrows = around(MIRRORED, local)
    assert color == close((weights[:, None] * light_of(arrows)).sum(axis=0) / weights.sum())
    read = np.array([arrow for arrow, _ in cube.reads])
    assert np.allclose(read, arrows, atol=1e-9)
    density = width**2 / (np.pi * (normals[:, 2] ** 2 * (width**2 - 1) + 1) ** 2)
    # The normals lie four times as dense as the directions, if each is its own cosine.
    levels = read_with(16 * density / 4)
    assert np.allclose([level for _, level in cube.reads], levels)


@truth("std.image_light.coarseness")
def test_no_level_is_finer_than_the_first() -> None:
    _, cube = found("glossy_light_of(cube, mirrored, 0.001)")
    assert {level for _, level in cube.reads} == {0}


F0 = np.array((0.04, 0.5, 1.0))
ALBEDO = np.array((0.5, 0.25, 0.75))


def shares(width: float) -> Floats:
    nv = NORMAL_IN_WORLD @ TO_EYE
    table = values("std.microfacets", "ggx_share(nv, w)", "vec2", nv=nv, w=width)[0]
    return np.asarray(F0 * table[0] + table[1])


def lit(mixin: str, roughness: float, /, **given: Any) -> Floats:
    return shown(
        f"import std.image_light\nmaterial M : Surface + {mixin} {{ albedo = rgb(0.5, 0.25, 0.75)\n"
        f"f0 = rgb(0.04, 0.5, 1)  roughness = {roughness}  color = image_light }}",
        **given,
    )


@truth("std.image_light.Prefiltered", "std.image_light.share_of_facets")
@pytest.mark.parametrize("roughness", [0.5, 1.5])
def test_light_of_prefiltered_cubes(roughness: float) -> None:
    matt = Around()
    glossy = Around()
    color = lit("Prefiltered", roughness, irradiance_map=matt, mirrored_map=glossy,
                mirrored_levels=7)  # fmt: skip
    rough = min(roughness, 1)
    wanted = ALBEDO * light_of(NORMAL_IN_WORLD) + shares(rough**2) * light_of(MIRRORED)
    assert color == pytest.approx(wanted, rel=1e-5)
    for cube, arrow, level in ((matt, NORMAL_IN_WORLD, 0), (glossy, MIRRORED, 6 * rough)):
        ((read, read_level),) = cube.reads
        assert read == pytest.approx(arrow)
        assert read_level == level


@truth("std.image_light.Surrounded", "std.image_light.share_of_facets")
@pytest.mark.parametrize("roughness", [0.6, 1.5])
def test_light_of_one_cube(roughness: float) -> None:
    color = lit("Surrounded", roughness, surroundings=Around())
    width = min(roughness, 1) ** 2
    matt, _ = found("matt_light_of(cube, normal)")
    glossy, _ = found(f"glossy_light_of(cube, mirrored, {width})")
    assert color == pytest.approx(ALBEDO * matt + shares(width) * glossy, rel=1e-5)


@truth("std.image_light.share_of_facets")
def test_an_eye_behind_the_surface_sees_it_as_one_at_its_edge() -> None:
    normal, behind = unit((0.3, 0.8, 0.5)), unit((0.3, -0.9, 0.1))
    call = "share_of_facets(vec3(0.04, 0.5, 1), n, e, 0.5)"
    color = values("std.image_light", call, "vec3", n=[normal], e=[behind])[0]
    table = values("std.microfacets", "ggx_share(nv, 0.25)", "vec2", nv=0.0)[0]
    assert color == pytest.approx(F0 * table[0] + table[1], rel=1e-5)


@truth("std.image_light.Surrounded", "std.image_light.Prefiltered")
def test_even_light_is_scattered_and_mirrored_as_it_is() -> None:
    for mixin, names in (("Surrounded", ["surroundings"]),
                         ("Prefiltered", ["irradiance_map", "mirrored_map"])):  # fmt: skip
        color = lit(mixin, 0.4, **{name: Place((2, 2, 2, 1)) for name in names})
        assert color == pytest.approx(2 * (ALBEDO + shares(0.16)), rel=1e-5)

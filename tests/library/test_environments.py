"""Sampling and light from all around: the library against integrals that NumPy computes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.namespace import Lanes

from ..semantics.kit import at, shader
from .kit import MESH, Floats, close, facets, lanes, mirrored_by, of, shown, unit, written
from .truth import truth

IMPORTS = """
import std.sampling.{axes_along, cosine_direction, facet_normal, hammersley, radical_inverse}
import std.environments.{mirrored_along, mirrored_share, share_of, weight}
"""
MANY = 1024
"""Samples, of which the mean is compared with an integral."""


def value(expression: str) -> Floats:
    return of(expression, "M", IMPORTS)


def mean(expression: str) -> Floats:
    """The mean over the points of a square, called ``p``."""
    return value(
        f"(sum i in 0..{MANY} : {expression}) / {MANY}".replace("(p", f"(hammersley(i, {MANY})")
    )


@truth("std.sampling.radical_inverse", "std.sampling.hammersley")
def test_points_cover_a_square() -> None:
    # 6 is 110 in binary, and 0.011 is three eighths.
    numbers = ("radical_inverse(0)", "radical_inverse(1)", "radical_inverse(6)")
    assert value(", ".join(numbers)) == close([0, 0.5, 0.375])
    assert value("hammersley(3, 8), 0") == close([3.5 / 8, 0.75, 0])


@truth("std.sampling.axes_along")
@pytest.mark.parametrize("axis", [(0, 0, 1), (0, 0, -1), (2, -1, 2), (0.1, 3, -0.2), (-1, 0, 0)])
def test_axes_are_at_right_angles(axis: tuple[float, float, float]) -> None:
    along = unit(axis)
    written = f"axes_along(normalize(vec3{axis}))"
    axes = np.array([value(f"{written}[{i}]") for i in range(3)])
    assert axes[2] == close(along)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-6)
    assert np.linalg.det(axes) == pytest.approx(1)
    # Listing 3 of the paper, whose axes are found again where others could be.
    x, y, z = along
    sign = math.copysign(1.0, z)
    a = -1.0 / (sign + z)
    assert axes[0] == close((1.0 + sign * x * x * a, sign * x * y * a, -sign * x))
    assert axes[1] == close((x * y * a, sign + y * y * a, -y))


@truth("std.sampling.cosine_direction", "std.sampling.on_circle")
def test_directions_are_as_likely_as_their_cosine_is_large() -> None:
    # The integrals of z, z² and x² over the half sphere, times z / pi.
    assert mean("cosine_direction(p).z")[0] == pytest.approx(2 / 3, abs=2e-3)
    assert mean("pow(cosine_direction(p).z, 2)")[0] == pytest.approx(1 / 2, abs=2e-3)
    assert mean("pow(abs(cosine_direction(p).x), 2)")[0] == pytest.approx(1 / 4, abs=2e-3)


def distribution(cosine: Floats, width: float) -> Floats:
    """The density of microfacets after Trowbridge and Reitz."""
    return np.asarray(width**2 / (np.pi * (cosine**2 * (width**2 - 1) + 1) ** 2), np.float64)


def middles(count: int, end: float) -> Floats:
    return np.asarray((np.arange(count) + 0.5) * (end / count), np.float64)


@truth("std.sampling.facet_normal")
@pytest.mark.parametrize("width", [0.09, 0.5, 1.0])
def test_facets_are_as_likely_as_the_surface_has_them(width: float) -> None:
    angle = middles(20_000, np.pi / 2)
    cosine = np.cos(angle)
    density = (
        distribution(cosine, width) * cosine * np.sin(angle) * 2 * np.pi * (np.pi / 2 / 20_000)
    )
    assert density.sum() == pytest.approx(1, abs=1e-4)
    found = mean(f"facet_normal(p, {width}).z")[0]
    assert found == pytest.approx((density * cosine).sum(), abs=3e-3)


def mirrored(cosine: float, roughness: float) -> tuple[float, float]:
    """The values of the table, as an integral over the directions of the incoming light."""
    width = roughness**2
    to_eye = np.array([np.sqrt(1 - cosine**2), 0.0, cosine])
    up, turn = np.meshgrid(middles(1500, np.pi / 2), middles(1500, 2 * np.pi), indexing="ij")
    light = np.stack([np.sin(up) * np.cos(turn), np.sin(up) * np.sin(turn), np.cos(up)], axis=-1)
    half = light + to_eye
    half /= np.linalg.norm(half, axis=-1, keepdims=True)

    def unmasked(c: Floats | float) -> Floats:
        """The share of facets that neighbours do not hide (Walter 2007, equation 34)."""
        tangent2 = (1 - np.square(c)) / np.square(c)
        return np.asarray(2 / (1 + np.sqrt(1 + width**2 * tangent2)))

    shares = distribution(half[..., 2], width) * unmasked(light[..., 2]) * unmasked(cosine)
    shares /= 4 * light[..., 2] * cosine
    weight = shares * light[..., 2] * np.sin(up) * (np.pi / 2 / 1500) * (2 * np.pi / 1500)
    rim = (1 - half @ to_eye) ** 5
    return float((weight * (1 - rim)).sum()), float((weight * rim).sum())


@truth("std.environments.mirrored_share", "std.environments.share_of")
@pytest.mark.parametrize(("cosine", "roughness"), [(0.9, 0.5), (0.5, 0.7), (0.2, 0.6), (0.6, 1.0)])
def test_the_table_is_what_a_surface_mirrors_of_even_light(cosine: float, roughness: float) -> None:
    found = value(f"mirrored_share({cosine}, {roughness}, {MANY}), 0")
    assert found[:2] == pytest.approx(mirrored(cosine, roughness), abs=6e-3)


@truth("std.environments.mirrored_share", "std.environments.share_of")
@pytest.mark.parametrize("count", [5, MANY])
@pytest.mark.parametrize(("cosine", "roughness"), [(0.9, 0.2), (0.2, 0.6), (0.6, 1.0)])
def test_each_facet_has_its_share(cosine: float, roughness: float, count: int) -> None:
    """Karis 2013, the function `IntegrateBRDF`, with the masking of Walter 2007."""
    width = roughness**2
    to_eye = np.array([np.sqrt(1 - cosine**2), 0.0, cosine])
    normals = facets(count, width)
    eye_facet = np.clip(normals @ to_eye, 0, 1)
    light = 2 * eye_facet * normals[:, 2] - cosine

    def unmasked(c: Any) -> Any:
        return 2 * c / (c + np.sqrt(width**2 + (1 - width**2) * c**2))

    with np.errstate(invalid="ignore"):
        seen = unmasked(light) * unmasked(cosine) * eye_facet / (normals[:, 2] * cosine)
    seen = np.where(light > 0, seen, 0)
    rim = (1 - eye_facet) ** 5
    found = value(f"mirrored_share({cosine}, {roughness}, {count}), 0")
    assert found == close([(seen * (1 - rim)).mean(), (seen * rim).mean(), 0])


@truth("std.environments.share_of")
@pytest.mark.parametrize(
    ("facet", "to_eye"),
    [
        ((0.6, 0.0, 0.8), (0.0, 0.0, 1.0)), ((0.2, -0.3, 0.9), (0.7, 0.1, 0.3)),
        ((0.6, 0.0, 0.8), (0.6, 0.0, -0.8)),  # an eye behind the surface, and behind the facet
        ((0.6, 0.0, 0.8), (0.995, 0.0, -0.1)),  # an eye behind the surface, before the facet
        ((-0.995, 0.0, -0.1), (-0.436, 0.0, -0.9)),  # a facet that faces down
    ],
)  # fmt: skip
def test_a_facet_has_a_share_if_it_faces_up_and_mirrors_upwards(
    facet: tuple[float, ...], to_eye: tuple[float, ...]
) -> None:
    normal, eye, width = unit(facet), unit(to_eye), 0.3
    cosine = max(float(normal @ eye), 0.0)
    light = 2 * cosine * normal[2] - eye[2]
    rim, seen = (1 - cosine) ** 5, 0.0
    if light > 0 and normal[2] > 0:
        masked = [c + math.sqrt(width**2 + (1 - width**2) * c**2) for c in (light, eye[2])]
        seen = 4 * light * cosine / (masked[0] * masked[1] * normal[2])
    names = ", ".join(written(each, "vec3") for each in (normal, eye))
    found = value(f"share_of({names}, {width}), 0")
    assert found == close((seen * (1 - rim), seen * rim, 0))


@truth("std.environments.mirrored_along", "std.environments.weight")
@pytest.mark.parametrize("number", range(8))
def test_facets_mirror_an_arrow_as_long_as_one(number: int) -> None:
    arrow = mirrored_by(facets(8, 0.6**2))[number]
    assert value(f"mirrored_along({number}, 8, 0.6)") == close(arrow)
    assert value(f"weight(mirrored_along({number}, 8, 0.6))") == close([max(arrow[2], 0.0)] * 3)


@truth("std.environments.mirrored_share", "std.environments.share_of")
def test_a_smooth_surface_mirrors_all_of_what_its_facets_mirror() -> None:
    found = value("mirrored_share(0.5, 0.02, 64), 0")
    assert found[:2] == pytest.approx([1 - 0.5**5, 0.5**5], abs=1e-3)


@truth("std.environments.MirroredShare")
def test_the_table_goes_right_by_the_cosine_and_down_by_the_roughness() -> None:
    """The triangle's second vertex, at (2, 1), is outside of the picture: ``uv`` is given."""
    text = (
        "import std.environments.{MirroredShare}\nmaterial M {}\n"
        "pass P : MirroredShare { uv = vec2(0.9, 0.4) }"
    )
    whole = shader(text, pass_="P")
    (target,) = whole.results_of(TARGET)
    found = at(whole, target.value, MESH)[:2]
    assert found == pytest.approx(mirrored(0.9, 0.4), abs=3e-2)


@dataclass
class Read:
    """A texture that notes where it is read."""

    seen: Callable[[tuple[Any, ...]], None]
    value: Lanes

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of a read."""
        assert name == "sample_level", name
        place, (level,) = operands
        self.seen((tuple(map(float, place)), float(level)))
        return self.value


@truth("std.environments.lit_from_around")
@pytest.mark.parametrize("seen_from", [(-0.2, 0.9, 0.6), (0.3, -0.9, 0.1)])
def test_light_from_around_is_scattered_and_mirrored(seen_from: tuple[float, ...]) -> None:
    """B. Karis, "Real Shading in Unreal Engine 4": f0 times the first share, and the second one."""
    levels, roughness = 5, 0.25
    asked: dict[str, tuple[Any, ...]] = {}

    def reading(name: str, *value: float) -> Read:
        return Read(lambda where: asked.update({name: where}), value)

    normal, to_eye = unit((0.3, 0.8, 0.5)), unit(seen_from)
    found = shown(
        "import std.environments.{lit_from_around}\n"
        "material M { map matt : texture_cube  map glossy : texture_cube  map shares : texture2d\n"
        "param n : direction<world>  param v : direction<world>\n"
        f"color = lit_from_around(matt, glossy, shares, {levels}, n, v,"
        f" rgb(0.5, 0.25, 1), rgb(0.04, 0.5, 1), {roughness}) }}",
        matt=reading("matt", 0.5, 1, 2, 1), glossy=reading("glossy", 3, 2, 1, 1),
        shares=reading("shares", 0.75, 0.125, 0, 1), n=lanes(normal), v=lanes(to_eye),
    )  # fmt: skip
    f0 = np.array((0.04, 0.5, 1.0))
    wanted = np.array((0.5, 0.25, 1)) * (0.5, 1, 2) + np.array((3, 2, 1)) * (f0 * 0.75 + 0.125)
    assert found == close(wanted)
    cosine = normal @ to_eye
    assert asked["matt"] == (pytest.approx(normal), 0)
    assert asked["glossy"] == (pytest.approx(2 * cosine * normal - to_eye), roughness * 4)
    assert asked["shares"] == (pytest.approx((max(cosine, 0), roughness)), 0)

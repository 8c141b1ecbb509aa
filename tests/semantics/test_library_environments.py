"""Sampling and light from all around: the library against integrals that NumPy computes."""

from __future__ import annotations

import numpy as np
import pytest

from .library_kit import Floats, close, of, unit

IMPORTS = """
import std.sampling.{axes_along, cosine_direction, facet_normal, hammersley, radical_inverse}
import std.environments.{mirrored_share}
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


def test_points_cover_a_square() -> None:
    # 6 is 110 in binary, and 0.011 is three eighths.
    numbers = ("radical_inverse(0)", "radical_inverse(1)", "radical_inverse(6)")
    assert value(", ".join(numbers)) == close([0, 0.5, 0.375])
    assert value("hammersley(3, 8), 0") == close([3.5 / 8, 0.75, 0])


@pytest.mark.parametrize("axis", [(0, 0, 1), (0, 0, -1), (2, -1, 2), (0.1, 3, -0.2), (-1, 0, 0)])
def test_axes_are_at_right_angles(axis: tuple[float, float, float]) -> None:
    along = unit(axis)
    written = f"axes_along(normalize(vec3{axis}))"
    axes = np.array([value(f"{written}[{i}]") for i in range(3)])
    assert axes[2] == close(along)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-6)
    assert np.linalg.det(axes) == pytest.approx(1)


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


@pytest.mark.parametrize(("cosine", "roughness"), [(0.9, 0.5), (0.5, 0.7), (0.2, 0.6), (0.6, 1.0)])
def test_the_table_is_what_a_surface_mirrors_of_even_light(cosine: float, roughness: float) -> None:
    found = value(f"mirrored_share({cosine}, {roughness}, {MANY}), 0")
    assert found[:2] == pytest.approx(mirrored(cosine, roughness), abs=6e-3)


def test_a_smooth_surface_mirrors_all_of_what_its_facets_mirror() -> None:
    found = value("mirrored_share(0.5, 0.02, 64), 0")
    assert found[:2] == pytest.approx([1 - 0.5**5, 0.5**5], abs=1e-3)

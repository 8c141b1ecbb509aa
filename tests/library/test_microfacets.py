"""Facets of `std.microfacets`, against papers written anew with angles, and against integrals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .many import (
    Array,
    albedo,
    directions,
    dots,
    half_sphere,
    halves,
    numbers,
    seen_from,
    singles,
    values,
)
from .truth import truth

MODULE = "std.microfacets"
NL, NV, NH = numbers(0.05, 1, 1), numbers(0.05, 1, 2), numbers(0.05, 1, 3)
WIDTH, WIDTHS = numbers(0.05, 1, 4), numbers(0.2, 1, 5, 2)
TO_LIGHT, TO_EYE = directions(6, above=True), directions(7, above=True)
HALF = halves(TO_LIGHT, TO_EYE)
ROUGHNESS = numbers(0.1, 1, 8)
COLORS = numbers(0, 1, 9, 3)


def agree(expression: str, wanted: Any, kind: str = "float", /, **given: Any) -> None:
    """Check an expression of the library for many arguments."""
    assert np.allclose(values(MODULE, expression, kind, **given), wanted, rtol=1e-5, atol=1e-12)


def tangent2(cosine: Array) -> Array:
    return np.asarray(1 / cosine**2 - 1)


def slope2(direction: Array, widths: Array) -> Array:
    """The square of a slope, each lane in widths: tan² (cos²/x² + sin²/y²)."""
    turn = np.arctan2(direction[:, 1], direction[:, 0])
    inner = (np.cos(turn) / widths[:, 0]) ** 2 + (np.sin(turn) / widths[:, 1]) ** 2
    return np.asarray(tangent2(direction[:, 2]) * inner)


# --- densities -----------------------------------------------------------------------------------


def ggx(cosine: Array, width: Any) -> Array:
    return np.asarray(width**2 / (np.pi * cosine**4 * (width**2 + tangent2(cosine)) ** 2))


@truth("std.microfacets.ggx")
def test_ggx() -> None:
    agree("ggx(nh, w)", ggx(NH, WIDTH), nh=NH, w=WIDTH)


def ggx_of(half: Array, widths: Array) -> Array:
    below = np.pi * widths.prod(axis=1) * half[:, 2] ** 4 * (1 + slope2(half, widths)) ** 2
    return np.asarray(1 / below)


@truth("std.microfacets.ggx", "std.microfacets.square_length")
def test_stretched_ggx() -> None:
    agree("ggx(h, w)", ggx_of(HALF, WIDTHS), h=HALF, w=WIDTHS)


def beckmann(cosine: Array, width: Any) -> Array:
    return np.asarray(np.exp(-tangent2(cosine) / width**2) / (np.pi * width**2 * cosine**4))


@truth("std.microfacets.beckmann")
def test_beckmann() -> None:
    agree("beckmann(nh, w)", beckmann(NH, WIDTH), nh=NH, w=WIDTH)


def beckmann_of(half: Array, widths: Array) -> Array:
    below = np.pi * widths.prod(axis=1) * half[:, 2] ** 4
    return np.asarray(np.exp(-slope2(half, widths)) / below)


@truth("std.microfacets.beckmann", "std.microfacets.square_length")
def test_stretched_beckmann() -> None:
    agree("beckmann(h, w)", beckmann_of(HALF, WIDTHS), h=HALF, w=WIDTHS)


def charlie(cosine: Array, roughness: Any) -> Array:
    sine = np.sqrt(1 - cosine**2)
    return np.asarray((2 + 1 / roughness) * sine ** (1 / roughness) / (2 * np.pi))


@truth("std.microfacets.charlie")
def test_charlie() -> None:
    agree("charlie(nh, r)", charlie(NH, ROUGHNESS), nh=NH, r=ROUGHNESS)


@truth("std.microfacets.blinn")
def test_blinn() -> None:
    power = numbers(1, 90, 10)
    wanted = (power + 2) / (2 * np.pi) * np.exp(power * np.log(NH))
    agree("blinn(nh, p)", wanted, nh=NH, p=power)


@truth(
    "std.microfacets.ggx", "std.microfacets.beckmann", "std.microfacets.charlie",
    "std.microfacets.blinn",
)  # fmt: skip
@pytest.mark.parametrize(
    "density",
    ["ggx(h.z, 0.3)", "ggx(h.z, 1.0)", "ggx(h, vec2(0.3, 0.8))", "beckmann(h.z, 0.4)",
     "beckmann(h, vec2(0.3, 0.8))", "charlie(h.z, 0.3)", "charlie(h.z, 1.0)", "blinn(h.z, 20)"],
)  # fmt: skip
def test_facets_cover_the_surface(density: str) -> None:
    """The sum of their shadows on the surface is the surface."""
    arrows, weights = half_sphere()
    found = values(MODULE, density, h=arrows)
    assert (found * arrows[:, 2] * weights).sum() == pytest.approx(1, abs=1e-3)


# --- masking -------------------------------------------------------------------------------------


def ggx_lambda(slope2: Array) -> Array:
    """By the square of the slope, in widths."""
    return np.asarray((np.sqrt(1 + slope2) - 1) / 2)


@truth("std.microfacets.ggx_lambda")
def test_hidden_facets_of_ggx() -> None:
    agree("ggx_lambda(nv, w)", ggx_lambda(WIDTH**2 * tangent2(NV)), nv=NV, w=WIDTH)
    agree("ggx_lambda(v, w)", ggx_lambda(slope2(TO_EYE, 1 / WIDTHS)), v=TO_EYE, w=WIDTHS)


def beckmann_lambda(a: Array) -> Array:
    """Walter's rational function of 1 over the slope."""
    below = 3.535 * a + 2.181 * a**2
    return np.asarray(np.where(a < 1.6, (1 - 1.259 * a + 0.396 * a**2) / below, 0))


@truth("std.microfacets.beckmann_lambda", "std.microfacets.lambda_of_slope")
def test_hidden_facets_of_beckmann() -> None:
    a = 1 / (WIDTH * np.sqrt(tangent2(NV)))
    assert 8 < (a > 1.6).sum() < len(a) - 8
    agree("beckmann_lambda(nv, w)", beckmann_lambda(a), nv=NV, w=WIDTH)
    a = 1 / np.sqrt(slope2(TO_EYE, 1 / WIDTHS))
    agree("beckmann_lambda(v, w)", beckmann_lambda(a), v=TO_EYE, w=WIDTHS)


@truth("std.microfacets.beckmann_lambda", "std.microfacets.lambda_of_slope")
def test_hidden_facets_of_beckmann_are_nearly_so_many() -> None:
    """The function that the rational one stands for (Heitz 2014, equation 68)."""
    a = numbers(0.2, 3, 11)
    exact = np.array(
        [(math.erf(x) - 1) / 2 + math.exp(-x * x) / (2 * x * math.sqrt(math.pi)) for x in a]
    )
    assert values(MODULE, "lambda_of_slope(1.6 + a)", a=0) == 0
    found = values(MODULE, "lambda_of_slope(a)", a=a)
    assert np.allclose(1 / (1 + found), 1 / (1 + exact), atol=4e-3)


def charlie_lambda(cosine: Array, roughness: Any) -> Array:
    """Table 1 of the paper, between roughness 0 and 1."""
    smooth = (1 - roughness) ** 2
    a, b, c, d, e = (
        smooth * low + (1 - smooth) * high
        for low, high in (
            (25.3245, 21.5473), (3.32435, 3.82987), (0.16801, 0.19823), (-1.27393, -1.97760),
            (-4.85967, -4.32054),
        )
    )  # fmt: skip

    def fit(x: Any) -> Any:
        return a / (1 + b * x**c) + d * x + e

    return np.asarray(np.exp(np.where(cosine < 0.5, fit(cosine), 2 * fit(0.5) - fit(1 - cosine))))


@truth("std.microfacets.charlie_lambda", "std.microfacets.charlie_fit")
def test_hidden_fibres() -> None:
    agree("charlie_lambda(nv, r)", charlie_lambda(NV, ROUGHNESS), nv=NV, r=ROUGHNESS)


@truth("std.microfacets.charlie_lambda", "std.microfacets.charlie_fit")
@pytest.mark.parametrize("cosine", [0.2, 0.5, 0.8])
def test_fibres_that_are_seen_fill_what_is_seen_of_the_surface(cosine: float) -> None:
    """Smith's condition: the seen share of the facets' shadows towards the eye is the surface's."""
    arrows, weights = half_sphere()
    shadows = np.maximum(dots(arrows, seen_from(cosine)), 0) * charlie(arrows[:, 2], 0.5) * weights
    share = 1 / (1 + values(MODULE, "charlie_lambda(c, 0.5)", c=cosine))
    assert shadows.sum() * share == pytest.approx([cosine], rel=0.06)


@truth("std.microfacets.smith", "std.microfacets.separable", "std.microfacets.height_correlated")
def test_masking() -> None:
    given = {"a": numbers(0, 3, 12), "b": numbers(0, 3, 13)}
    a, b = given.values()
    agree("smith(a)", 1 / (1 + a), **given)
    agree("separable(a, b)", 1 / ((1 + a) * (1 + b)), **given)
    agree("height_correlated(a, b)", 1 / (1 + a + b), **given)


def visible(light_lambda: Array, eye_lambda: Array, nl: Array, nv: Array) -> Array:
    return np.asarray(1 / ((1 + light_lambda + eye_lambda) * 4 * nl * nv))


def ggx_visible(nl: Array, nv: Array, width: Any) -> Array:
    return visible(ggx_lambda(width**2 * tangent2(nl)), ggx_lambda(width**2 * tangent2(nv)), nl, nv)


@truth("std.microfacets.ggx_visibility")
def test_visible_facets_of_ggx() -> None:
    given = {"nl": NL, "nv": NV, "w": WIDTH}
    agree("ggx_visibility(nl, nv, w)", ggx_visible(NL, NV, WIDTH), **given)


def ggx_visible_of(to_light: Array, to_eye: Array, widths: Array) -> Array:
    lambdas = [ggx_lambda(slope2(each, 1 / widths)) for each in (to_light, to_eye)]
    return visible(lambdas[0], lambdas[1], to_light[:, 2], to_eye[:, 2])


@truth("std.microfacets.ggx_visibility")
def test_visible_facets_of_stretched_ggx() -> None:
    wanted = ggx_visible_of(TO_LIGHT, TO_EYE, WIDTHS)
    agree("ggx_visibility(l, v, w)", wanted, l=TO_LIGHT, v=TO_EYE, w=WIDTHS)


def beckmann_visible(nl: Array, nv: Array, width: Any) -> Array:
    lambdas = [beckmann_lambda(1 / (width * np.sqrt(tangent2(each)))) for each in (nl, nv)]
    return visible(lambdas[0], lambdas[1], nl, nv)


@truth("std.microfacets.beckmann_visibility")
def test_visible_facets_of_beckmann() -> None:
    wanted = beckmann_visible(NL, NV, WIDTH)
    agree("beckmann_visibility(nl, nv, w)", wanted, nl=NL, nv=NV, w=WIDTH)


@truth(
    "std.microfacets.charlie_visibility", "std.microfacets.neubelt_visibility",
    "std.microfacets.kelemen_visibility",
)  # fmt: skip
def test_visible_fibres_and_varnish() -> None:
    given = {"nl": NL, "nv": NV, "r": ROUGHNESS}
    wanted = visible(charlie_lambda(NL, ROUGHNESS), charlie_lambda(NV, ROUGHNESS), NL, NV)
    agree("charlie_visibility(nl, nv, r)", wanted, **given)
    agree("neubelt_visibility(nl, nv)", 1 / (4 * (1 - (1 - NL) * (1 - NV))), **given)
    agree("kelemen_visibility(nl)", (0.5 / NL) ** 2, **given)


# --- more than once, and samples -----------------------------------------------------------------


GGX = "ggx_reflectance({1}, {0}, vec3(0, 0, 1), to_light, to_eye).x"


def shares(width: float) -> tuple[Any, float]:
    """The share of even light that facets mirror once, by the cosine, and its mean."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    cosines = (nodes + 1) / 2
    found = [albedo(MODULE, GGX.format(width, "vec3(1)"), float(cosine)) for cosine in cosines]
    fit = np.polynomial.Polynomial.fit(cosines, found, 8)
    return fit, float((np.array(found) * cosines * weights).sum())


@truth("std.microfacets.multiple_scattering", "std.microfacets.ggx_reflectance")
@pytest.mark.parametrize("width", [0.4, 1.0])
def test_a_white_furnace_shows_no_rough_mirror(width: float) -> None:
    """What is mirrored once and more often is all that arrives, from each side."""
    share, mean = shares(width)
    arrows, weights = half_sphere()
    for cosine in (0.9, 0.4):
        more = values(
            MODULE, "multiple_scattering(1.0, l, v, m)", l=share(arrows[:, 2]), v=share(cosine),
            m=mean,
        )  # fmt: skip
        once = values(
            MODULE, GGX.format(width, "vec3(1)"), to_light=arrows, to_eye=seen_from(cosine)
        )
        total = ((once + more) * arrows[:, 2] * weights).sum()
        assert total == pytest.approx(1, abs=2e-3)
        assert (once * arrows[:, 2] * weights).sum() < 0.95


@truth(
    "std.microfacets.multiple_scattering", "std.microfacets.schlick_mean", "std.microfacets.squared"
)
def test_light_that_is_mirrored_again_and_again() -> None:
    """Each time by the mean share: a geometric series."""
    light, eye, mean = numbers(0.3, 0.9, 14), numbers(0.3, 0.9, 15), 0.7
    cosines = (np.arange(20000) + 0.5) / 20000
    average = (2 * cosines * (1 - cosines) ** 5).mean()
    fresnel = COLORS + (1 - COLORS) * average
    agree("schlick_mean(f0)", fresnel, "vec3", f0=COLORS)
    series = sum(fresnel ** (n + 2) * 0.7 * 0.3**n for n in range(200))
    wanted = series * ((1 - light) * (1 - eye) / (np.pi * 0.3))[:, None]
    agree("multiple_scattering(f0, l, v, m)", wanted, "vec3", f0=COLORS, l=light, v=eye, m=mean)


@truth("std.microfacets.compensation")
def test_what_is_mirrored_once_is_scaled_to_what_is_mirrored() -> None:
    share = numbers(0.3, 1, 16)
    wanted = 1 + COLORS * ((1 - share) / share)[:, None]
    agree("compensation(f0, s)", wanted, "vec3", f0=COLORS, s=share)
    agree("compensation(1.0, s) * s", np.ones(len(share)), s=share)


@truth("std.microfacets.visible_normal", "std.microfacets.visible_density")
@pytest.mark.parametrize("cosine", [0.9, 0.3])
def test_samples_are_as_dense_as_they_say(cosine: float) -> None:
    """Means over samples are integrals with the density."""
    grid = (np.arange(160) + 0.5) / 160
    points = singles(np.stack(np.meshgrid(grid, grid), axis=-1).reshape(-1, 2))
    widths, eye = singles([[0.35, 0.8]]), seen_from(cosine)
    sampled = values(MODULE, "visible_normal(p, v, w)", "vec3", p=points, v=eye, w=widths)
    arrows, weights = half_sphere()
    density = values(MODULE, "visible_density(h, v, w)", h=arrows, v=eye, w=widths) * weights
    assert density.sum() == pytest.approx(1, abs=1e-3)
    for power in (1, 2):
        means = (sampled**power).mean(axis=0)
        assert means == pytest.approx((arrows**power * density[:, None]).sum(axis=0), abs=2e-3)
    assert np.linalg.norm(sampled, axis=1) == pytest.approx(1)


@truth("std.microfacets.visible_density")
def test_the_density_of_seen_facets() -> None:
    """Heitz 2018, equation 3; facets that look away are not seen."""
    half = directions(17, above=True)
    seen = 1 / (1 + ggx_lambda(slope2(TO_EYE, 1 / WIDTHS)))
    wanted = seen * np.maximum(dots(TO_EYE, half), 0) * ggx_of(half, WIDTHS) / TO_EYE[:, 2]
    assert (wanted == 0).sum() > 4
    agree("visible_density(h, v, w)", wanted, h=half, v=TO_EYE, w=WIDTHS)

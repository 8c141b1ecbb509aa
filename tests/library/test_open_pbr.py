"""OpenPBR's surface of `std.models`, against the equations of its specification."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from .kit import NORMAL_IN_WORLD, TO_EYE, Floats, close, unit
from .surfaces import (
    AROUND,
    BACK,
    COAT_NORMAL,
    GLOSS,
    MATT,
    Angles,
    Knobs,
    agree,
    all_bounces,
    angles,
    boost,
    drawn,
    f0_of,
    film,
    fresnel,
    from_library,
    ggx,
    luminous,
    parts,
    round_ggx,
)
from .truth import truth

OPEN_PBR: dict[str, Knobs] = {
    "as it is": {},
    "clay": {"base_weight": 0.9, "base_color": (0.6, 0.4, 0.3), "base_diffuse_roughness": 0.7,
             "subsurface_weight": 0.3, "subsurface_color": (0.9, 0.3, 0.2),
             "geometry_opacity": 0.5},
    "gem": {"specular_weight": 1.4, "specular_ior": 2.1, "specular_color": (0.7, 0.9, 1.0),
            "specular_roughness": 0.2},
    "thinner than air": {"specular_ior": 0.8, "specular_roughness": 0.5},
    "metal": {"base_metalness": 0.8, "base_color": (0.9, 0.6, 0.2), "base_weight": 0.8,
              "specular_weight": 0.7, "specular_color": (0.6, 0.8, 0.9),
              "specular_roughness_anisotropy": 0.6},
    "coated": {"coat_weight": 0.7, "coat_color": (0.9, 0.5, 0.3), "coat_roughness": 0.4,
               "coat_ior": 1.7, "coat_darkening": 0.8, "geometry_coat_normal": COAT_NORMAL,
               "emission_luminance": 2.0, "emission_color": (0.5, 0.7, 0.2), "base_metalness": 0.3},
    "fuzzy": {"fuzz_weight": 0.8, "fuzz_color": (0.9, 0.7, 0.5), "fuzz_roughness": 0.3,
              "emission_luminance": 1.0},
    "from behind": {"normal": BACK, "geometry_coat_normal": BACK, "coat_weight": 0.5,
                    "coat_roughness": 0.5, "base_metalness": 0.4, "base_color": (0.2, 0.5, 0.9)},
    "film": {"thin_film_weight": 0.6, "thin_film_thickness": 0.4, "thin_film_ior": 1.6,
             "base_metalness": 0.5, "base_color": (0.6, 0.5, 0.7)},
}  # fmt: skip


def fuzz(a: Angles, normal: Floats, y: float) -> tuple[float, float]:
    """The share and the density of Zeltner's fuzz, by its matrix in the axes of the eye."""
    x = a.nv
    s = y * (0.0206607 + 1.58491 * y) / (0.0379424 + y * (1.32227 + y))
    m = y * (-0.193854 + y * (-1.14885 + y * (1.7932 - 0.95943 * y * y))) / (0.046391 + y)
    o = y * (0.000654023 + (-0.0207818 + 0.119681 * y) * y) / (1.26264 + y * (-1.92021 + y))
    share = np.exp(-0.5 * ((x - m) / s) ** 2) / (s * np.sqrt(2 * np.pi)) + o
    ai = (2.58126 * x + 0.813703 * y) * y / (1 + 0.310327 * x * x + 2.60994 * x * y)
    bi = (
        np.sqrt(1 - x)
        * (y - 1)
        * y**3
        / (0.0000254053 + 1.71228 * x - 1.71506 * x * y + 1.34174 * y * y)
    )
    forward = unit(a.eye - x * normal)
    w = np.array((a.light @ forward, a.light @ np.cross(normal, forward), a.nl))
    turned = np.array(((ai, 0, bi), (0, ai, 0), (0, 0, 1))) @ w
    return float(share), float(max(turned[2], 0) / np.pi * (ai / (turned @ turned)) ** 2)


DEFAULTS: dict[str, Any] = {
    "base_weight": 1, "base_color": (0.8, 0.8, 0.8), "base_metalness": 0,
    "base_diffuse_roughness": 0, "subsurface_weight": 0, "subsurface_color": (0.8, 0.8, 0.8),
    "specular_weight": 1, "specular_color": (1, 1, 1), "specular_roughness": 0.3,
    "specular_roughness_anisotropy": 0, "specular_ior": 1.5, "coat_weight": 0,
    "coat_color": (1, 1, 1), "coat_roughness": 0, "coat_ior": 1.6, "coat_darkening": 1,
    "fuzz_weight": 0, "fuzz_color": (1, 1, 1), "fuzz_roughness": 0.5, "thin_film_weight": 0,
    "thin_film_thickness": 0.5, "thin_film_ior": 1.4, "emission_luminance": 0,
    "emission_color": (1, 1, 1), "geometry_coat_normal": NORMAL_IN_WORLD,
}  # fmt: skip


def lerp(one: Any, other: Any, weight: float) -> Any:
    return np.asarray(one) + weight * (np.asarray(other) - one)


def base_of(k: Mapping[str, Any], a: Angles) -> tuple[Any, Any, float]:
    """What the base sends of a lamp, its share of even light, and what a clear one mirrors."""
    rough = k["specular_roughness"]
    rougher = min(1, rough**4 + 2 * k["coat_roughness"] ** 4) ** 0.25
    rough = rough + k["coat_weight"] * (rougher - rough)
    other = 1 - k["specular_roughness_anisotropy"]
    along = rough**2 * np.sqrt(2 / (1 + other**2))
    gloss = ggx(a, along, other * along)
    share = parts(a.nv, rough**2)

    ratio = k["specular_ior"] / k["coat_ior"]
    eta = lerp(k["specular_ior"], max(ratio, 1 / ratio), k["coat_weight"])
    f0 = min(k["specular_weight"] * f0_of(eta), 0.99999)
    epsilon = np.sign(eta - 1) * np.sqrt(f0)
    ior = (1 + epsilon) / (1 - epsilon)
    total = 1.0 if 1 - (1 - a.lh**2) / ior**2 <= 0 else fresnel(ior, a.lh)

    def filmed(plain: Any, below: Any) -> Any:
        thin = film(below, k["thin_film_ior"], 1000 * k["thin_film_thickness"], a.lh)
        return lerp(plain, thin, k["thin_film_weight"])

    tint, metal0 = np.asarray(k["specular_color"]), k["base_weight"] * np.asarray(k["base_color"])
    edge = 1 / 7
    dip = a.lh * (1 - a.lh) ** 6 / (edge * (1 - edge) ** 6)
    f82 = luminous(metal0, a.lh) - dip * luminous(metal0, edge) * (1 - tint)
    metal = k["specular_weight"] * boost(metal0, share) * filmed(f82, metal0)
    clear = tint * boost(f0, share) * filmed(total, f0)
    eon = from_library(
        "eon_reflectance(rgb(albedo), r, n, l, e)", "std.reflectances", "vec3",
        albedo=[k["base_color"]], r=k["base_diffuse_roughness"],
        n=[k.get("normal", NORMAL_IN_WORLD)], l=[a.light], e=[TO_EYE],
    )  # fmt: skip
    below = np.asarray(k["subsurface_color"])
    matt = lerp(k["base_weight"] * eon, below / np.pi, k["subsurface_weight"])
    mirrored, metalness = all_bounces(f0, share), k["base_metalness"]
    lit = MATT * (1 - metalness) * (1 - mirrored) * matt + GLOSS * gloss * lerp(
        clear, metal, metalness
    )
    even = tint * mirrored + (1 - mirrored) * lerp(metal0, below, k["subsurface_weight"])
    return lit, lerp(even, k["specular_weight"] * all_bounces(metal0, share), metalness), f0


def darkening(k: Mapping[str, Any], cosine: float, f0: float) -> Any:
    """By what a coat mirrors back to the base, which it dims."""
    n, rough = k["coat_ior"], k["specular_roughness"]
    mean = np.log((10893 * n - 1438.2) / (-774.4 * n**2 + 10212 * n + 1))
    base_rough = lerp(lerp(1, rough, f0), rough, k["base_metalness"])
    inner = lerp(fresnel(n, cosine), 1 - (1 - mean) / n**2, base_rough)
    metal0 = k["base_weight"] * np.asarray(k["base_color"])
    albedo = lerp(metal0, k["subsurface_color"], k["subsurface_weight"])
    albedo = lerp(albedo, k["specular_weight"] * metal0, k["base_metalness"])
    return lerp(1, (1 - inner) / (1 - albedo * inner), k["coat_weight"] * k["coat_darkening"])


def open_pbr(knobs: Knobs, light: Floats) -> Floats:
    """The model's layers, one on top of the other."""
    k = {**DEFAULTS, **knobs}
    normal = k.get("normal", NORMAL_IN_WORLD)
    a, c = angles(light, normal), angles(light, k["geometry_coat_normal"])
    base, even, f0 = base_of(k, a)
    n, weight, tints = k["coat_ior"], k["coat_weight"], np.asarray(k["coat_color"])
    width = max(k["coat_roughness"], 0.045) ** 2
    coat_share = weight * all_bounces(f0_of(n), parts(c.nv, width))

    def under(cosine: float) -> float:
        return float(np.sqrt(1 - (1 - cosine**2) / n**2))

    def passed(nl: float) -> Any:
        absorbed = tints ** (0.5 / under(nl) + 0.5 / under(c.nv))
        return (1 - coat_share) * darkening(k, c.nv, f0) * lerp(1, absorbed, weight)

    coat = weight * GLOSS * fresnel(n, c.lh) * round_ggx(c, width)
    fuzz_share, density = fuzz(a, normal, k["fuzz_roughness"])
    kept, fibres = k["fuzz_weight"] * fuzz_share, np.asarray(k["fuzz_color"])
    lit = (1 - kept) * (a.nl * passed(c.nl) * base + c.nl * coat) + GLOSS * kept * fibres * density
    even = kept * fibres + (1 - kept) * (coat_share + passed(c.nv) * even)
    glow = k["emission_luminance"] * np.asarray(k["emission_color"]) * (1 - kept)
    glow = glow * lerp(1, (1 - fresnel(n, c.nv)) * tints ** (0.5 / under(c.nv)), weight)
    return np.asarray(np.pi * lit + np.asarray(AROUND) * even + glow)


@truth(
    "std.models.OpenPbr",
    "std.models.open_pbr",
    "std.models.open_pbr_share",
    "std.models.open_pbr_emission",
    "std.models.coat_passed",
    "std.models.cosine_in_coat",
    "std.models.openpbr_widths",
    "std.models.dielectric_mean",
    "std.models.zeltner_share",
    "std.models.zeltner_reflectance",
    "std.models.coat_facets",
    "std.models.facets_towards",
    "std.models.facet_cosine",
    "std.models.mirrored_share",
)
@pytest.mark.parametrize("case", OPEN_PBR)
def test_it_looks_as_published(case: str) -> None:
    agree("OpenPbr", open_pbr, OPEN_PBR[case])


@truth("std.models.open_pbr_share")
def test_a_white_surface_sends_out_all_even_light() -> None:
    knobs: Knobs = {
        "base_color": (1.0, 1.0, 1.0),
        "base_metalness": 0.5,
        "coat_weight": 0.5,
        "coat_darkening": 0.0,
        "fuzz_weight": 0.5,
    }
    assert drawn("OpenPbr", knobs, -NORMAL_IN_WORLD) == close(AROUND)

"""glTF's surface of `std.models`, against appendix B of glTF 2.0 and its extensions."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .kit import NORMAL, NORMAL_IN_WORLD, TO_EYE, WORLD, Floats, close, lanes, shown, unit
from .surfaces import (
    ACROSS,
    ALONG,
    AROUND,
    BACK,
    COAT_NORMAL,
    GLOSS,
    MATT,
    TANGENT,
    Knobs,
    agree,
    all_bounces,
    angles,
    drawn,
    f0_of,
    fifth,
    film,
    ggx,
    half_through,
    luminous,
    parts,
    round_ggx,
    through_wall,
)
from .truth import truth

IOR_SHEEN = ((13.673, 1), (-68.78018, 61.57746), (799.08825, 442.78211), (-905.00061, 2597.49308),
             (60.28956, 121.81241), (1086.96473, 3045.55075))  # fmt: skip


GLTF: dict[str, Knobs] = {
    "as it is": {},
    "plastic": {"metallic": 0.0, "roughness": 0.4, "base_color": (0.5, 0.1, 0.3), "ior": 1.8,
                "specular": 0.7, "specular_color": (1.0, 0.8, 0.6), "occlusion": 0.6},
    "coated": {"metallic": 0.4, "roughness": 0.6, "clearcoat": 0.7, "clearcoat_roughness": 0.3,
               "clearcoat_normal": COAT_NORMAL, "emissive": (0.2, 0.1, 0.3),
               "emissive_strength": 3.0},
    "cloth": {"metallic": 0.0, "base_color": (0.4, 0.3, 0.2), "sheen_color": (0.8, 0.5, 0.6),
              "sheen_roughness": 0.6},
    "brushed": {"roughness": 0.3, "anisotropy_strength": 0.7, "base_color": (0.9, 0.6, 0.2)},
    "from behind": {"normal": BACK, "clearcoat_normal": BACK, "clearcoat": 0.6,
                    "clearcoat_roughness": 0.5, "metallic": 0.3, "roughness": 0.5,
                    "sheen_color": (0.1, 0.2, 0.7), "sheen_roughness": 0.7},
    "mirror": {"metallic": 0.0, "ior": 9.0, "specular_color": (1.0, 4.0, 0.5), "roughness": 0.5},
    "oil": {"metallic": 0.3, "roughness": 0.4, "iridescence": 0.6, "iridescence_ior": 1.5,
            "iridescence_thickness": 350.0, "base_color": (0.6, 0.5, 0.7), "specular": 0.6},
    "turned": {"roughness": 0.3, "anisotropy_strength": 0.8, "anisotropy_direction": (0.6, 0.8),
               "base_color": (0.9, 0.6, 0.2)},
    "pane": {"metallic": 0.2, "roughness": 0.6, "transmission": 0.7, "base_color": (0.5, 0.9, 0.3),
             "ior": 1.3, "specular": 0.8, "attenuation_color": (0.5, 0.3, 0.2), "occlusion": 0.5,
             "attenuation_distance": 0.4, "specular_color": (0.3, 1.0, 0.6)},
    "lens": {"metallic": 0.0, "roughness": 0.7, "transmission": 1.0, "thickness": 0.3,
             "attenuation_color": (0.5, 0.3, 0.8), "attenuation_distance": 0.4, "ior": 2.0,
             "clearcoat": 0.5, "sheen_color": (0.3, 0.1, 0.2), "sheen_roughness": 0.5,
             "iridescence": 0.7, "specular": 0.9, "dispersion": 1.0},
    "endless": {"metallic": 0.0, "roughness": 0.1, "transmission": 0.5, "thickness": 0.3,
                "attenuation_color": (0.5, 0.3, 0.8)},
    "white": {"metallic": 0.0, "transmission": 1.0, "thickness": 0.3, "attenuation_distance": 0.2},
    "glass from behind": {"normal": BACK, "metallic": 0.0, "roughness": 0.6, "transmission": 0.5,
                          "base_color": (0.5, 0.2, 0.7)},
}  # fmt: skip


def sheen_share(nv: float, width: float) -> float:
    """The share of MaterialX's sheen, by the function that it publishes."""
    powers = np.array((1, nv, width, nv * width, nv**2, width**2))
    over, under = powers @ np.array(IOR_SHEEN)
    return float(np.clip(over / under, 0, 1))


def gltf(knobs: Knobs, light: Floats) -> Floats:
    """Appendix B of glTF 2.0, and the layers of its extensions."""
    k: dict[str, Any] = {
        "base_color": (1, 1, 1), "metallic": 1, "roughness": 1, "occlusion": 1,
        "emissive": (0, 0, 0), "emissive_strength": 1, "ior": 1.5, "specular": 1,
        "specular_color": (1, 1, 1), "clearcoat": 0, "clearcoat_roughness": 0,
        "clearcoat_normal": NORMAL_IN_WORLD,
        "sheen_color": (0, 0, 0), "sheen_roughness": 0, "anisotropy_strength": 0, "iridescence": 0,
        "iridescence_ior": 1.3, "iridescence_thickness": 400, "anisotropy_direction": (1, 0),
        "transmission": 0, "thickness": 0, "attenuation_color": (1, 1, 1),
        "attenuation_distance": 0, **knobs,
    }  # fmt: skip
    normal = k.get("normal", NORMAL_IN_WORLD)
    a, c = angles(light, normal), angles(light, k["clearcoat_normal"])
    base, width = np.asarray(k["base_color"]), k["roughness"] ** 2
    along = width + k["anisotropy_strength"] ** 2 * (1 - width)
    x, y = k["anisotropy_direction"]
    gloss = ggx(a, along, width, x * ALONG + y * ACROSS, x * ACROSS - y * ALONG)
    f0 = np.minimum(f0_of(k["ior"]) * np.asarray(k["specular_color"]), 1)

    def tinted(share: Any, weight: float, cosine: float) -> Any:
        thin = film(weight * share, k["iridescence_ior"], k["iridescence_thickness"], cosine)
        plain = weight * luminous(share, cosine)
        return plain + k["iridescence"] * (thin - plain)

    clear = tinted(f0, k["specular"], a.lh)
    scattered = MATT * base / np.pi * (1 - k["transmission"])
    dielectric = scattered * (1 - clear.max()) + GLOSS * gloss * clear
    body = dielectric + k["metallic"] * (GLOSS * gloss * tinted(base, 1, a.lh) - dielectric)
    color = np.asarray(k["sheen_color"])
    rough = max(k["sheen_roughness"], 0.045) ** 2
    fibres = (2 + 1 / rough) * (1 - a.nh**2) ** (0.5 / rough) / (2 * np.pi)
    cloth = GLOSS * color * fibres / (4 * max(a.nl + a.nv - a.nl * a.nv, 1e-30))
    left_eye, left_light = (1 - color.max() * sheen_share(x, rough) for x in (a.nv, a.nl))
    coat = k["clearcoat"] * (0.04 + 0.96 * fifth(c.nv))
    below = a.nl * (min(left_eye, left_light) * body + cloth)
    over = c.nl * GLOSS * round_ggx(c, max(k["clearcoat_roughness"], 0.045) ** 2)
    share = parts(a.nv, width)
    even_clear = k["specular"] * all_bounces(f0, share)
    even = even_clear + (1 - even_clear.max()) * base * (1 - k["transmission"])
    even = even + k["metallic"] * (all_bounces(base, share) - even)
    even = coat + (1 - coat) * (color * sheen_share(a.nv, rough) + left_eye * even)
    glow = (1 - coat) * k["emissive_strength"] * np.asarray(k["emissive"])
    passed = (1 - coat) * left_eye * (1 - k["metallic"]) * k["transmission"] * base * absorbed(k)
    facing = half_through(normal, light, TO_EYE)
    through = 1 - tinted(f0, k["specular"], max(float(TO_EYE @ facing), 0)).max()
    blurred = max(k["roughness"] * np.clip(2 * k["ior"] - 2, 0, 1), 0.045) ** 2
    behind = GLOSS * max(-normal @ light, 0) * through_wall(normal, light, TO_EYE, blurred)
    lit = np.pi * ((1 - coat) * below + coat * over + passed * through * behind)
    seen = passed * (1 - even_clear.max()) * np.asarray(AROUND)
    return np.asarray(lit + k["occlusion"] * np.asarray(AROUND) * even + seen + glow)


def absorbed(k: dict[str, Any]) -> Any:
    """Beer's law, along the normal through the mesh as the object stretches it."""
    if not k["attenuation_distance"]:
        return 1.0
    way = k["thickness"] * np.linalg.norm(WORLD[:3, :3] @ unit(NORMAL))
    extinction = -np.log(np.asarray(k["attenuation_color"])) / k["attenuation_distance"]
    return np.exp(-extinction * way)


@truth(
    "std.models.GltfSurface",
    "std.models.gltf_lit",
    "std.models.gltf_even",
    "std.models.sheen_share_of",
    "std.models.largest",
    "std.models.coat_facets",
    "std.models.facets_towards",
    "std.models.facet_cosine",
    "std.models.mirrored_share",
    "std.models.clear_at",
    "std.models.even_clear",
)
@pytest.mark.parametrize("case", GLTF)
def test_it_looks_as_published(case: str) -> None:
    agree("GltfSurface", gltf, GLTF[case])


@truth("std.models.gltf_even")
def test_a_white_surface_sends_out_all_even_light() -> None:
    knobs: Knobs = {"metallic": 0.5, "roughness": 0.6, "clearcoat": 0.5, "clearcoat_roughness": 0.4}
    assert drawn("GltfSurface", knobs, -NORMAL_IN_WORLD) == close(AROUND)


@truth("std.models.GltfSurface")
@pytest.mark.parametrize("thickness", [0.0, 0.5])
def test_clear_glass_sends_out_all_even_light(thickness: float) -> None:
    """Whatever its index is: light passes that it does not mirror."""
    knobs: Knobs = {"metallic": 0.0, "roughness": 0.6, "transmission": 0.8, "ior": 1.7,
                    "thickness": thickness, "dispersion": 2.0}  # fmt: skip
    # The light shines at the back, along the surface.
    assert drawn("GltfSurface", knobs, ALONG) == close(AROUND)


def sight(color: int, knobs: str) -> Floats:
    """The direction in which a colour is seen through glass, and how rough it is."""
    head = f"import std.models.{{GltfSurface}}\nmaterial M : GltfSurface {{ {knobs} color = "
    return shown(f"{head} vec3(sight[{color}]) }}", vertex_tangent=(*lanes(TANGENT), 1.0))


@truth("std.models.GltfSurface", "std.models.sight_by")
def test_a_thin_wall_bends_nothing() -> None:
    for color in range(3):
        assert sight(color, "ior = 2  dispersion = 3") == close(-TO_EYE)


@truth("std.models.GltfSurface", "std.models.sight_by")
@pytest.mark.parametrize("dispersion", [0.0, 2.0])
def test_a_medium_bends_blue_most(dispersion: float) -> None:
    """By Snell's law, with indices that lie half of the spread below and above that of green."""
    spread = 0.5 * (1.8 - 1) * dispersion / 20
    nv = NORMAL_IN_WORLD @ TO_EYE
    for color, ior in enumerate((1.8 - spread, 1.8, 1.8 + spread)):
        inside = np.sqrt(1 - (1 - nv**2) / ior**2)
        bent = (nv * NORMAL_IN_WORLD - TO_EYE) / ior - inside * NORMAL_IN_WORLD
        found = sight(color, f"ior = 1.8  dispersion = {dispersion}  thickness = 0.1")
        assert found == close(bent)
        assert np.linalg.norm(found) == close(1)


@truth("std.models.GltfSurface")
def test_an_index_of_one_neither_mirrors_nor_bends_nor_blurs() -> None:
    """What stands behind is seen as if there were no glass, but for its edge."""
    glass = "metallic = 0  transmission = 1  ior = 1  thickness = 1  roughness = 0.5"
    assert sight(1, glass) == close(-TO_EYE)
    text = f"import std.models.{{GltfSurface}}\nmaterial M : GltfSurface {{ {glass} color = "
    given: Any = {"vertex_tangent": (*lanes(TANGENT), 1.0)}
    assert shown(f"{text} rgb(sight_roughness) }}", **given) == close((0, 0, 0))
    assert shown(f"{text} dielectric_f0 }}", **given) == close((0, 0, 0))

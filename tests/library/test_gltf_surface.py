"""glTF's surface of `std.models`, against appendix B of glTF 2.0 and its extensions."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .kit import NORMAL_IN_WORLD, Floats, close
from .surfaces import (
    AROUND,
    BACK,
    COAT_NORMAL,
    GLOSS,
    MATT,
    Knobs,
    agree,
    all_bounces,
    angles,
    drawn,
    f0_of,
    fifth,
    film,
    ggx,
    luminous,
    parts,
    round_ggx,
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
            "iridescence_thickness": 350.0, "base_color": (0.6, 0.5, 0.7)},
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
        "iridescence_ior": 1.3, "iridescence_thickness": 400, **knobs,
    }  # fmt: skip
    a, c = angles(light, k.get("normal", NORMAL_IN_WORLD)), angles(light, k["clearcoat_normal"])
    base, width = np.asarray(k["base_color"]), k["roughness"] ** 2
    along = width + k["anisotropy_strength"] ** 2 * (1 - width)
    gloss = ggx(a, along, width)
    f0 = np.minimum(f0_of(k["ior"]) * np.asarray(k["specular_color"]), 1)

    def tinted(share: Any) -> Any:
        thin = film(share, k["iridescence_ior"], k["iridescence_thickness"], a.lh)
        plain = luminous(share, a.lh)
        return plain + k["iridescence"] * (thin - plain)

    clear = k["specular"] * tinted(f0)
    dielectric = MATT * base / np.pi * (1 - clear.max()) + GLOSS * gloss * clear
    body = dielectric + k["metallic"] * (GLOSS * gloss * tinted(base) - dielectric)
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
    even = even_clear + (1 - even_clear.max()) * base
    even = even + k["metallic"] * (all_bounces(base, share) - even)
    even = coat + (1 - coat) * (color * sheen_share(a.nv, rough) + left_eye * even)
    glow = (1 - coat) * k["emissive_strength"] * np.asarray(k["emissive"])
    lit = np.pi * ((1 - coat) * below + coat * over)
    return np.asarray(lit + k["occlusion"] * np.asarray(AROUND) * even + glow)


@truth(
    "std.models.GltfSurface",
    "std.models.gltf_lit",
    "std.models.gltf_share",
    "std.models.sheen_share_of",
    "std.models.largest",
    "std.models.coat_facets",
    "std.models.facets_towards",
    "std.models.facet_cosine",
    "std.models.mirrored_share",
)
@pytest.mark.parametrize("case", GLTF)
def test_it_looks_as_published(case: str) -> None:
    agree("GltfSurface", gltf, GLTF[case])


@truth("std.models.gltf_share")
def test_a_white_surface_sends_out_all_even_light() -> None:
    knobs: Knobs = {"metallic": 0.5, "roughness": 0.6, "clearcoat": 0.5, "clearcoat_roughness": 0.4}
    assert drawn("GltfSurface", knobs, -NORMAL_IN_WORLD) == close(AROUND)

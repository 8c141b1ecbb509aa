"""Burley's "principled" surface of `std.models`, against his own function."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .kit import NORMAL_IN_WORLD, Floats, close
from .surfaces import (
    AROUND,
    BACK,
    GLOSS,
    MATT,
    Knobs,
    agree,
    all_bounces,
    angles,
    drawn,
    fifth,
    ggx,
    luminous,
    parts,
)
from .truth import truth

PRINCIPLED: dict[str, Knobs] = {
    "as it is": {},
    "cloth": {"base_color": (0.5, 0.1, 0.3), "sheen": 0.7, "sheen_tint": 0.25, "subsurface": 0.4},
    "lacquer": {"clearcoat": 0.8, "clearcoat_gloss": 0.3, "roughness": 0.7, "specular": 0.9,
                "specular_tint": 0.6, "metallic": 0.3},
    "brushed": {"anisotropic": 0.8, "metallic": 1.0, "roughness": 0.45},
    "from behind": {"normal": BACK, "clearcoat": 0.7, "clearcoat_gloss": 0.2, "metallic": 0.3},
    "black": {"base_color": (0.0, 0.0, 0.0), "sheen": 1.0, "sheen_tint": 1.0},
}  # fmt: skip


def principled(knobs: Knobs, light: Floats) -> Floats:
    """Burley's own function (`disney.brdf`), with facets that mask each other by their height."""
    k: dict[str, Any] = {
        "base_color": (0.82, 0.67, 0.16), "subsurface": 0, "metallic": 0, "specular": 0.5,
        "specular_tint": 0, "roughness": 0.5, "anisotropic": 0, "sheen": 0, "sheen_tint": 0.5,
        "clearcoat": 0, "clearcoat_gloss": 1, **knobs,
    }  # fmt: skip
    a, base = angles(light, k.get("normal", NORMAL_IN_WORLD)), np.asarray(k["base_color"])
    bright = base @ (0.3, 0.6, 0.1)
    hue = base / bright if bright > 0 else np.ones(3)
    spec0 = k["specular"] * 0.08 * (1 + k["specular_tint"] * (hue - 1))
    spec0 = spec0 + k["metallic"] * (base - spec0)
    fl, fv, fh = fifth(a.nl), fifth(a.nv), fifth(a.lh)
    f90 = a.lh**2 * k["roughness"]
    matt = (1 + fl * (2 * f90 - 0.5)) * (1 + fv * (2 * f90 - 0.5))
    flat = (1 + fl * (f90 - 1)) * (1 + fv * (f90 - 1))
    flat = 1.25 * (flat * (1 / max(a.nl + a.nv, 1e-30) - 0.5) + 0.5)
    scattered = base / np.pi * (matt + k["subsurface"] * (flat - matt))
    cloth = fh * k["sheen"] * (1 + k["sheen_tint"] * (hue - 1))
    aspect = np.sqrt(1 - 0.9 * k["anisotropic"])
    gloss = luminous(spec0, a.lh) * ggx(
        a, k["roughness"] ** 2 / aspect, k["roughness"] ** 2 * aspect
    )
    w2 = (0.1 + (0.001 - 0.1) * k["clearcoat_gloss"]) ** 2
    tail = (w2 - 1) / (np.pi * np.log(w2) * (1 + (w2 - 1) * a.nh**2))
    masks = np.prod([1 / (c + np.sqrt(0.0625 + c**2 - 0.0625 * c**2)) for c in (a.nl, a.nv)])
    coat = 0.25 * k["clearcoat"] * tail * (0.04 + 0.96 * fh) * masks
    lit = MATT * (1 - k["metallic"]) * (scattered + cloth) + GLOSS * (gloss + coat)
    share = parts(a.nv, k["roughness"] ** 2)
    even = all_bounces(spec0, share) + (1 - k["metallic"]) * base * (
        1 - all_bounces(0.08 * k["specular"], share)
    )
    return np.asarray(np.pi * a.nl * lit + np.asarray(AROUND) * even)


@truth(
    "std.models.Principled",
    "std.models.principled",
    "std.models.principled_share",
    "std.models.berry",
    "std.models.separable_visibility",
    "std.models.facets_towards",
    "std.models.facet_cosine",
    "std.models.mirrored_share",
)
@pytest.mark.parametrize("case", PRINCIPLED)
def test_it_looks_as_published(case: str) -> None:
    agree("Principled", principled, PRINCIPLED[case])


@truth("std.models.principled_share")
def test_a_white_surface_sends_out_all_even_light() -> None:
    knobs: Knobs = {"base_color": (1.0, 1.0, 1.0)}
    assert drawn("Principled", knobs, -NORMAL_IN_WORLD) == close(AROUND)

"""Surfaces of `std.models` under a lamp, and what tests of them have in common: published parts of
such surfaces, written anew with NumPy.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
import pytest

from .kit import NORMAL_IN_WORLD, TO_EYE, WORLD, Floats, lanes, shown, unit
from .many import values

MATT, GLOSS, AROUND = np.array((0.5, 0.75, 1.5)), np.array((2.0, 1.25, 0.25)), (0.3, 0.2, 0.4)
LIGHTS = {
    "before": unit((0.8, 0.5, 0.9)),
    "beside": unit((-0.2, 0.9, -0.4)),
    "behind": unit((-0.5, -0.7, 0.1)),
}
ALONG = unit(np.cross(NORMAL_IN_WORLD, (0.3, 1.0, -0.2)))
ACROSS = np.cross(NORMAL_IN_WORLD, ALONG)
TANGENT = np.linalg.solve(WORLD[:3, :3], ALONG)
BACK = unit(NORMAL_IN_WORLD - 1.2 * (NORMAL_IN_WORLD @ TO_EYE) * TO_EYE)
"""A normal that faces away from the eye, and towards two of the lights."""
COAT_NORMAL = unit(NORMAL_IN_WORLD + np.array((0.2, -0.1, 0.15)))

Knobs = Mapping[str, Any]


def drawn(base: str, knobs: Knobs, to_light: Floats) -> Floats:
    """The colour of a material that sets some knobs, under one lamp and even light."""
    equations = "  ".join(f"{name} = {written(value)}" for name, value in knobs.items())
    return shown(
        f"import std.models.{{{base}}}\nimport std.lights.{{Directional}}\n"
        f"material M : {base} {{ {equations} }}\n"
        "rig R { lamp : Directional }",
        **{"lamp.direction": lanes(-to_light), "lamp.diffuse_color": lanes(MATT),
           "lamp.specular_color": lanes(GLOSS), "ambient_light": AROUND,
           "vertex_tangent": (*lanes(TANGENT), 1.0)},
    )  # fmt: skip


def written(value: Any) -> str:
    """A number, a colour, two numbers or a normal in the language."""
    if isinstance(value, tuple) and len(value) == 2:
        return f"vec2{value}"
    if isinstance(value, tuple):
        return f"rgb({', '.join(map(repr, value))})"
    if isinstance(value, np.ndarray):
        return f"(vec3({', '.join(map(repr, lanes(value)))}) as normal<world>)"
    return repr(value)


class Angles(NamedTuple):
    """The cosines of a light, the eye and the half vector."""

    light: Floats
    eye: Floats
    half: Floats
    nl: float
    nv: float
    nh: float
    lh: float


def angles(light: Floats, normal: Floats = NORMAL_IN_WORLD) -> Angles:
    half = unit(light + TO_EYE)
    nl, nv, nh = (max(float(normal @ arrow), 0.0) for arrow in (light, TO_EYE, half))
    return Angles(light, TO_EYE, half, nl, nv, nh, float(light @ half))


# --- what is published ---------------------------------------------------------------------------


def fifth(cosine: float) -> float:
    return float((1 - cosine) ** 5)


def luminous(f0: Any, lh: float) -> Any:
    """Schlick's share."""
    return np.asarray(f0) + (1 - np.asarray(f0)) * fifth(lh)


def ggx(a: Angles, ax: float, ay: float, along: Floats = ALONG, across: Floats = ACROSS) -> float:
    """Density and visibility of stretched facets (Burley 2012; Heitz 2014, equation 99)."""
    if ax == ay:
        return round_ggx(a, ax)
    x, y = a.half @ along, a.half @ across
    density = 1 / (np.pi * ax * ay * ((x / ax) ** 2 + (y / ay) ** 2 + a.nh**2) ** 2)

    def hidden(v: Floats, cosine: float) -> float:
        slope2 = ((v @ along * ax) ** 2 + (v @ across * ay) ** 2) / cosine**2
        return float(np.sqrt(1 + slope2) - 1) / 2

    if a.nl <= 0:
        return 0.0
    seen = 1 / (1 + hidden(a.light, a.nl) + hidden(a.eye, a.nv))
    return float(density * seen / (4 * a.nl * a.nv))


def round_ggx(a: Angles, width: float) -> float:
    """The same by one width (Walter 2007, equation 33; Lagarde and de Rousiers 2014, 3.1.2)."""
    density = width**2 / (np.pi * (a.nh**2 * (width**2 - 1) + 1) ** 2)
    if a.nl <= 0:
        return 0.0
    light, eye = (np.sqrt(c**2 + width**2 * (1 - c**2)) for c in (a.nl, a.nv))
    return float(density / (2 * (a.nl * eye + a.nv * light)))


def through_wall(normal: Floats, light: Floats, eye: Floats, alpha: float) -> float:
    """The microfacet BTDF of `KHR_materials_transmission`, "Implementation Notes"."""
    nh = float(normal @ half_through(normal, light, eye))
    density = alpha**2 / (np.pi * (nh**2 * (alpha**2 - 1) + 1) ** 2)
    visible = 1.0
    for cosine in (max(float(-normal @ light), 0), max(float(normal @ eye), 0)):
        visible /= cosine + np.sqrt(alpha**2 + (1 - alpha**2) * cosine**2)
    return float(density * visible)


def half_through(normal: Floats, light: Floats, eye: Floats) -> Floats:
    """The half vector of the same section."""
    return unit(eye - 2 * (normal @ light) * normal + light)


def fresnel(ior: float, cosine: float) -> float:
    """Of a clear medium, by the angle inside."""
    inside = np.sqrt(1 - (1 - cosine**2) / ior**2)
    upright = (cosine - ior * inside) / (cosine + ior * inside)
    lying = (ior * cosine - inside) / (ior * cosine + inside)
    return float((upright**2 + lying**2) / 2)


def f0_of(ior: float) -> float:
    return float(((ior - 1) / (ior + 1)) ** 2)


def from_library(
    expression: str, module: str = "std.microfacets", kind: str = "float", **given: Any
) -> Any:
    """What other tests hold against papers."""
    return values(module, expression, kind, **({"one": 1.0} | given))[0]


def parts(nv: float, width: float) -> Floats:
    return np.asarray(from_library("ggx_share(nv, w)", "std.microfacets", "vec2", nv=nv, w=width))


def all_bounces(f0: Any, share: Floats) -> Any:
    """The share that is mirrored after any number of bounces (Turquin 2019)."""
    f0 = np.asarray(f0)
    return (f0 * share[0] + share[1]) * boost(f0, share)


def boost(f0: Any, share: Floats) -> Any:
    return 1 + np.asarray(f0) * (1 / share.sum() - 1)


def film(f0: Any, index: float, nanometres: float, lh: float) -> Floats:
    f0 = np.broadcast_to(np.asarray(f0, float), 3)
    call = f"iridescent_fresnel(rgb(f), {index}, {nanometres}, lh)"
    return np.asarray(from_library(call, "std.iridescence", "vec3", f=[f0], lh=lh))


# --- the library against them ---------------------------------------------------------------------

Model = Callable[[Knobs, Floats], Floats]


def agree(base: str, model: Model, knobs: Knobs) -> None:
    """Check a material of the library that sets some knobs, before, beside and behind the lamp."""
    for place, to_light in LIGHTS.items():
        wanted = pytest.approx(model(knobs, to_light), rel=2e-6, abs=1e-7)
        assert drawn(base, knobs, to_light) == wanted, place

"""The library's lights and terms, against NumPy (``truth.py`` says why)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .kit import (
    NORMAL_IN_WORLD,
    POSITION_IN_WORLD,
    TO_EYE,
    Floats,
    close,
    columns,
    lanes,
    shown,
    unit,
)
from .truth import truth

# --- lights --------------------------------------------------------------------------------------

LIT = "ambient(#000) + lambert(vec3(0.7, 0.4, 0.25))"
SURFACE = (0.7, 0.4, 0.25)
TINT = (0.9, 0.5, 0.2)


def lit(light: str, term: str, /, **given: Any) -> Floats:
    """A term under one light."""
    name = light.partition(" ")[0]
    text = (
        f"import std.lights.{{{name}}}\nimport std.terms.{{ambient, lambert, phong, blinn_phong}}\n"
        f"material M {{ color = {term} }}\nrig R {{ lamp : {light} }}"
    )
    named = {f"lamp.{member}": value for member, value in given.items()}
    return shown(text, **named)


def lambert(to_light: Any, arriving: Any) -> Floats:
    cosine = max(float(NORMAL_IN_WORLD @ to_light), 0.0)
    return np.asarray(cosine * np.multiply(SURFACE, arriving), np.float64)


@truth("std.lights.Directional", "std.prelude.Light", "std.terms.lambert")
def test_a_directional_light_travels_along_its_direction() -> None:
    direction = unit((-0.2, -0.9, -0.4))
    found = lit("Directional", LIT, direction=lanes(direction), diffuse_color=TINT)
    assert found == close(lambert(-direction, TINT))
    assert found.min() > 0
    behind = lit("Directional", LIT, direction=lanes(-direction), diffuse_color=TINT)
    assert behind == close((0, 0, 0))


LAMP = POSITION_IN_WORLD + np.array((0.3, 1.4, 0.8))
TO_LAMP = unit(LAMP - POSITION_IN_WORLD)


@truth("std.lights.Point")
@pytest.mark.parametrize("way", [(0.3, 1.4, 0.8), (-0.4, 1.2, -0.2), (0.2, -0.1, 1.5)])
def test_a_point_light_shines_from_its_place(way: tuple[float, ...]) -> None:
    found = lit("Point", LIT, place=lanes(POSITION_IN_WORLD + way), diffuse_color=TINT)
    assert found == close(lambert(unit(way), TINT))
    assert found.min() > 0


@truth("std.lights.Spot")
@pytest.mark.parametrize("turn", [0.0, 14.0, 22.0, 29.0, 31.0, 80.0, 170.0])
def test_a_spot_fades_between_its_cones(turn: float) -> None:
    inner, outer = math.radians(15.0), math.radians(30.0)
    across = unit(np.cross(TO_LAMP, (1.0, 0.0, 0.0)))
    axis = -TO_LAMP * math.cos(math.radians(turn)) + across * math.sin(math.radians(turn))
    found = lit("Spot", LIT, place=lanes(LAMP), diffuse_color=TINT, axis=lanes(axis),
                inner=inner, outer=outer)  # fmt: skip
    width = math.cos(inner) - math.cos(outer)
    part = min(max((math.cos(math.radians(turn)) - math.cos(outer)) / width, 0.0), 1.0)
    falloff = part * part * (3.0 - 2.0 * part)
    assert found == close(falloff * lambert(TO_LAMP, TINT))
    assert (falloff > 0) == (turn < 30.0)


@truth("std.lights.Spot")
@pytest.mark.parametrize(("turn", "arrives"), [(0.0, 1.0), (29.0, 1.0), (31.0, 0.0), (45.0, 0.0)])
def test_the_edge_is_hard_if_the_inner_cone_is_the_larger_one(turn: float, arrives: float) -> None:
    across = unit(np.cross(TO_LAMP, (1.0, 0.0, 0.0)))
    axis = -TO_LAMP * math.cos(math.radians(turn)) + across * math.sin(math.radians(turn))
    found = lit("Spot", LIT, place=lanes(LAMP), diffuse_color=TINT, axis=lanes(axis),
                inner=math.radians(50.0), outer=math.radians(30.0))  # fmt: skip
    assert found == close(arrives * lambert(TO_LAMP, TINT))


@truth("std.lights.Spot", "std.prelude.Light")
def test_highlights_fade_like_the_rest() -> None:
    """Exactly between the cones, in the cosine, half of both arrives."""
    inner, outer = math.radians(10.0), math.radians(50.0)
    cosine = (math.cos(inner) + math.cos(outer)) / 2
    across = unit(np.cross(TO_LAMP, (1.0, 0.0, 0.0)))
    axis = -TO_LAMP * cosine + across * math.sqrt(1.0 - cosine * cosine)
    given = {"place": lanes(LAMP), "specular_color": TINT, "inner": inner, "outer": outer}
    there = lit("Spot", "phong(vec3(1), 5)", axis=lanes(-TO_LAMP), **given)
    assert there.min() > 0
    assert lit("Spot", "phong(vec3(1), 5)", axis=lanes(axis), **given) == close(there / 2)


@truth("std.lights.FocusedSpot")
@pytest.mark.parametrize("turn", [10.0, 60.0, 120.0])
def test_a_focused_spot_narrows_and_fades_with_the_square(turn: float) -> None:
    across = unit(np.cross(TO_LAMP, (1.0, 0.0, 0.0)))
    cosine = math.cos(math.radians(turn))
    axis = -TO_LAMP * cosine + across * math.sin(math.radians(turn))
    found = lit("FocusedSpot", LIT, place=lanes(LAMP), diffuse_color=TINT, axis=lanes(axis),
                peak=7.0, focus=3.0)  # fmt: skip
    distance = float(np.linalg.norm(LAMP - POSITION_IN_WORLD))
    falloff = 7.0 * max(cosine, 0.0) ** 3 / distance**2
    assert found == close(falloff * lambert(TO_LAMP, TINT))


@truth("std.lights.Hemisphere")
def test_sky_and_ground_light_what_faces_them() -> None:
    """The irradiance over pi of two half spheres, each with its cosine over the half that is seen:
    half of the sum and half of the difference times the cosine to the axis between them."""
    up, ground = unit((0.2, 0.9, -0.4)), (0.1, 0.3, 0.6)
    given = {"up": lanes(up), "diffuse_color": TINT, "ground_color": ground, "specular_color": TINT}
    both = np.add(TINT, ground) / 2 + np.subtract(TINT, ground) / 2 * (up @ NORMAL_IN_WORLD)
    assert lit("Hemisphere", LIT, **given) == close(np.multiply(SURFACE, both))
    below = np.add(TINT, ground) - both
    turned = {**given, "up": lanes(-up)}
    assert lit("Hemisphere", LIT, **turned) == close(np.multiply(SURFACE, below))
    assert lit("Hemisphere", "phong(vec3(1), 2)", **given) == close((0, 0, 0))
    dim = "light Dim : Hemisphere { falloff = 0.5 }"
    text = (
        f"import std.lights.{{Hemisphere}}\nimport std.terms.{{lambert}}\n{dim}\n"
        "material M { color = lambert(vec3(1)) }\nrig R { lamp : Dim }"
    )
    assert shown(text, **{f"lamp.{k}": v for k, v in given.items()}) == close(both / 2)


# --- terms ---------------------------------------------------------------------------------------


@truth("std.terms.ambient")
def test_ambient_light() -> None:
    found = shown(
        "import std.terms.{ambient}\nmaterial M { color = ambient(vec3(0.7, 0.4, 0.25)) }",
        ambient_light=(0.2, 0.3, 0.4),
    )
    assert found == close(np.multiply(SURFACE, (0.2, 0.3, 0.4)))


ACROSS = unit(np.cross(NORMAL_IN_WORLD, np.cross(TO_EYE, NORMAL_IN_WORLD)))
GRAZING = POSITION_IN_WORLD - ACROSS - 0.1 * NORMAL_IN_WORLD
"""A place behind the surface whose mirrored direction goes to the eye."""
AWAY = POSITION_IN_WORLD + ACROSS + 0.1 * NORMAL_IN_WORLD
"""A place before it whose mirrored direction goes away from the eye."""


@truth("std.terms.phong", "std.terms.mirrored")
@pytest.mark.parametrize("place", [LAMP, POSITION_IN_WORLD - (0.3, 1.4, 0.8), GRAZING, AWAY])
def test_a_highlight_after_phong(place: Any) -> None:
    to_lamp = unit(place - POSITION_IN_WORLD)
    cosine = float(NORMAL_IN_WORLD @ to_lamp)
    mirrored = 2.0 * cosine * NORMAL_IN_WORLD - to_lamp
    power = max(float(mirrored @ TO_EYE), 0.0) ** 5 if cosine > 0 else 0.0
    found = lit("Point", "phong(vec3(0.7, 0.4, 0.25), 5)", place=lanes(place), specular_color=TINT)
    assert found == close(power * np.multiply(SURFACE, TINT))


FLAT: dict[str, Any] = {
    "object_to_world": columns(np.eye(4)), "vertex_position": (0.0, 0.0, 0.0),
    "vertex_normal": (0.0, 0.0, 1.0),
}  # fmt: skip
"""A point at the origin of a surface that lies in the plane of x and y."""


@truth("std.terms.mirrored")
def test_light_along_a_surface_has_no_highlight() -> None:
    """It travels to the eye, exactly along the surface."""
    text = (
        "import std.lights.{Directional}\nimport std.terms.{phong}\n"
        "material M { color = phong(vec3(1), 5) }\nrig R { lamp : Directional }"
    )
    for height, arrives in ((0.0, 0.0), (1e-9, 1.0)):
        along = {"lamp.direction": lanes(unit((1.0, 0.0, -height))), "eye": (2.0, 0.0, 0.0)}
        assert shown(text, **FLAT, **along) == pytest.approx([arrives] * 3)


@truth("std.terms.blinn_phong", "std.terms.blinn_coefficients")
def test_no_highlight_is_seen_from_behind() -> None:
    text = (
        "import std.lights.{Directional}\nimport std.terms.{blinn_phong}\n"
        "material M { color = blinn_phong(vec3(0), 5) }\nrig R { lamp : Directional }"
    )
    sun = {"lamp.direction": lanes(unit((1.0, 0.0, -0.5)))}
    before, behind = (shown(text, **FLAT, **sun, eye=(0.5, 0.0, z)) for z in (2.0, -2.0))
    assert before.min() > 0.1
    assert behind == close((0, 0, 0))


@truth("std.terms.blinn_phong", "std.terms.blinn_coefficients")
@pytest.mark.parametrize("place", [LAMP, POSITION_IN_WORLD - (0.3, 1.4, 0.8)])
def test_a_surface_after_blinn_and_phong(place: Any) -> None:
    to_lamp = unit(place - POSITION_IN_WORLD)
    cosine, half = float(NORMAL_IN_WORLD @ to_lamp), unit(to_lamp + TO_EYE)
    highlight = max(float(NORMAL_IN_WORLD @ half), 0.0) ** 5 if cosine >= 0 else 0.0
    arriving, shining = np.array(TINT), np.array((0.3, 0.6, 0.8))
    found = lit("Point", "blinn_phong(vec3(0.7, 0.4, 0.25), 5)", place=lanes(place),
                diffuse_color=TINT, specular_color=(0.3, 0.6, 0.8))  # fmt: skip
    assert found == close(np.multiply(SURFACE, arriving) * max(cosine, 0.0) + shining * highlight)


def test_both_highlights_are_seen_from_here() -> None:
    """Otherwise the tests above would compare zeros."""
    mirrored = 2.0 * (NORMAL_IN_WORLD @ TO_LAMP) * NORMAL_IN_WORLD - TO_LAMP
    assert mirrored @ TO_EYE > 0.1
    assert NORMAL_IN_WORLD @ unit(TO_LAMP + TO_EYE) > 0.1

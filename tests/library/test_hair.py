"""Marschner's hair: each way of light as Karis approximates it, and what strands send in all."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .kit import TO_EYE, close, lanes, shown, unit
from .many import Array, directions, dots, half_sphere, values
from .truth import truth

MODULE = "std.hair"
STRAND = np.array((0.6, 0.0, 0.8))
F0 = 0.0465
AXIS = "(normalize(vec3(0.6, 0, 0.8)) as direction<world>)"
ALBEDO = np.array((0.5, 0.25, 0.75))


def schlick(cosine: Array) -> Array:
    return np.asarray(F0 + (1 - F0) * (1 - cosine) ** 5)


def bell(x: Array, middle: float, width: float) -> Array:
    return np.asarray(np.exp(-((x - middle) ** 2) / (2 * width**2)) / np.sqrt(2 * np.pi * width**2))


def strands(albedo: Any, roughness: float, tilt: float, light: Array, eye: Array) -> Array:
    """By the angles with the plane across the strand, and the one around it."""
    theta_light, theta_eye = (np.arcsin(each @ STRAND) for each in (light, eye))
    across = [each - np.outer(each @ STRAND, STRAND) for each in (light, eye)]
    apart = np.maximum(np.prod([np.linalg.norm(a, axis=1) for a in across], axis=0), 1e-4)
    phi = np.arccos(np.clip(dots(*across) / apart, -1, 1))
    theta_d = np.abs(theta_light - theta_eye) / 2
    sines, beta = np.sin(theta_light) + np.sin(theta_eye), roughness**2
    half = np.cos(phi / 2)
    r = bell(sines, -2 * tilt, beta) * half / 4
    r = r * schlick(np.cos(np.arccos(np.clip(dots(light, eye), -1, 1)) / 2))
    # TT: the offset h at which light enters, and the slower light inside.
    n = 1.19 / np.cos(theta_d) + 0.36 * np.cos(theta_d)
    h = (1 + (0.6 - 0.8 * np.cos(phi)) / n) * half
    entering = (1 - schlick(np.cos(theta_d) * np.sqrt(1 - h**2))) ** 2
    way = np.sqrt(1 - (h / n) ** 2) / (2 * np.cos(theta_d))
    tt = bell(sines, tilt, beta / 2) * entering * np.exp(-3.65 * np.cos(phi) - 3.98)
    # TRT: at h = sqrt(3) / 2.
    f = schlick(np.cos(theta_d) / 2)
    trt = bell(sines, 4 * tilt, 2 * beta) * (1 - f) ** 2 * f * np.exp(17 * np.cos(phi) - 16.78)
    tint = np.asarray(albedo)[None, :]
    return np.asarray(
        r[:, None] + tt[:, None] * tint ** way[:, None]
        + trt[:, None] * tint ** (0.8 / np.cos(theta_d))[:, None]
    )  # fmt: skip


def sent(albedo: str, roughness: float, tilt: float, **given: Any) -> Array:
    call = f"strand_scattering({albedo}, {roughness}, {tilt}, vec3(0.6, 0, 0.8), l, e)"
    return values(MODULE, f"vec3({call})", "vec3", **given)


@truth("std.hair.strand_scattering", "std.hair.cone", "std.hair.half_turn", "std.hair.hair_f0",
       "std.hair.strand_mirrored", "std.hair.strand_passed",
       "std.hair.strand_mirrored_inside")  # fmt: skip
@pytest.mark.parametrize(("roughness", "tilt"), [(0.7, 0.035), (0.9, -0.2), (0.4, 0)])
def test_strands_after_marschner(roughness: float, tilt: float) -> None:
    light, eye = directions(1, count=200), directions(2, count=200)
    found = sent("rgb(0.5, 0.25, 0.75)", roughness, tilt, l=light, e=eye)
    wanted = strands(ALBEDO, roughness, tilt, light, eye)
    assert np.allclose(found, wanted, rtol=1e-4, atol=1e-9)
    assert wanted.max() > 0.1


@truth("std.hair.strand_scattering")
def test_light_and_eye_of_a_strand_may_be_exchanged() -> None:
    one, other = directions(3), directions(4)
    found = sent("rgb(0.5, 0.25, 0.75)", 0.6, 0.035, l=one, e=other)
    assert np.allclose(found, sent("rgb(0.5, 0.25, 0.75)", 0.6, 0.035, l=other, e=one), rtol=1e-6)


@truth("std.hair.strand_scattering")
@pytest.mark.parametrize("sine", [0.0, 0.4, -0.7])
def test_a_white_strand_sends_no_more_than_what_arrives(sine: float) -> None:
    """Over the whole sphere of directions: the approximations add 1 % here."""
    upper, weights = half_sphere(96, 96)
    arrows = np.concatenate([upper, -upper])
    side = np.array((0.0, 1.0, 0.0))
    light = [(sine * STRAND + np.sqrt(1 - sine**2) * side).tolist()]
    found = sent("rgb(1, 1, 1)", 0.5, 0.0, e=arrows, l=light)[:, 0]
    assert 0.5 < (found * np.concatenate([weights, weights])).sum() <= 1.01


@truth("std.hair.cone")
def test_a_cone_has_all_of_its_light() -> None:
    sines = np.linspace(-3, 3, 2001)
    found = values(MODULE, "cone(x, 0.2, 0.3)", x=sines)
    assert float(found.sum() * (sines[1] - sines[0])) == pytest.approx(1, abs=1e-5)
    assert sines[found.argmax()] == pytest.approx(0.2, abs=0.003)


@truth("std.hair.strand_scattering", "std.hair.half_turn")
def test_strands_seen_and_lit_along_themselves() -> None:
    """Nothing is divided by zero."""
    along = [[0.6, 0.0, 0.8], [-0.6, 0.0, -0.8]]
    for light in along:
        found = sent("rgb(1, 1, 1)", 0.5, 0.035, l=[light], e=along)
        assert np.isfinite(found).all() and (found >= 0).all()


@truth("std.hair.strand_scattering")
def test_strands_lit_nearly_along_themselves() -> None:
    """The cosines count as 1e-4 at least: the angle around the strand goes to 90 degrees."""
    side, other = np.array((0.0, 1.0, 0.0)), np.array((-0.8, 0.0, 0.6))
    light = unit(STRAND + 1e-3 * side)
    eye = unit(STRAND + 1e-2 * (side / 2 + other * np.sqrt(3) / 2))
    found = values(
        MODULE,
        "vec3(strand_scattering(rgb(1, 1, 1), 1, 0, vec3(0.6, 0, 0.8),"
        " normalize(vec3(0.6, x, 0.8)), normalize(vec3(0.6, 0, 0.8)"
        " + 10 * x * (vec3(0, 0.5, 0) + sqrt(0.75) * vec3(-0.8, 0, 0.6)))))",
        "vec3", x=1e-3,
    )  # fmt: skip
    wanted = strands(np.ones(3), 1, 0, light[None], eye[None])
    assert np.allclose(found, wanted, rtol=3e-4)


@truth("std.hair.half_turn")
def test_half_an_angle_is_one_of_an_angle() -> None:
    """A cosine may be more than 1 by rounding."""
    found = values(MODULE, "half_turn(x)", x=[1.5, 1, 0, -1, -1.5])
    assert found == pytest.approx([1, 1, np.sqrt(0.5), 0, 0])


@truth("std.hair.marschner")
@pytest.mark.parametrize(("roughness", "used"), [(0.6, 0.6), (0.02, 0.1)])
def test_hair_under_a_lamp(roughness: float, used: float) -> None:
    """Pi times what a strand sends; a highlight is never so small that it is not seen."""
    lamp = np.array((2.0, 1.25, 0.25))
    # One light is in the cone in which strands mirror the eye.
    mirrored = unit(TO_EYE - 2 * (TO_EYE @ STRAND) * STRAND)
    for to_light in (unit((0.8, 0.5, 0.9)), unit((-0.5, -0.7, 0.1)), mirrored):
        found = shown(
            "import std.hair\nimport std.lights.{Directional}\nrig R { lamp : Directional }\n"
            f"material M {{ color = marschner(rgb(0.5, 0.25, 0.75), {roughness}, 0.035, {AXIS}) }}",
            **{"lamp.direction": lanes(-to_light), "lamp.specular_color": lanes(lamp),
               "lamp.diffuse_color": (9.0, 9.0, 9.0)},
        )  # fmt: skip
        wanted = strands(ALBEDO, used, 0.035, to_light[None], TO_EYE[None])[0]
        assert found == close(np.pi * lamp * wanted)

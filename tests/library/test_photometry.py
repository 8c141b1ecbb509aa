"""Units of lamps and cameras, against Lagarde and de Rousiers (2014), and integrals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .kit import NORMAL_IN_WORLD, POSITION_IN_WORLD, Floats, close, lanes, shown, unit
from .many import Array, numbers, values
from .truth import truth

MODULE = "std.photometry"


def agree(expression: str, wanted: Any, /, **given: Any) -> None:
    assert np.allclose(values(MODULE, expression, **given), wanted, rtol=1e-5, atol=1e-9)


# --- fading --------------------------------------------------------------------------------------

FAR, REACH = numbers(0.01, 3, 1), numbers(0.5, 4, 2)


def window(far: Array, reach: Array) -> Array:
    return np.asarray(np.where(far < reach, (1 - (far / reach) ** 4) ** 2, 0))


@truth("std.photometry.inverse_square")
def test_light_fades_with_the_square() -> None:
    size = numbers(0.01, 1, 3)
    agree("inverse_square(d, s)", 1 / np.maximum(FAR, size) ** 2, d=FAR**2, s=size)


@truth("std.photometry.distance_window")
def test_light_ends_at_its_reach() -> None:
    assert 8 < (FAR > REACH).sum() < len(FAR) - 8
    agree("distance_window(d, r)", window(FAR, REACH), d=FAR**2, r=REACH)


@truth("std.photometry.karis_falloff")
def test_falloff_after_karis() -> None:
    agree("karis_falloff(d, r)", window(FAR, REACH) / (FAR**2 + 1), d=FAR**2, r=REACH)


@truth("std.photometry.cone_falloff")
def test_a_spot_fades_between_two_angles() -> None:
    """Lagarde and de Rousiers, listing 11: a scale and an offset that the host computes."""
    turn, inner = numbers(0, 1.2, 4), numbers(0, 0.6, 5)
    outer = inner + 0.4
    scale = 1 / (np.cos(inner) - np.cos(outer))
    wanted = np.clip(np.cos(turn) * scale - np.cos(outer) * scale, 0, 1) ** 2
    assert (wanted == 0).sum() > 8 and (wanted == 1).sum() > 4
    agree("cone_falloff(c, (i as angle), (o as angle))", wanted, c=np.cos(turn), i=inner, o=outer)


@truth("std.photometry.cone_falloff")
def test_the_edge_of_a_spot_is_narrow_where_both_angles_are_one() -> None:
    found = values(MODULE, "cone_falloff(c, 60deg, 60deg)", c=[0.5 - 1e-4, 0.5005, 0.502])
    assert found == pytest.approx([0, 0.25, 1], rel=1e-3)


# --- units ---------------------------------------------------------------------------------------

LUMENS = numbers(10, 2000, 6)
SIZE, RADIUS = numbers(0.1, 2, 7), numbers(0.01, 1, 8)


@truth(
    "std.photometry.candelas_of_point", "std.photometry.candelas_of_spot",
    "std.photometry.candelas_of_cone",
)  # fmt: skip
def test_candelas() -> None:
    """Times the solid angle that they shine into, they are the lumens; spots as if it were pi."""
    agree("candelas_of_point(l) * 4 * pi", LUMENS, l=LUMENS)
    agree("candelas_of_spot(l) * pi", LUMENS, l=LUMENS)
    outer = numbers(0.1, 1.5, 9)
    rings = (np.arange(4000) + 0.5) / 4000 * outer[:, None]
    cap = (2 * np.pi * np.sin(rings)).mean(axis=1) * outer
    agree("candelas_of_cone(l, (o as angle))", LUMENS / cap, l=LUMENS, o=outer)


@truth(
    "std.photometry.nits_of_panel", "std.photometry.nits_of_sphere", "std.photometry.nits_of_tube"
)
def test_nits() -> None:
    """Each piece of a surface sends pi times its nits to all sides: the table of the course."""
    agree("nits_of_panel(l, a)", LUMENS / (np.pi * SIZE), l=LUMENS, a=SIZE)
    agree("nits_of_sphere(l, r)", LUMENS / (np.pi * 4 * np.pi * RADIUS**2), l=LUMENS, r=RADIUS)
    tube = 2 * np.pi * RADIUS * SIZE + 4 * np.pi * RADIUS**2
    agree("nits_of_tube(l, s, r)", LUMENS / (np.pi * tube), l=LUMENS, s=SIZE, r=RADIUS)


@truth("std.photometry.lumens_of_watts")
def test_a_light_bulb() -> None:
    """One of 60 watts has about 800 lumens."""
    agree("lumens_of_watts(60, s)", 683 * 60 * SIZE, s=SIZE)
    assert values(MODULE, "lumens_of_watts(60, s)", s=0.02) == pytest.approx([819.6])


@truth("std.photometry.ev100", "std.photometry.ev100_of_nits", "std.photometry.exposure")
def test_exposure() -> None:
    """The rule of sunny 16, a light meter of K = 12.5, and a sensor that 1.2 times 2^EV fill."""
    assert values(MODULE, "ev100(16.0, t, 100.0)", t=1 / 125) == pytest.approx([14.9658], rel=1e-5)
    aperture, time, iso = numbers(1, 22, 10), numbers(0.001, 2, 11), numbers(50, 3200, 12)
    wanted = np.log2(aperture**2 / time) - np.log2(iso / 100)
    agree("ev100(a, t, i)", wanted, a=aperture, t=time, i=iso)
    agree("ev100_of_nits(n)", np.log2(LUMENS * 100 / 12.5), n=LUMENS)
    value = numbers(-3, 16, 13)
    agree("exposure(e) * 1.2 * exp2(e)", np.ones(len(value)), e=value)


# --- lights --------------------------------------------------------------------------------------


def nits(light: str, /, **given: Any) -> Floats:
    """What a white matt surface sends to the eye."""
    return shown(
        "import std.lights.{Directional, Point, Spot}\nimport std.photometry\n"
        "import std.terms.{lambert}\nmaterial M { color = lambert(vec3(1)) }\n"
        f"light Faint : Spot + Fading {{}}\nrig R {{ lamp : {light} }}",
        **{f"lamp.{name}": value for name, value in given.items()},
    )  # fmt: skip


WAY = np.array((0.3, 1.4, 0.8))
SQUARE = float(WAY @ WAY)
COSINE = float(NORMAL_IN_WORLD @ unit(WAY))
PLACE = lanes(POSITION_IN_WORLD + WAY)
TINT = (0.9, 0.5, 0.2)
ACROSS = unit(np.cross(WAY, (1.0, 0.0, 0.0)))
INNER, OUTER = math.radians(15), math.radians(40)
ASIDE = math.radians(30)
AXIS = lanes(-unit(WAY) * math.cos(ASIDE) + ACROSS * math.sin(ASIDE))


def fading(reach: float) -> float:
    return (1 - (SQUARE / reach**2) ** 2) ** 2 / SQUARE


@truth("std.photometry.PhotometricPoint", "std.photometry.Fading")
def test_a_lamp_of_some_lumens() -> None:
    """The lux over pi: lumens over 4 pi times the square of the distance, times the cosine."""
    lux = 1200 / (4 * np.pi) * fading(3.0) * COSINE
    found = nits("PhotometricPoint", place=PLACE, diffuse_color=TINT, lumens=1200, reach=3.0)
    assert found == close(np.multiply(TINT, lux / np.pi))
    near = nits("PhotometricPoint", place=PLACE, lumens=1200, reach=1e6, size=2.0)
    assert near == pytest.approx([1200 / (4 * np.pi) / 4 * COSINE / np.pi] * 3)


@truth("std.photometry.PhotometricSpot", "std.photometry.Fading")
def test_a_spot_of_some_lumens() -> None:
    share = (math.cos(ASIDE) - math.cos(OUTER)) / (math.cos(INNER) - math.cos(OUTER))
    found = nits("PhotometricSpot", place=PLACE, diffuse_color=TINT, lumens=1200, reach=3.0,
                 axis=AXIS, inner=INNER, outer=OUTER)  # fmt: skip
    lux = 1200 / np.pi * share**2 * fading(3.0) * COSINE
    assert found == close(np.multiply(TINT, lux / np.pi))


@truth("std.photometry.PhotometricSpot")
def test_no_spot_shines_backwards() -> None:
    for axis, arrives in ((-unit(WAY), True), (unit(WAY), False)):
        found = nits("PhotometricSpot", place=PLACE, axis=lanes(axis))
        assert found.all() == found.any() == arrives


@truth("std.photometry.PhotometricSun")
def test_the_sun() -> None:
    found = nits("PhotometricSun", direction=lanes(-unit(WAY)), diffuse_color=TINT, lux=80000.0)
    assert found == close(np.multiply(TINT, 80000 * COSINE / np.pi))


@truth("std.photometry.Fading")
def test_any_light_with_a_place_may_fade() -> None:
    given = {"place": PLACE, "axis": AXIS, "inner": INNER, "outer": OUTER}
    assert nits("Faint", **given, reach=3.0) == close(nits("Spot", **given) * fading(3.0))

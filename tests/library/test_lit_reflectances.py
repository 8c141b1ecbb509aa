"""The terms of `std.reflectances` under a lamp.

Each is pi times a reflectance, the cosine, and the light: `test_reflectances.py` and
`test_microfacets.py` hold the reflectances against papers.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .kit import (
    NORMAL_IN_WORLD,
    POSITION_IN_WORLD,
    TO_EYE,
    Floats,
    close,
    lanes,
    of,
    shown,
    unit,
    written,
)
from .many import values
from .truth import truth

MODULE = "std.reflectances\nimport std.microfacets"
MATT, GLOSS = np.array((0.5, 0.75, 1.5)), np.array((2.0, 1.25, 0.25))
ALBEDO, TINT = "rgb(0.5, 0.25, 0.75)", "rgb(0.125, 0.5, 1)"
ALONG, ACROSS = unit((0.7, -0.2, 0.4)), np.array((0.25, 0.75, -0.5))
AXES = "(normalize(vec3(0.7, -0.2, 0.4)) as direction<world>), vec3(0.25, 0.75, -0.5)"
BEFORE, BESIDE, BEHIND = unit((0.8, 0.5, 0.9)), unit((-0.2, 0.9, -0.4)), unit((-0.5, -0.7, 0.1))
LIGHTS = (BEFORE, BESIDE, BEHIND)


def lit(term: str, to_light: Floats) -> Floats:
    """The colour of a term under one lamp whose colours differ."""
    return shown(
        "import std.reflectances\nimport std.lights.{Directional}\n"
        f"material M {{ color = {term} }}\nrig R {{ lamp : Directional }}",
        **{"lamp.direction": lanes(-to_light), "lamp.diffuse_color": lanes(MATT),
           "lamp.specular_color": lanes(GLOSS)},
    )  # fmt: skip


def value(call: str, to_light: Floats) -> Floats:
    """A function of the library for the mesh and this light."""
    axes = np.stack([ALONG, ACROSS, NORMAL_IN_WORLD])
    given: dict[str, Any] = {
        "n": [NORMAL_IN_WORLD], "l": [to_light], "e": [TO_EYE], "local_l": [axes @ to_light],
        "local_e": [axes @ TO_EYE],
    }  # fmt: skip
    return np.asarray(values(MODULE, f"vec3({call})", "vec3", **given)[0])


def about(wanted: Any) -> Any:
    """Buffers hold numbers of 32 bits."""
    return pytest.approx(np.asarray(wanted), rel=1e-5, abs=1e-7)


def received(to_light: Floats) -> float:
    return float(np.pi * max(float(NORMAL_IN_WORLD @ to_light), 0))


def agree(term: str, color: Floats, reflectance: str) -> None:
    """Check a term before, beside and behind the surface."""
    for to_light in LIGHTS:
        wanted = received(to_light) * color * value(reflectance, to_light)
        assert lit(term, to_light) == about(wanted), term


@truth("std.reflectances.arriving_share")
def test_the_share_of_a_light_that_arrives() -> None:
    for to_light in LIGHTS:
        arrow = f"normalize(vec3({', '.join(map(repr, lanes(to_light)))}))"
        assert lit(f"vec3(arriving_share({arrow}))", BEFORE) == close([received(to_light)] * 3)


@truth("std.reflectances.oren_nayar")
def test_oren_nayar() -> None:
    agree(f"oren_nayar({ALBEDO}, 0.5)", MATT, f"oren_nayar_reflectance({ALBEDO}, 0.5, n, l, e)")


@truth("std.reflectances.fujii")
def test_fujii() -> None:
    agree(f"fujii({ALBEDO}, 0.5)", MATT, f"fujii_reflectance({ALBEDO}, 0.5, n, l, e)")


@truth("std.reflectances.eon")
def test_eon() -> None:
    agree(f"eon({ALBEDO}, 0.5)", MATT, f"eon_reflectance({ALBEDO}, 0.5, n, l, e)")


@truth("std.reflectances.burley")
def test_burley() -> None:
    agree(f"burley({ALBEDO}, 0.5)", MATT, f"burley_reflectance({ALBEDO}, 0.5, n, l, e)")


@truth("std.reflectances.frostbite")
def test_frostbite() -> None:
    agree(f"frostbite({ALBEDO}, 0.5)", MATT, f"frostbite_reflectance({ALBEDO}, 0.5, n, l, e)")


@truth("std.reflectances.subsurface_matt")
def test_subsurface() -> None:
    agree(
        f"subsurface_matt({ALBEDO}, 0.5)", MATT, f"subsurface_reflectance({ALBEDO}, 0.5, n, l, e)"
    )


@truth("std.reflectances.minnaert")
def test_minnaert() -> None:
    agree(f"minnaert({ALBEDO}, 1.5)", MATT, f"minnaert_reflectance({ALBEDO}, 1.5, n, l, e)")


@truth("std.reflectances.cook_torrance")
def test_cook_torrance() -> None:
    agree(f"cook_torrance({ALBEDO}, 0.5)", GLOSS, f"ggx_reflectance({ALBEDO}, 0.25, n, l, e)")


@truth("std.reflectances.beckmann_gloss")
def test_beckmann() -> None:
    reflectance = f"beckmann_reflectance({ALBEDO}, 0.25, n, l, e)"
    agree(f"beckmann_gloss({ALBEDO}, 0.5)", GLOSS, reflectance)


@truth("std.reflectances.brushed", "std.reflectances.on_axes")
def test_brushed() -> None:
    agree(
        f"brushed({ALBEDO}, vec2(0.5, 0.8), {AXES})", GLOSS,
        f"ggx_reflectance({ALBEDO}, vec2(0.25, 0.64), local_l, local_e)",
    )  # fmt: skip


@truth("std.reflectances.ward", "std.reflectances.on_axes")
def test_ward() -> None:
    agree(
        f"ward({ALBEDO}, vec2(0.8, 0.9), {AXES})", GLOSS,
        f"{ALBEDO} * ward_reflectance(vec2(0.64, 0.81), local_l, local_e)",
    )  # fmt: skip


@truth("std.reflectances.ashikhmin_shirley", "std.reflectances.on_axes")
def test_ashikhmin_and_shirley() -> None:
    for to_light in LIGHTS:
        cosines = (max(NORMAL_IN_WORLD @ arrow, 0) for arrow in (to_light, TO_EYE))
        matt = value("ashikhmin_matt({}, {}, {}, {})".format(ALBEDO, TINT, *cosines), to_light)
        call = f"ashikhmin_reflectance({TINT}, vec2(8, 5), local_l, local_e)"
        wanted = received(to_light) * (MATT * matt + GLOSS * value(call, to_light))
        found = lit(f"ashikhmin_shirley({ALBEDO}, {TINT}, vec2(8, 5), {AXES})", to_light)
        assert found == about(wanted)


@truth("std.reflectances.cloth_sheen")
def test_sheen() -> None:
    agree(f"cloth_sheen({ALBEDO}, 0.5)", GLOSS, f"sheen_reflectance({ALBEDO}, 0.5, n, l, e)")


@truth("std.reflectances.clear_coat")
def test_clear_coat() -> None:
    agree("clear_coat(0.75, 0.5)", GLOSS, "0.75 * coat_reflectance(0.25, n, l, e)")


COLOR, OTHER = np.array((0.5, 0.25, 0.75)), np.array((0.125, 0.5, 1))


@truth("std.reflectances.wrapped_lambert")
def test_wrapped() -> None:
    for to_light in LIGHTS:
        cosine = NORMAL_IN_WORLD @ to_light
        wanted = np.clip((cosine + OTHER) / (1 + OTHER) ** 2, 0, 1)
        assert lit(f"wrapped_lambert({ALBEDO}, {TINT})", to_light) == close(COLOR * MATT * wanted)


@truth("std.reflectances.half_lambert")
def test_half_lambert() -> None:
    for to_light in LIGHTS:
        wanted = ((1 + NORMAL_IN_WORLD @ to_light) / 2) ** 2
        assert lit(f"half_lambert({ALBEDO})", to_light) == close(COLOR * MATT * wanted)


@truth("std.reflectances.hair")
def test_hair() -> None:
    """Kajiya and Kay: the sine to the strand, and the cone of the light around it."""
    strand = "(normalize(vec3(0.7, -0.2, 0.4)) as direction<world>)"
    for to_light in LIGHTS:
        light, eye = np.arccos(ALONG @ to_light), np.arccos(ALONG @ TO_EYE)
        highlight = max(-np.cos(light + eye), 0) ** 3
        wanted = COLOR * MATT * np.sin(light) + OTHER * GLOSS * highlight
        assert lit(f"hair({ALBEDO}, {TINT}, 3, {strand})", to_light) == close(wanted)


@truth("std.reflectances.toon")
def test_toon() -> None:
    """In thirds of the cosine: none, half and all of the light."""
    for to_light in (*LIGHTS, unit((0.9, 0.3, -0.5))):
        cosine = max(float(NORMAL_IN_WORLD @ to_light), 0)
        wanted = min(np.floor(3 * cosine), 2) / 2
        assert lit(f"toon({ALBEDO}, 3)", to_light) == close(COLOR * MATT * wanted)


@truth("std.reflectances.gooch")
def test_gooch() -> None:
    for to_light in LIGHTS:
        warmth = (1 + NORMAL_IN_WORLD @ to_light) / 2
        wanted = MATT * (COLOR * (1 - warmth) + OTHER * warmth)
        assert lit(f"gooch({ALBEDO}, {TINT})", to_light) == close(wanted)


@truth("std.reflectances.arriving_share", "std.reflectances.eon")
def test_a_white_matt_surface_that_faces_a_light_shows_its_colour() -> None:
    """The unit of lights, which `std.terms.lambert` shares."""
    found = lit("eon(rgb(1, 1, 1), 0)", NORMAL_IN_WORLD)
    assert found == close(MATT)


@truth("std.reflectances.on_axes")
@pytest.mark.parametrize("arrow", [BEFORE, BEHIND])
def test_a_direction_in_the_axes_of_the_surface(arrow: Floats) -> None:
    """Before the surface and behind it."""
    towards = f"(normalize({written(arrow, 'vector<world>')}) as direction<world>)"
    found = of(f"on_axes({towards}, {AXES})", "M", "import std.reflectances.{on_axes}")
    assert found == close(np.stack([ALONG, ACROSS, NORMAL_IN_WORLD]) @ arrow)


@truth("std.reflectances.ashikhmin_shirley")
def test_the_back_of_a_varnished_surface_scatters_nothing() -> None:
    behind = POSITION_IN_WORLD - NORMAL_IN_WORLD + 0.3 * ALONG
    found = shown(
        "import std.reflectances\nimport std.lights.{Directional}\nrig R { lamp : Directional }\n"
        f"material M {{ color = ashikhmin_shirley({ALBEDO}, {TINT}, vec2(3, 9), {AXES}) }}",
        eye=lanes(behind),
        **{"lamp.direction": lanes(-BEFORE), "lamp.diffuse_color": lanes(MATT),
           "lamp.specular_color": (0.0, 0.0, 0.0)},
    )  # fmt: skip
    assert found == close((0, 0, 0))

"""Surfaces under the lights of `std.area_lights`: rays count those that hit the lights."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .kit import NORMAL_IN_WORLD, POSITION_IN_WORLD, TO_EYE, Floats, close, lanes, shown, unit
from .many import values
from .test_area_lights import (
    MODULE,
    Hits,
    arriving,
    as_expression,
    axes_around,
    mirrored,
    panel_hits,
    transform,
)
from .truth import truth

RIG = """
import std.area_lights
import std.lights.{Directional}
import std.terms.{lambert}
light Sun : Directional + Sizeless {}
rig R { panel : Rectangle, disc : Disc, ball : Sphere, tube : Tube, sun : Sun }
"""
SIDE, AHEAD = axes_around(NORMAL_IN_WORLD)[:2]
OVER = 0.8 * NORMAL_IN_WORLD
AXIS = unit(-OVER - 0.3 * SIDE + 0.2 * AHEAD)
ALONG = unit((0.3, 0.9, -0.2))
DARK = {f"{name}.{kind}_color": (0, 0, 0) for name in ("panel", "disc", "ball", "tube", "sun")
        for kind in ("diffuse", "specular")}  # fmt: skip
GIVEN: dict[str, Any] = {
    **DARK,
    "panel.place": lanes(POSITION_IN_WORLD + OVER + 0.4 * SIDE), "panel.axis": lanes(AXIS),
    "panel.along": lanes(ALONG), "panel.width": 1.5, "panel.height": 0.75,
    "disc.place": lanes(POSITION_IN_WORLD + OVER - 0.4 * SIDE), "disc.axis": lanes(AXIS),
    "disc.along": lanes(ALONG), "disc.radius": 0.75,
    "ball.place": lanes(POSITION_IN_WORLD + 0.25 * OVER + 0.75 * AHEAD), "ball.radius": 0.5,
    "tube.place": lanes(POSITION_IN_WORLD + OVER + 0.3 * SIDE), "tube.along": lanes(ALONG),
    "tube.size": 3.0, "tube.radius": 0.4,
    "sun.direction": lanes(AXIS),
}  # fmt: skip


def offset(name: str) -> Floats:
    return np.array(GIVEN[f"{name}.place"]) - POSITION_IN_WORLD


def flat_axes() -> tuple[Floats, Floats]:
    """The axis to which a flat light's width lies nearest, and the one at a right angle."""
    sideways = unit(ALONG - (ALONG @ AXIS) * AXIS)
    return sideways, np.cross(AXIS, sideways)


def ball_hits(arrows: Floats) -> Floats:
    """Those rays whose nearest point lies in the ball."""
    middle = offset("ball")
    along = arrows @ middle
    return np.asarray((along > 0) & (middle @ middle - along**2 < 0.5**2), np.float64)


def tube_hits(arrows: Floats) -> Floats:
    """Those rays that hit the flat rectangle which a tube seems to be."""
    middle = offset("tube")
    away = middle - (middle @ ALONG) * ALONG
    far = np.linalg.norm(away)
    half = 0.4 / np.sqrt(1 - (0.4 / far) ** 2)
    return panel_hits(False, middle, 1.5 * ALONG, half * unit(np.cross(ALONG, away)))(arrows)


def hits_of() -> dict[str, Hits]:
    side, up = flat_axes()
    return {
        "panel": panel_hits(False, offset("panel"), 0.75 * side, 0.375 * up),
        "disc": panel_hits(True, offset("disc"), 0.75 * side, 0.75 * up),
        "ball": ball_hits,
        "tube": tube_hits,
    }


@truth(
    "std.area_lights.AreaLight", "std.area_lights.FlatLight", "std.area_lights.Rectangle",
    "std.area_lights.Disc", "std.area_lights.Sphere", "std.area_lights.Tube",
)  # fmt: skip
def test_matt_surfaces_get_what_arrives() -> None:
    """A third of the lights in each colour: rays count those that hit."""
    wanted = {name: arriving(hits, NORMAL_IN_WORLD) for name, hits in hits_of().items()}
    assert all(each @ NORMAL_IN_WORLD > 0.04 for each in wanted.values())
    text = f"{RIG}material M {{ color = lambert(vec3(1)) }}"
    colors = {"panel.diffuse_color": (4, 0, 0), "disc.diffuse_color": (0, 2, 0),
              "ball.diffuse_color": (0, 0, 3)}  # fmt: skip
    found = shown(text, **{**GIVEN, **colors})
    cosines = [wanted[name] @ NORMAL_IN_WORLD for name in ("panel", "disc", "ball")]
    assert found == pytest.approx(np.multiply((4, 2, 3), cosines), abs=4e-3)
    found = shown(text, **{**GIVEN, "tube.diffuse_color": (1, 2, 0)})
    assert found[:2] == pytest.approx(wanted["tube"] @ NORMAL_IN_WORLD * np.array((1, 2)), abs=3e-3)


@truth(
    "std.area_lights.AreaLight", "std.area_lights.FlatLight", "std.area_lights.area_cook_torrance"
)
def test_flat_lights_shine_to_one_side() -> None:
    text = (
        f"{RIG}term sent() per light = light.diffuse\n"
        "material M { color = sent() + area_cook_torrance(rgb(1, 1, 1), 0.5) }"
    )
    behind = {f"panel.{kind}_color": (1, 1, 1) for kind in ("diffuse", "specular")}
    assert shown(text, **{**GIVEN, **behind}).min() > 0
    assert not shown(text, **{**GIVEN, **behind, "panel.axis": lanes(-AXIS)}).any()


@truth("std.area_lights.AreaLight", "std.area_lights.Sphere")
def test_a_ball_far_away_is_a_point() -> None:
    """Of which the square of its sine arrives, in both colours, times its strength."""
    text = (
        "import std.area_lights\nlight Half : Sphere { strength = 0.5 }\nrig R { ball : Half }\n"
        "term sent() per light = vec3(light.diffuse + 2 * light.specular)"
        " + 8 * vec3(light.to_light)\nmaterial M { color = sent() }"
    )
    way = 50 * unit(OVER + SIDE)
    found = shown(text, **{"ball.place": lanes(POSITION_IN_WORLD + way), "ball.radius": 4.0})
    assert found == pytest.approx(3 * 0.5 * (4 / 50) ** 2 + 8 * unit(way), rel=1e-4)


@truth("std.area_lights.Sphere", "std.area_lights.Tube")
def test_surfaces_inside_of_a_light() -> None:
    """Nearly all of what lies above is light."""
    for name in ("Sphere", "Tube"):
        text = (
            f"import std.area_lights\nimport std.terms.{{lambert}}\nrig R {{ lamp : {name} }}\n"
            "material M { color = lambert(vec3(1)) }"
        )
        place = POSITION_IN_WORLD + 0.1 * NORMAL_IN_WORLD
        found = shown(text, **{"lamp.place": lanes(place), "lamp.radius": 3.0})
        assert 0.9 < found[0] < 1.02


@truth("std.area_lights.Tube")
def test_a_tube_close_by_is_seen_wider_than_it_is() -> None:
    """Up to where rays touch it."""
    text = (
        "import std.area_lights\nimport std.terms.{lambert}\nrig R { lamp : Tube }\n"
        "material M { color = lambert(vec3(1)) }"
    )
    given = {"place": lanes(POSITION_IN_WORLD + NORMAL_IN_WORLD), "along": lanes(SIDE),
             "size": 2.0, "radius": 0.9}  # fmt: skip
    half = 0.9 / np.sqrt(1 - 0.9**2)
    hits = panel_hits(False, NORMAL_IN_WORLD, SIDE, half * AHEAD)
    wanted = arriving(hits, NORMAL_IN_WORLD) @ NORMAL_IN_WORLD
    found = shown(text, **{f"lamp.{name}": value for name, value in given.items()})
    assert found == pytest.approx([wanted] * 3, abs=2e-3)


@truth("std.area_lights.area_cook_torrance", "std.area_lights.AreaLight")
@pytest.mark.parametrize("name", ["panel", "ball"])
def test_highlights_have_the_shape_of_a_light(name: str) -> None:
    """The share that facets mirror, times the share of the highlight that the light covers."""
    axes = axes_around(NORMAL_IN_WORLD)
    light, weights = mirrored(0.9**2, axes @ TO_EYE)
    share = (hits_of()[name](light @ axes) * weights).sum() / weights.sum()
    text = f"{RIG}material M {{ color = area_cook_torrance(rgb(0.5, 0.25, 1), 0.9) }}"
    found = shown(text, **{**GIVEN, f"{name}.specular_color": (3, 2, 1)})
    table = values("std.microfacets", "ggx_share(nv, 0.81)", "vec2", nv=TO_EYE @ NORMAL_IN_WORLD)[0]
    f0 = np.array((0.5, 0.25, 1))
    wanted = np.array((3, 2, 1)) * (f0 * table[0] + table[1]) * share
    assert share > 0.02
    assert found == pytest.approx(wanted, rel=0.06)


@truth("std.area_lights.area_cook_torrance", "std.area_lights.Sizeless")
def test_lights_without_a_size_shine_as_ever() -> None:
    given = {**GIVEN, "sun.specular_color": (3, 2, 1)}
    for roughness in (0.5, 0.02):
        text = f"{RIG}material M {{ color = area_cook_torrance(rgb(0.5, 0.25, 1), {roughness}) }}"
        gloss = text.replace("area_cook_torrance", "cook_torrance")
        gloss = f"import std.reflectances.{{cook_torrance}}\n{gloss}"
        assert shown(text, **given) == close(shown(gloss, **given))


MIRRORED = 2 * (TO_EYE @ NORMAL_IN_WORLD) * NORMAL_IN_WORLD - TO_EYE
EDGE = unit(np.cross(MIRRORED, ALONG))


@truth("std.area_lights.area_cook_torrance")
@pytest.mark.parametrize("roughness", [0.0, 0.055, 0.065, 0.3])
def test_a_light_that_ends_near_the_mirrored_eye(roughness: float) -> None:
    """Nothing is smoother than what the transform holds; both colours are as strong as it says."""
    text = (
        "import std.area_lights\nlight Half : Rectangle { strength = 0.5 }\nrig R { lamp : Half }\n"
        f"material M {{ color = area_cook_torrance(rgb(1, 1, 1), {roughness}) }}"
    )
    place = MIRRORED + 0.497 * EDGE
    found = shown(
        text,
        **{"lamp.place": lanes(POSITION_IN_WORLD + place), "lamp.axis": lanes(-MIRRORED),
           "lamp.along": lanes(EDGE)},
    )  # fmt: skip
    panel = as_expression([place, 0.5 * EDGE, 0.5 * np.cross(MIRRORED, EDGE)])
    rough, width = max(roughness, 0.06), max(roughness, 0.045) ** 2
    covered = values(
        MODULE, f"mirrored_panel({panel}, n, e, {rough})", n=[NORMAL_IN_WORLD], e=[TO_EYE]
    )
    table = values(
        "std.microfacets", "ggx_share(nv, w)", "vec2", nv=TO_EYE @ NORMAL_IN_WORLD, w=width
    )
    assert 0.4 < covered[0] < 0.95
    assert found == pytest.approx([0.5 * table[0].sum() * covered[0]] * 3, rel=1e-4)


@truth("std.area_lights.area_cook_torrance", "std.area_lights.mirrored_panel")
def test_an_eye_behind_the_surface_sees_it_as_one_at_its_edge() -> None:
    """As bent normals may have it: the transform for a cosine of 0, turned towards the eye."""
    text = f"{RIG}material M {{ color = area_cook_torrance(rgb(0.5, 0.25, 1), 0.5) }}"
    behind = unit(TO_EYE - 1.3 * (TO_EYE @ NORMAL_IN_WORLD) * NORMAL_IN_WORLD)
    found = shown(
        text,
        **{**GIVEN, "panel.specular_color": (1, 1, 1), "eye": lanes(POSITION_IN_WORLD + behind)},
    )
    along = unit(behind - (behind @ NORMAL_IN_WORLD) * NORMAL_IN_WORLD)
    rows = np.stack([along, np.cross(NORMAL_IN_WORLD, along), NORMAL_IN_WORLD])
    side, up = flat_axes()
    turned = [
        transform(0.0, 0.5) @ rows @ each for each in (offset("panel"), 0.75 * side, 0.375 * up)
    ]
    covered = arriving(panel_hits(False, *turned), np.array((0.0, 0.0, 1.0)))[2]
    table = values("std.microfacets", "ggx_share(nv, 0.25)", "vec2", nv=0.0)[0]
    assert covered > 0.01
    assert found == pytest.approx(
        (np.array((0.5, 0.25, 1)) * table[0] + table[1]) * covered, rel=0.03
    )

"""The lights of the library at both ends of every range, and where pairs are equal or swapped."""

from __future__ import annotations

import math
import re
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.compiler.semantics.names.standard_library import files_of
from burnish.targets.runner.frames.scenery import in_a_row

from ..library.kit import Place
from ..semantics.kit import color
from .kit import Floats, drawn

LIBRARY = Path(burnish.__file__).parent / "stdlib"
PLAIN = Place((1.0, 1.0, 1.0, 1.0))
SIZES, CONES = (0.001, 1000.0), (0.0, math.radians(90))
FURTHER: dict[tuple[str, str], dict[str, tuple[float, float]]] = {
    ("Rectangle", "area_lights"): {"width": SIZES, "height": SIZES},
    ("Disc", "area_lights"): {"radius": SIZES},
    ("Sphere", "area_lights"): {"radius": SIZES},
    ("Tube", "area_lights"): {"size": SIZES, "radius": (0.001, 100.0)},
    ("PhotometricPoint", "photometry"): {"lumens": (0.0, 1e7)},
    ("PhotometricSpot", "photometry"): {"lumens": (0.0, 1e7), "inner": CONES, "outer": CONES},
    ("PhotometricSun", "photometry"): {"lux": (0.0, 1e6)},
    ("Projector", "projectors"): {
        "spread": (math.radians(1), math.radians(170)), "aspect": (0.01, 100.0),
    },
    ("Luminaire", "ies"): {"dimming": (0.0, 1000.0)},
    ("DirectionalLight", "mtlx.lights"): {"intensity": (0.0, 1e6)},
    ("PointLight", "mtlx.lights"): {"intensity": (0.0, 1e6), "decay_rate": (0.0, 16.0)},
    ("SpotLight", "mtlx.lights"): {"inner_angle": (-1.0, 1.0), "outer_angle": (-1.0, 1.0)},
}  # fmt: skip
"""Lights whose ranges are tried at all of their ends together, by their files."""
TESTED = {
    **{light: set(ranges) for (light, _), ranges in FURTHER.items()},
    "Spot": {"inner", "outer"},
    "FocusedSpot": {"peak", "focus"},
    "PunctualPoint": {"reach"},
    "PunctualSpot": {"inner", "outer"},
    "ShadowedSpot": {"nearest", "farthest", "bias", "spread"},
}
"""For each light, the parameters with a range whose ends are tried below."""


def test_every_range_of_a_light_is_tested() -> None:
    found: dict[str, set[str]] = {}
    for path in files_of(LIBRARY):
        for name, body in re.findall(r"^light (\w+)[^{]*\{(.*?)^\}", path.read_text(), re.M | re.S):
            ranges = set(re.findall(r"param (\w+)\s*: [^=\n]*\bin ", body))
            found |= {name: ranges} if ranges else {}
    assert found == TESTED


def arriving(light: str, module: str, turn: float, distance: float = 1.0, **values: float) -> float:
    """The light that a point gets that lies ``turn`` degrees from the axis of a lamp.

    It faces the lamp, which hangs in the origin and shines along -y.
    """
    away = np.array((math.sin(math.radians(turn)), -math.cos(math.radians(turn)), 0.0))
    text = (
        f"import std.{module}.{{{light}}}\nmaterial M {{ color = all_of() }}\n"
        f"term all_of() per light = light.diffuse\nrig R {{ lamp : {light} }}"
    )
    given: dict[str, Any] = {f"lamp.{name}": value for name, value in values.items()}
    given |= {"lamp.place": (0.0, 0.0, 0.0), "lamp.axis": (0.0, -1.0, 0.0)}
    found = color(text, {"vertex_position": tuple((distance * away).tolist()), **given})
    assert len(set(found)) == 1 and math.isfinite(found[0])
    return float(found[0])


SPOTS = (("Spot", "lights"), ("PunctualSpot", "gltf"))
TURNS = (0.5, 20.0, 44.9, 45.1, 70.0, 89.9, 90.1, 135.0, 180.0)


@pytest.mark.parametrize(("inner", "outer"), [*product((0, 45, 90), (0, 45, 90))])
@pytest.mark.parametrize(("light", "module"), SPOTS)
def test_a_spot_is_bright_inside_and_dark_outside(
    light: str, module: str, inner: int, outer: int
) -> None:
    """Whichever is larger: nothing outside of the outer cone, all inside of both, and a fall
    between them."""
    cones = {"inner": math.radians(inner), "outer": math.radians(outer)}
    before = 1.0
    for turn in TURNS:
        found = arriving(light, module, turn, **cones)
        if turn > outer:
            assert found == 0
        elif turn < min(inner, outer):
            assert found == pytest.approx(1)
        else:
            assert 0 < found < before
        before = found


@pytest.mark.parametrize("reach", [0.0, 1e-20, 1e-3, 2.0, 1e6])
def test_nothing_is_left_beyond_the_reach(reach: float) -> None:
    for distance in (5e-4, 1.0, 3.0, 100.0):
        share = (distance / reach) ** 4 if reach else 0.0
        expected = max(1 - share, 0) / distance**2
        found = arriving("PunctualPoint", "gltf", 30.0, distance, reach=reach)
        assert found == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(("peak", "focus"), [*product((0.0, 1e6), (1.0, 512.0))])
def test_a_focused_spot(peak: float, focus: float) -> None:
    for turn in TURNS:
        expected = peak * max(math.cos(math.radians(turn)), 0) ** focus / 4
        found = arriving("FocusedSpot", "lights", turn, 2.0, peak=peak, focus=focus)
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-300)


# --- shadows -------------------------------------------------------------------------------------

SHOW = """
import std.shadows.{ShadowedSpot}
material Ball { object_position = vertex_position * 0.4 }
material Ground { position = @vertex (inherited.position * vec3(5, 1, 5)) }
term all_of() per light = light.diffuse
rig Lamps { lamp : ShadowedSpot { SLOTS } }
pass Seen { target seen : rgba32f = vec4(position, all_of().x) }
frame Show {
    models scene
    models floor : Ground
    lit = Seen(scene)
    output picture = lit.seen
}
"""
LAMP = np.array((0.0, 2.0, 0.0))


def on_the_floor(slots: str, **values: float) -> tuple[Floats, Floats]:
    """The places that are seen below a lamp that shines straight down, and the light at each."""
    scenery = in_a_row(["Ball", "Ground"], {"floor": ["Ground"]}, "sphere")
    given = {"lamp.place": LAMP, "lamp.axis": (0.0, -1.0, 0.0)}
    given |= {f"lamp.{name}": value for name, value in values.items()}
    picture = drawn(SHOW.replace("SLOTS", slots), scenery, 64, given).reshape(-1, 4)
    floor = picture[np.abs(picture[:, 1] + 1) < 1e-6]
    return floor[:, :3], floor[:, 3]


def radii(places: Floats) -> Floats:
    """The distance of each place on the floor from the point below the lamp."""
    return np.asarray(np.linalg.norm(places[:, [0, 2]], axis=1))


ENDS = (
    {"outer": math.radians(40), "inner": math.radians(38)}, {"outer": math.radians(88)},
    {"outer": math.radians(90)}, {"outer": math.radians(90), "inner": math.radians(90)},
    {"nearest": 0.001}, {"nearest": 1.5}, {"farthest": 1e4}, {"nearest": 0.001, "farthest": 1e4},
    {"bias": 0.001}, {"bias": 0.1}, {"spread": 0.0},
)  # fmt: skip


@pytest.mark.parametrize("values", ENDS, ids=str)
def test_a_ball_throws_its_shadow(values: dict[str, float]) -> None:
    """The ball, of radius 0.4, hangs 2 below the lamp and 1 above the floor."""
    places, lit = on_the_floor("", **{"spread": 1.0, **values})
    # Its shadow has the radius 3 * tan(asin(0.4 / 2)) = 0.612.
    hidden, free = radii(places) < 0.4, (radii(places) > 0.9) & (radii(places) < 1.0)
    assert hidden.sum() > 20 and free.sum() > 20
    assert lit[hidden].max() == 0
    assert lit[free].min() > 0.1


@pytest.mark.parametrize(
    "values", [{"nearest": 1e4}, {"farthest": 0.001}, {"nearest": 1.0, "farthest": 0.5}], ids=str
)
def test_what_lies_outside_of_the_depths_throws_no_shadow(values: dict[str, float]) -> None:
    places, lit = on_the_floor("resolution = 64", **values)
    assert lit[radii(places) < 1].min() > 0.9


def test_a_wide_filter_blurs_a_shadow_and_no_more() -> None:
    places, lit = on_the_floor("resolution = 256", outer=math.radians(40), spread=8.0)
    assert lit[radii(places) < 0.3].max() < 0.3
    assert lit[(radii(places) > 1.3) & (radii(places) < 1.4)].min() > 0.1


@pytest.mark.parametrize(("light", "module"), FURTHER)
def test_light_is_a_number_at_the_ends_of_all_ranges(light: str, module: str) -> None:
    """Below the lamp, beside it, above it, and so near that a large lamp has the point inside."""
    text = (
        f"import std.{module}.{{{light}}}\nimport std.terms.{{lambert}}\n"
        f"material M {{ color = lambert(vec3(1)) }}\nrig R {{ lamp : {light} }}"
    )
    ranges = FURTHER[light, module]
    for ends in product(*ranges.values()):
        given: dict[str, Any] = {
            f"lamp.{name}": end for name, end in zip(ranges, ends, strict=True)
        }
        given |= {"lamp.place": (0.0, 2.0, 0.0), "lamp.slide": PLAIN, "lamp.profile": PLAIN}
        for place in ((0.0, 0.0, 0.0), (3.0, 1.0, -1.0), (0.5, 5.0, 0.5), (0.1, 1.9, 0.0)):
            found = color(
                text, {"vertex_position": place, "vertex_normal": (0.0, 1.0, 0.0), **given}
            )
            assert all(math.isfinite(lane) and lane >= 0 for lane in found), (ends, place)

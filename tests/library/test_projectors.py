"""The light of `std.projectors`, against the place of a point in a picture."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .kit import (
    NORMAL_IN_WORLD,
    POSITION_IN_WORLD,
    Floats,
    Place,
    close,
    columns,
    lanes,
    shown,
    unit,
)
from .truth import truth

TEXT = """
import std.projectors.{Projector}
import std.terms.{lambert, phong}
material M { color = lambert(vec3(1)) + phong(vec3(1), 4) }
rig R { lamp : Projector }
"""
LAMP = POSITION_IN_WORLD + np.array((0.4, 2.0, 0.8))
DARK = (0.0, 0.0, 0.0)


def lit(axis: Floats, read: Place, /, **given: Any) -> Floats:
    named = {f"lamp.{name}": value for name, value in given.items()}
    return shown(TEXT, **{"lamp.place": lanes(LAMP), "lamp.axis": lanes(axis), "lamp.slide": read,
                          "lamp.specular_color": DARK, **named})  # fmt: skip


def thrown(x: float, y: float, spread: float, aspect: float, upwards: Floats) -> Floats:
    """The axis of a lamp that throws a place of its picture, from -1 to 1, to the surface."""
    half = math.tan(spread / 2)
    wanted = unit(POSITION_IN_WORLD - LAMP)
    axis = unit(wanted + 0.1)
    for _ in range(60):  # Turned until the picture's place is the surface.
        right = unit(np.cross(axis, upwards))
        above = np.cross(right, axis)
        ray = unit(axis + half * x * right + half / aspect * y * above)
        turn = np.cross(ray, wanted)
        axis = unit(axis + np.cross(turn, axis))
    return axis


@truth("std.projectors.Projector")
@pytest.mark.parametrize(("x", "y"), [(0.0, 0.0), (0.6, 0.3), (-0.7, 0.5), (0.2, -0.9)])
def test_a_picture_is_thrown_upright(x: float, y: float) -> None:
    spread, aspect, upwards = math.radians(50), 1.6, unit((0.2, 0.5, -1.0))
    axis = thrown(x, y, spread, aspect, upwards)
    read = Place((0.2, 0.4, 0.8, 1))
    found = lit(axis, read, spread=spread, aspect=aspect, upwards=lanes(upwards),
                diffuse_color=(3, 2, 1))  # fmt: skip
    assert read.at == pytest.approx((0.5 + x / 2, 0.5 - y / 2), abs=1e-6)
    cosine = NORMAL_IN_WORLD @ unit(LAMP - POSITION_IN_WORLD)
    assert found == close(np.multiply((0.6, 0.8, 0.8), cosine))


@truth("std.projectors.Projector")
@pytest.mark.parametrize(("x", "y"), [(1.01, 0), (-1.01, 0.2), (0.3, 1.01), (0, -1.01)])
def test_nothing_is_lit_beside_the_picture(x: float, y: float) -> None:
    upwards = unit((0.2, 0.5, -1.0))
    axis = thrown(x, y, 1.0, 1.6, upwards)
    found = lit(axis, Place((1, 1, 1, 1)), spread=1.0, aspect=1.6, upwards=lanes(upwards))
    assert not found.any()


def at_origin(place: tuple[float, ...], spread: float) -> Floats:
    """The light at the origin, of a lamp that shines along -z."""
    given = {f"lamp.{name}": value for name, value in (
        ("place", place), ("axis", (0.0, 0.0, -1.0)), ("spread", spread),
        ("slide", Place((1, 1, 1, 1))),
    )}  # fmt: skip
    text = TEXT.replace("lambert(vec3(1)) + phong(vec3(1), 4)", "sent()").replace(
        "material", "term sent() per light = light.diffuse\nmaterial"
    )
    mesh = {"vertex_position": (0.0, 0.0, 0.0), "object_to_world": columns(np.eye(4))}
    return shown(text, **mesh, **given)


@truth("std.projectors.Projector")
def test_a_picture_has_an_edge_and_the_lamp_a_front() -> None:
    """Near the lamp too; the edge itself is dark, and so are the plane of the lamp and what lies
    behind it.
    """
    edge = math.tan(0.4)
    for x, z, arrives in (
        (0.99 * edge, 1.0, 1), (edge, 1.0, 0), (0.0, 0.25, 1), (0.0, -0.25, 0), (0.25, 0.0, 0),
    ):  # fmt: skip
        assert at_origin((x, 0.0, z), 0.8) == close([arrives] * 3)


@truth("std.projectors.Projector")
def test_highlights_show_the_picture() -> None:
    axis = unit(POSITION_IN_WORLD - LAMP)
    dark, lit_by = (
        lit(axis, Place((r, 0.5, 1, 1)), diffuse_color=DARK, specular_color=(1, 1, 1))
        for r in (0.25, 1.0)
    )
    assert lit_by[0] > 0.01
    assert dark == close(lit_by * (0.25, 1, 1))

"""The library's lights of glTF, against the formulas of the extension `KHR_lights_punctual`."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .kit import Floats, close, columns, shown
from .test_gltf import middle, reflected
from .truth import truth


def at_origin(light: str, color: str, **values: Any) -> Floats:
    """A colour at the origin, under one light; ``light_arriving()`` is what arrives of it."""
    text = (
        f"import std.gltf.{{{light}, MetallicRoughness}}\nterm light_arriving() per light ="
        f" light.diffuse\nmaterial M {{ color = {color} }}\nrig R {{ lamp : {light} }}"
    )
    named = {f"lamp.{name}": value for name, value in values.items()}
    place = {"vertex_position": (0.0, 0.0, 0.0), "object_to_world": columns(np.eye(4))}
    return shown(text, **place, **named)


@truth("std.gltf.PunctualPoint")
def test_light_fades_with_the_square_of_the_distance() -> None:
    near, far = (
        middle("PunctualPoint", lamp_place=(0, 0, distance), lamp_diffuse_color=(8, 8, 8))[0]
        for distance in (1, 2)
    )
    assert near == pytest.approx(8 * reflected(1, 1, 1, 0), rel=1e-4)
    assert far == pytest.approx(near / 4, rel=1e-4)
    ending = middle("PunctualPoint", lamp_place=(0, 0, 2), lamp_diffuse_color=(8, 8, 8),
                    lamp_reach=4)  # fmt: skip
    assert ending[0] == pytest.approx(far * (1 - 0.5**4), rel=1e-4)
    beyond = middle("PunctualPoint", lamp_place=(0, 0, 5), lamp_reach=4)
    assert beyond[0] == 0


@truth("std.gltf.PunctualSpot")
@pytest.mark.parametrize(
    ("degrees", "share"),
    [(0, 1), (20, 1), (40, 0.5), (60, 0), (175, 0)],
)
def test_a_cone_fades_between_two_angles(degrees: float, share: float) -> None:
    """In the middle between both cosines, the square of one half is left."""
    inner, outer = math.radians(20), math.radians(60)
    axis = math.radians(degrees)
    if share == 0.5:
        axis = math.acos((math.cos(inner) + math.cos(outer)) / 2)
    found = middle(
        "PunctualSpot", lamp_place=(0, 0, 2), lamp_diffuse_color=(4, 4, 4), lamp_inner=inner,
        lamp_outer=outer, lamp_axis=(math.sin(axis), 0, -math.cos(axis)),
    )  # fmt: skip
    assert found[0] == pytest.approx(reflected(1, 1, 1, 0) * share**2, rel=1e-4, abs=1e-6)


@truth("std.gltf.PunctualPoint")
def test_no_reach_is_shorter_than_what_a_float_can_square() -> None:
    """Its square is 1e-30 at least: a shorter one counts as 1e-15."""
    away = 5e-16
    found = at_origin("PunctualPoint", "light_arriving()", place=(0.0, 0.0, away), reach=1e-16)
    assert found == close([(1 - 0.25**2) / away**2] * 3)


@truth("std.gltf.PunctualSpot")
@pytest.mark.parametrize("inner", [30.0, 60.0])
def test_the_edge_of_a_cone_is_hard_if_the_inner_one_is_not_smaller(inner: float) -> None:
    """It is as wide as a millionth, in the cosine, so that nothing is divided by zero."""
    outer = math.cos(math.radians(30))
    for cosine, share in ((0.9, 1.0), (outer + 5e-7, 0.5), (outer - 1e-9, 0.0), (0.8, 0.0)):
        found = at_origin(
            "PunctualSpot", "light_arriving()", place=(0.0, 0.0, 1.0),
            axis=(math.sqrt(1 - cosine**2), 0.0, -cosine), inner=math.radians(inner),
            outer=math.radians(30),
        )  # fmt: skip
        assert found == pytest.approx([share**2] * 3, rel=1e-6, abs=1e-12)


@truth("std.gltf.PunctualPoint")
def test_a_short_reach_ends() -> None:
    whole = middle("PunctualPoint", lamp_place=(0, 0, 0.25))[0]
    ending = middle("PunctualPoint", lamp_place=(0, 0, 0.25), lamp_reach=0.5)[0]
    assert ending == pytest.approx(whole * (1 - 0.5**4), rel=1e-4)

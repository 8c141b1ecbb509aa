"""The lights of ``std.mtlx.lights``, against the formulas in MaterialX's own GLSL of them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .kit import Floats, columns, shown
from .truth import truth

COLOR = np.array([0.8, 0.5, 0.2])


def arriving(light: str, **values: Any) -> Floats:
    """What arrives at the origin. Both parts of it, diffuse and specular, are alike."""
    found = []
    for slot in ("diffuse", "specular"):
        text = (
            f"import std.mtlx.lights.{{{light}}}\nterm arriving() per light = light.{slot}\n"
            f"material M {{ color = arriving() }}\nrig R {{ lamp : {light} }}"
        )
        named = {f"lamp.{name}": value for name, value in values.items()}
        place = {"vertex_position": (0.0, 0.0, 0.0), "object_to_world": columns(np.eye(4))}
        lanes = shown(text, **place, **named, **{"lamp.diffuse_color": tuple(COLOR)})[:3]
        found.append(np.array([np.ravel(lane)[0] for lane in lanes]))
    np.testing.assert_array_equal(found[0], found[1])
    return found[0]


@truth("std.mtlx.lights.DirectionalLight")
def test_a_light_from_one_direction() -> None:
    found = arriving("DirectionalLight", direction=(0, -1, 0), intensity=1.5)
    np.testing.assert_allclose(found, 1.5 * COLOR / math.pi, rtol=1e-6)


@truth("std.mtlx.lights.PointLight")
@pytest.mark.parametrize("decay", [0.0, 1.0, 2.0, 3.5])
def test_light_decays_with_a_power_of_the_distance_and_one(decay: float) -> None:
    place = (1.0, 2.0, 2.0)
    found = arriving("PointLight", place=place, intensity=5.0, decay_rate=decay)
    np.testing.assert_allclose(found, 5 * COLOR / math.pi / 4**decay, rtol=1e-6)


@truth("std.mtlx.lights.SpotLight")
@pytest.mark.parametrize(
    ("inner", "outer", "share"),
    [(0.9, 0.7, 0.5), (0.8, 0.6, 1), (0.95, 0.85, 0), (0.75, 0.9, 1), (0.85, 0.9, 0)],
)
def test_a_cone_fades_between_two_cosines(inner: float, outer: float, share: float) -> None:
    """The cosine is 0.8. With an inner angle that is the wider one, the edge is hard."""
    found = arriving(
        "SpotLight", place=(0.0, 1.0, 0.0), axis=(0.6, -0.8, 0.0), intensity=4.0, decay_rate=1.0,
        inner_angle=inner, outer_angle=outer,
    )  # fmt: skip
    np.testing.assert_allclose(found, share * 4 * COLOR / math.pi / 2, rtol=1e-6, atol=1e-9)


@truth("std.mtlx.lights.SpotLight")
def test_nothing_shines_behind_a_cone() -> None:
    found = arriving(
        "SpotLight", place=(0.0, 1.0, 0.0), axis=(0.6, 0.8, 0.0), inner_angle=0.75, outer_angle=0.7
    )
    np.testing.assert_array_equal(found, 0)

"""The lamp of `std.ies`: where it reads its profile, and what arrives."""

from __future__ import annotations

import numpy as np
import pytest

from .kit import NORMAL_IN_WORLD, POSITION_IN_WORLD, Place, close, lanes, shown, unit
from .truth import truth

TEXT = """
import std.ies.{Luminaire}
import std.terms.{lambert}
material M { color = lambert(vec3(1)) }
rig R { lamp : Luminaire }
"""
AXIS = unit((0.2, -0.9, 0.3))
FRONT = unit((0.9, 0.1, -0.3))


@truth("std.ies.Luminaire")
@pytest.mark.parametrize(
    ("vertical", "horizontal"),
    [(20.0, 10.0), (35.0, 100.0), (30.0, 200.0), (15.0, 300.0), (5.0, 355.0), (160.0, 40.0)],
)
def test_a_lamp_sends_what_its_profile_says(vertical: float, horizontal: float) -> None:
    """Angles from the axis, and around it from the front, counter-clockwise as seen from above;
    beyond a right angle the lamp is turned over, so that the surface is lit.
    """
    axis = AXIS if vertical < 90 else -AXIS
    forward = unit(FRONT - (FRONT @ axis) * axis)
    aside = np.cross(-axis, forward)
    up, turn = np.radians(vertical), np.radians(horizontal)
    way = np.cos(up) * axis + np.sin(up) * (np.cos(turn) * forward + np.sin(turn) * aside)
    read = Place((450.0, 0, 0, 1), size=(73, 37))
    found = shown(
        TEXT,
        **{"lamp.place": lanes(POSITION_IN_WORLD - 2 * way), "lamp.axis": lanes(axis),
           "lamp.front": lanes(FRONT), "lamp.profile": read, "lamp.diffuse_color": (3, 2, 1),
           "lamp.dimming": 0.5, "lamp.reach": 4.0},
    )  # fmt: skip
    column, row = 72 * horizontal / 360, 36 * vertical / 180
    assert read.at == pytest.approx(((column + 0.5) / 73, (row + 0.5) / 37), abs=1e-6)
    assert read.level == (0,)
    cosine = max(NORMAL_IN_WORLD @ -way, 0)
    assert cosine > 0.1
    nits = 0.5 * 450 / 4 * (1 - 0.5**4) ** 2 * cosine / np.pi
    assert found == close(np.multiply((3, 2, 1), nits))

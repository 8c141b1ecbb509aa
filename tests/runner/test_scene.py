"""Where a scene puts lights, and how meshes are ordered for blending."""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.targets.runner.meshes import MESHES, farthest_first, mesh
from burnish.targets.runner.scene import Scene

LAMPS = """
import std.lights.{Directional, Point}
import std.terms.{lambert}
material Wall { color = lambert(vec3(1)) }
rig Hall { sun : Directional  lamps : Point[<= 5]  pair : Point[2] }
"""


@pytest.mark.parametrize(("wanted", "count"), [(0, 0), (3, 3), (64, 5)])
def test_every_light_has_a_place(wanted: int, count: int) -> None:
    """Also those beyond the number that shines, so that this can be raised afterwards."""
    (material,) = burnish.compile(LAMPS).materials
    instance = material.instance()
    Scene(light_count=wanted).apply(instance, 1.0)
    assert instance.missing == ()
    assert instance.get("lamps.count") == count
    instance.set("lamps.count", 5)
    assert instance.missing == ()
    lamps = [lamp["place"] for name in ("lamps", "pair") for lamp in instance.get(name)]
    assert len(set(lamps)) == 7, "no two stand in one place"


@pytest.mark.parametrize("name", MESHES)
def test_farthest_first(name: str) -> None:
    eye = np.array([1.0, 2.0, 3.0])
    before, after = mesh(name), farthest_first(mesh(name), tuple(eye))
    middles = after.channels["position"][after.triangles].mean(axis=1)
    distances = np.linalg.norm(middles - eye, axis=1)
    assert (np.diff(distances) <= 1e-12).all()
    assert sorted(map(tuple, before.triangles)) == sorted(map(tuple, after.triangles))

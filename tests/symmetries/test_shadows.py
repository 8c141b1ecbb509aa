"""Shadows are where a ball hides the sun, by geometry, whichever map they are read from.

The ball, whose radius is 0.4, floats over a floor, 1 above it. The pictures here have the place of
each point that is seen, and the share of the sun that arrives there.
"""

from __future__ import annotations

import numpy as np
import pytest

from burnish.targets.runner.frames.scenery import in_a_row

from .kit import Floats, drawn

HEAD = """
import std.lights.{Directional}
import std.shadows.{DepthOnly, cascade, first_to_show, seen_by_sun, share_lit}
material Ball { object_position = vertex_position * 0.4 }
material Ground {
    position = @vertex (inherited.position * vec3(5, 1, 5))
}
rig Sky { sun : Directional }
"""
FRAME = """
frame Show {
    param camera : transform<world, clip>
    models scene
    models floor : Ground
    from_sun = %s
    shadow   = %s
    lit      = Seen(scene) with { shadow = shadow.depth, from_sun = from_sun }
    output picture = lit.seen
}
pass Seen {
    map shadow : %s
    param from_sun : %s
    target seen : rgba32f = vec4(position, %s)
}
"""
CASCADES = HEAD + FRAME % (
    "[" + ", ".join(f"cascade(camera, sun.direction, {i}, 4, 20)" for i in range(4)) + "]",
    "each i in 0..4 : DepthOnly(scene, 128) with { view_projection = from_sun[i], eye = vec3(0) }",
    "depth2d_array",
    "transform<world, clip>[4]  layer = first_to_show(from_sun, position)",
    "share_lit(shadow, layer, from_sun[layer], position, 0.004, 0)",
)
ONE_MAP = HEAD + FRAME % (
    "seen_by_sun(sun.direction, vec3(0), 8, 20)",
    "DepthOnly(scene, 512) with { view_projection = from_sun, eye = vec3(0) }",
    "depth2d",
    "transform<world, clip>",
    "share_lit(shadow, from_sun, position, 0.002, 0)",
)
SUNS = {
    "with the view": (0.0, -0.6, -0.8),
    "against the view": (0.0, -0.96, 0.28),
    "from aside": (0.8, -0.6, 0.0),
    "from above": (0.0, -1.0, 0.0),
}


def arriving(text: str, sun: tuple[float, ...]) -> tuple[Floats, Floats]:
    """The places on the floor that are seen, and the share of the sun that arrives at each."""
    scenery = in_a_row(["Ball", "Ground"], {"floor": ["Ground"]}, "sphere")
    picture = drawn(text, scenery, 96, {"sun.direction": sun}).reshape(-1, 4)
    floor = picture[np.abs(picture[:, 1] + 1) < 1e-6]
    assert len(floor) > 1000
    return floor[:, :3], floor[:, 3]


def passed_at(places: Floats, sun: tuple[float, ...]) -> Floats:
    """The distance of the ball's middle from the ray that leads from each place to the sun."""
    return np.asarray(np.linalg.norm(np.cross(places, sun), axis=1))


@pytest.mark.parametrize("sun", SUNS.values(), ids=SUNS)
@pytest.mark.parametrize("text", [CASCADES, ONE_MAP], ids=["cascades", "one map"])
def test_a_place_is_in_shadow_if_the_ball_hides_the_sun(text: str, sun: tuple[float, ...]) -> None:
    """One map shows a part of the floor: what lies beside it is lit, too."""
    places, lit = arriving(text, sun)
    distance = passed_at(places, sun)
    # The triangles of the ball, the texels and the bias move the edge of the shadow.
    hidden, free = distance < 0.3, distance > 0.5
    assert hidden.sum() > 20
    assert lit[hidden].max() == 0 and lit[free].min() == 1


def test_the_edge_of_a_map_is_not_repeated_beside_it() -> None:
    """The map shows no more than the middle of the ball."""
    sun = SUNS["from above"]
    places, lit = arriving(ONE_MAP.replace("vec3(0), 8", "vec3(0), 0.2"), sun)
    aside = np.abs(places[:, [0, 2]]).max(axis=1)
    assert lit[aside > 0.21].min() == 1 and lit[aside < 0.19].max() == 0

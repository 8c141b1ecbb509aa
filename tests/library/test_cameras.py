"""Cameras, pictures over the whole screen, and places in them, against what specifications say."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from burnish.compiler.ir.stages import CLIP_POSITION, TARGET

from ..semantics.kit import at, shader
from .kit import CLIP, MESH, Floats, close, columns, matrix, of, unit, written
from .truth import truth

IMPORTS = """
import std.frames.{seen_from, through_face, face_direction, face_ray, shown_at, shown_in}
"""

FACES: dict[str, tuple[int, Callable[[float, float, float], tuple[float, float, float]]]] = {
    "+x": (0, lambda x, y, z: (-z, -y, x)),
    "-x": (1, lambda x, y, z: (z, -y, -x)),
    "+y": (2, lambda x, y, z: (x, z, y)),
    "-y": (3, lambda x, y, z: (x, -z, -y)),
    "+z": (4, lambda x, y, z: (x, -y, z)),
    "-z": (5, lambda x, y, z: (-x, -y, -z)),
}
"""For each face of a cube its number, and the numbers s, t and r of a direction: Vulkan, "Cube Map
Face Selection and Transformations". The direction meets the face at s / r and t / r, from -1 at the
left, and at the top, to 1."""


def projected(camera: Floats, place: Floats) -> Floats:
    """The place in a camera's picture: from -1 to 1, upwards, and the depth."""
    clip = camera @ (*place, 1.0)
    assert clip[3] > 0
    return np.asarray(clip[:3] / clip[3])


@truth("std.frames.seen_from")
@pytest.mark.parametrize(
    "axis", [(0.3, -0.4, 0.8), (0.1, 2.0, -0.2), (0.0, -1.0, 0.0), (0.0, 0.5, 0.0)]
)
def test_a_lamp_sees_as_far_to_each_side_as_its_angle_says(axis: tuple[float, ...]) -> None:
    place, near, far, angle = np.array([0.5, 1.0, -2.0]), 0.25, 8.0, math.radians(35)
    camera = matrix(
        f"seen_from({written(place)}, {written(axis, 'vector<world>')}, 35deg, {near}, {far})",
        IMPORTS,
    )
    ahead = unit(axis)
    assert projected(camera, place + near * ahead) == close((0, 0, 0))
    assert projected(camera, place + far * ahead) == close((0, 0, 1))
    across = unit(np.cross(ahead, (0.2, 0.3, 0.9)))
    for turn in np.linspace(0, 2 * math.pi, 9):
        side = across * math.cos(turn) + np.cross(ahead, across) * math.sin(turn)
        x, y, _depth = projected(camera, place + 3 * (ahead + math.tan(angle) * side))
        assert math.hypot(x, y) == pytest.approx(1)


@truth("std.frames.seen_from")
@pytest.mark.parametrize(
    ("axis", "up"),
    [
        ((0.3, -0.4, 0.8), (0, 1, 0)), ((1.0, 1.6, -0.6), (0, 1, 0)),
        ((math.sqrt(0.19), 0.9, 0.0), (0, 1, 0)), ((0.3, -2.0, 0.4), (0, 0, 1)),
    ],
)  # fmt: skip
def test_up_is_y_unless_a_lamp_looks_almost_along_it(
    axis: tuple[float, ...], up: tuple[float, ...]
) -> None:
    place, ahead = np.array([0.5, 1.0, -2.0]), unit(axis)
    camera = matrix(
        f"seen_from({written(place)}, {written(axis, 'vector<world>')}, 45deg, 1, 9)", IMPORTS
    )
    above = unit(np.array(up) - (np.array(up) @ ahead) * ahead)
    assert projected(camera, place + 3 * (ahead + 0.5 * above))[:2] == close((0, 0.5))
    assert projected(camera, place + 3 * (ahead + 0.5 * np.cross(ahead, above)))[0] > 0.49


@truth("std.frames.through_face", "std.frames.face_direction")
@pytest.mark.parametrize("face", FACES)
def test_a_camera_sees_what_belongs_into_its_face(face: str) -> None:
    number, lanes = FACES[face]
    place, near, far = np.array([0.5, 1.0, -2.0]), 0.5, 16.0
    camera = matrix(f"through_face({number}, {written(place)}, {near}, {far})", IMPORTS)
    ahead = of(f"face_direction({number})", "M", IMPORTS)
    assert lanes(*ahead) == close((0, 0, 1))
    chance = np.random.default_rng(number)
    for away in (near, 3.0, far):
        arrow = np.cross(ahead, chance.uniform(-0.9, 0.9, 3)) + ahead
        s, t, r = lanes(*arrow)
        x, y, depth = projected(camera, place + away * arrow)
        assert (x, y) == close((s / r, -t / r))
        assert depth == close(far / (far - near) * (1 - near / away))


@truth("std.frames.face_ray")
@pytest.mark.parametrize("face", FACES)
def test_a_point_of_a_face_lies_in_the_direction_that_reads_it(face: str) -> None:
    number, lanes = FACES[face]
    for u, v in ((0.5, 0.5), (0.1, 0.3), (0.9, 0.25), (0.0, 1.0)):
        s, t, r = lanes(*of(f"face_ray({number}, vec2({u}, {v}))", "M", IMPORTS))
        assert r > 0
        assert (0.5 * (s / r + 1), 0.5 * (t / r + 1)) == close((u, v))


@truth("std.frames.shown_at", "std.frames.shown_in")
def test_a_place_in_a_picture_and_back() -> None:
    """Along the inverse of the matrix, which NumPy computes."""
    place = np.array([0.2, -0.5, 0.4])
    x, y, depth = projected(CLIP, place)
    seen = np.array([0.5 + 0.5 * x, 0.5 - 0.5 * y, depth])
    given = {"view_projection": columns(CLIP)}
    found = of(f"shown_in(view_projection, {written(place)})", "M", IMPORTS, **given)
    assert found == close(seen)
    u, v, _ = map(float, seen)
    back = of(f"shown_at(view_projection, vec2({u!r}, {v!r}), {float(depth)!r})", "M", IMPORTS,
              **given)  # fmt: skip
    assert back == close(place)


@truth("std.frames.FullScreen")
@pytest.mark.parametrize(
    ("vertex", "place", "uv"),
    [(0, (-1, -1), (0, 1)), (1, (3, -1), (2, 1)), (2, (-1, 3), (0, -1))],
)
def test_one_triangle_covers_the_screen(
    vertex: int, place: tuple[float, ...], uv: tuple[float, ...]
) -> None:
    """Clip space has its y upwards, and ``uv`` begins at the top left."""
    whole = shader(
        "import std.frames.{FullScreen}\n"
        "pass P : FullScreen { target t : rgba32f = vec4(uv, 0, 1) }\nmaterial M {}", pass_="P",
    )  # fmt: skip
    given = {**MESH, "vertex_index": (vertex,)}
    assert at(whole, whole.results_of(CLIP_POSITION)[0].value, given) == close((*place, 0, 1))
    (target,) = whole.results_of(TARGET)
    assert at(whole, target.value, given)[:2] == close(uv)
    depth = whole.render_state.depth
    assert (depth.compare, depth.write) == ("always", False)  # Nothing hides it, and it nothing.


@truth("std.frames.Unwrapped")
def test_a_model_lies_at_its_texture_coordinate() -> None:
    whole = shader(
        "import std.frames.{Unwrapped}\n"
        "pass P : Unwrapped { target t : rgba32f = vec4(color, 1) }\nmaterial M {}", pass_="P",
    )  # fmt: skip
    found = at(whole, whole.results_of(CLIP_POSITION)[0].value, MESH)
    # The texel at (0.3, 0.8) is to the left and below the middle.
    assert found == close((-0.4, -0.6, 0.5, 1))

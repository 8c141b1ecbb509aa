"""Coordinates, normals of maps and projections, against formulas that NumPy computes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .calls import Picture, Quad, called, directions, scattered
from .kit import Floats
from .truth import truth

ALL = "import std.mapping"
COUNT = 80
UV = scattered(COUNT, 2, 2)
D = directions(COUNT)
AXES = np.concatenate([np.eye(3), -np.eye(3)])


def near(expected: Any, within: float = 1e-9) -> Any:
    return pytest.approx(np.asarray(expected, np.float64), abs=within)


def unit_rows(v: Any) -> Floats:
    return np.asarray(v / np.linalg.norm(v, axis=-1, keepdims=True))


# --- coordinates in the plane --------------------------------------------------------------------


@truth("std.mapping.rotated_uv", "std.mapping.scaled_uv", "std.mapping.polar_uv")
def test_coordinates_turn_grow_and_go_around() -> None:
    center = np.array([0.3, 0.8])
    at = (UV - center) @ (1, 1j)
    expected = at * np.exp(1j * math.radians(25))
    found = called(ALL, "rotated_uv(p, vec2(0.3, 0.8), 25deg)", 2, p=UV)
    assert found == near(np.stack([expected.real, expected.imag], axis=1) + center)
    found = called(ALL, "scaled_uv(p, vec2(0.3, 0.8), vec2(2, 4))", 2, p=UV)
    assert found == near(center + (UV - center) / (2, 4))
    found = called(ALL, "polar_uv(p, vec2(0.3, 0.8))", 2, p=UV)
    expected = np.stack([np.angle(at) % (2 * np.pi) / (2 * np.pi), np.abs(at)], axis=1)
    assert found == near(expected)


@truth("std.mapping.flipbook_uv")
@pytest.mark.parametrize(
    ("frame", "column", "row"),
    [(0, 0, 0), (3, 3, 0), (4, 0, 1), (11, 3, 2), (12, 0, 0), (-1, 3, 2)],
)
def test_frames_follow_each_other(frame: int, column: int, row: int) -> None:
    found = called(ALL, f"flipbook_uv(p, 4, 3, {frame})", 2, p=UV)
    assert found == near(np.add(UV, (column, row)) / (4, 3))


@truth("std.mapping.texel_center")
def test_texels_have_middles() -> None:
    found = called(ALL, "texel_center(p, vec2(8, 4))", 2, p=UV)
    texels = found * (8, 4) - 0.5
    assert texels == near(np.round(texels))
    assert (np.abs(found - UV) <= np.array([0.5 / 8, 0.5 / 4]) + 1e-12).all()


@truth("std.mapping.crisp_uv")
def test_texels_have_hard_edges() -> None:
    """The mean over a pixel of coordinates that jump between the middles of texels."""
    x = np.array([1.0, 1.1, 1.45, 1.5, 1.8, 1.95, 2.0, 2.05, 2.1, 2.5])
    width = 0.2
    samples = x[:, None] + width * ((np.arange(4000) + 0.5) / 4000 - 0.5)
    expected = np.stack([(np.floor(samples) + 0.5).mean(axis=1) / 8, 0.5 + 0 * x], axis=1)
    places = np.stack([x / 8, 0.5 + 0 * x], axis=1)
    found = called(ALL, "crisp_uv(p, vec2(8, 1), vec2(0.2, 1))", 2, p=places)
    assert found == near(expected, 1e-3)
    # Without a width, pixels see the middles of texels alone.
    found = called(ALL, "crisp_uv(p, vec2(8, 1), vec2(0))", 2, p=places)
    inside = np.abs(x - np.round(x)) > 1e-3
    assert found[inside, 0] == near((np.floor(x[inside]) + 0.5) / 8)
    # The least width is a millionth of a texel.
    found = called(ALL, "crisp_uv(p, vec2(1), vec2(0))", 2, p=np.array([[1 + 3e-7, 1 - 2e-7]]))
    assert found == near([[1.3, 0.8]], 1e-6)


@truth("std.mapping.crisp_uv")
@pytest.mark.parametrize("turn", range(4))
def test_texels_are_crisp_by_derivatives(turn: int) -> None:
    """From pixel to pixel u changes by 0.025 and 0.0125, of 8 texels each, in any direction."""
    u = 0.25 + np.rot90(np.array([[0.01, 0.035], [0.0225, 0.0475]]), 2 * (turn % 2))
    v = 0.5 + np.rot90(np.array([[0, 0.01], [0.02, 0.03]]), turn)
    width = "vec2(8 * 0.0375, 4 * 0.03)"
    texels = Picture(lambda u, v: (u, v, 0 * u, 0 * u), size=(8, 4))
    found = called(ALL, "crisp_uv(t, p)", 2, t=texels, p=Quad(np.stack([u, v], axis=-1)))
    given = {"p": np.stack([u.ravel(), v.ravel()], axis=1)}
    expected = called(ALL, f"crisp_uv(p, vec2(8, 4), {width})", 2, **given)
    assert found.reshape(-1, 2) == near(expected)


# --- coordinates of directions and points --------------------------------------------------------


@truth("std.mapping.equirectangular_uv", "std.mapping.equirectangular_direction")
def test_panoramas() -> None:
    assert called(ALL, "equirectangular_direction(equirectangular_uv(d))", 3, d=D) == near(D)
    far = called(ALL, "equirectangular_direction(equirectangular_uv(d))", 3, d=3 * D)
    assert far == near(D)
    found = called(ALL, "equirectangular_uv(d)", 2, d=3 * AXES)
    # +x, +y, +z, -x, -y, -z; the middle is -z, the right +x, the top +y.
    assert found[[0, 2, 3, 5]] == near([[0.75, 0.5], [1, 0.5], [0.25, 0.5], [0.5, 0.5]])
    assert found[[1, 4], 1] == near([0, 1])
    ends = np.array([[0.5, 0.5], [0.75, 0.5], [0.5, 0.25]])
    corner = math.sqrt(0.5)
    expected = [(0, 0, -1), (1, 0, 0), (0, corner, -corner)]
    assert called(ALL, "equirectangular_direction(p)", 3, p=ends) == near(expected)


@truth("std.mapping.cylindrical_uv")
def test_cylinders() -> None:
    points = np.array([[0, 0, -2], [3, 1, 0], [-1, -1, 0], [1, 0.5, -1]])
    expected = [(0.5, 0.5), (0.75, 0.25), (0.25, 0.75), (0.625, 0.375)]
    assert called(ALL, "cylindrical_uv(p, 4)", 2, p=points) == near(expected)


@truth("std.mapping.octahedral_uv", "std.mapping.octahedral_direction", "std.mapping.outside_in")
def test_octahedra() -> None:
    back = called(ALL, "octahedral_direction(octahedral_uv(d))", 3, d=np.concatenate([D, AXES]))
    assert back == near(np.concatenate([D, AXES]))
    found = called(
        ALL, "octahedral_uv(d)", 2, d=5 * np.concatenate([AXES, [[1, 1, -2], [-3, 1, -4]]])
    )
    # Axes at the middles of sides and in the middle; -z is at a corner.
    expected = [(1, 0.5), (0.5, 1), (0.5, 0.5), (0, 0.5), (0.5, 0)]
    assert found[:5] == near(expected)
    assert found[5] == near([1, 1])
    # The lower half is folded outwards: |x| becomes 1 - |y|, and the other way round.
    assert found[6:] == near(0.5 + 0.5 * np.array([[3 / 4, 3 / 4], [-7 / 8, 5 / 8]]))


@truth("std.mapping.matcap_uv")
def test_balls_of_light() -> None:
    n = directions(COUNT, 3)
    straight = called(ALL, "matcap_uv(n, vec3(0, 0, 1))", 2, n=n)
    assert straight == near(0.5 + 0.495 * n[:, :2] * (1, -1))
    # A normal that faces the eye is in the middle, wherever it is seen; one beside it at its rim.
    to_eye = unit_rows(np.column_stack([scattered(COUNT, 2), np.full(COUNT, 1.5)]))
    assert called(ALL, "matcap_uv(v, v)", 2, v=to_eye) == near(np.full((COUNT, 2), 0.5))
    aside = unit_rows(np.cross(to_eye, n))
    rim = called(ALL, "matcap_uv(a, v)", 2, a=aside, v=to_eye) - 0.5
    assert np.hypot(*rim.T) == near(np.full(COUNT, 0.495))
    right = unit_rows(np.cross((0, 1, 0), to_eye))
    found = called(ALL, "matcap_uv(a, v)", 2, a=right, v=to_eye)
    assert found == near(np.tile([0.995, 0.5], (COUNT, 1)))


# --- normals -------------------------------------------------------------------------------------


def leaning(seed: int) -> Floats:
    """Normals that lean away from +z without a pattern."""
    return unit_rows(np.add(scattered(COUNT, 3, 0.6, seed), (0, 0, 1)))


BASE = leaning(1)
DETAIL = leaning(2)


@truth("std.mapping.unpacked_normal")
def test_normals_of_maps() -> None:
    packed = 0.5 + 0.5 * BASE
    assert called(ALL, "unpacked_normal(c, 1)", 3, c=packed) == near(BASE)
    assert called(ALL, "unpacked_normal(c, 1)", 3, c=packed[:, :2]) == near(BASE)
    stronger = unit_rows(BASE * (3, 3, 1))
    assert called(ALL, "unpacked_normal(c, 3)", 3, c=packed) == near(stronger)
    assert called(ALL, "unpacked_normal(c, 3)", 3, c=packed[:, :2]) == near(stronger)
    # Two channels that are too long together have nothing left for z.
    found = called(ALL, "unpacked_normal(c, 1)", 3, c=np.array([[1.0, 1.0]]))
    assert found == near([[math.sqrt(0.5), math.sqrt(0.5), 0]])


@truth(
    "std.mapping.linear_blend", "std.mapping.slopes_blend", "std.mapping.whiteout_blend",
    "std.mapping.udn_blend",
)  # fmt: skip
def test_normals_are_blended() -> None:
    a, b = BASE, DETAIL
    slopes = a[:, :2] / a[:, 2:] + b[:, :2] / b[:, 2:]
    expected = {
        "linear_blend": (a + b) / 2,
        "slopes_blend": np.column_stack([slopes, np.ones(COUNT)]),
        "whiteout_blend": np.column_stack([a[:, :2] + b[:, :2], a[:, 2] * b[:, 2]]),
        "udn_blend": np.column_stack([a[:, :2] + b[:, :2], a[:, 2]]),
    }
    for name, value in expected.items():
        found = called(ALL, f"{name}(a, b)", 3, a=a, b=b)
        assert found == near(unit_rows(value)), name
    # A flat detail leaves the base, and all but the linear one keep a detail on a flat base.
    flat = np.array([[0.0, 0, 1]])
    for name in ("slopes_blend", "whiteout_blend", "udn_blend"):
        assert called(ALL, f"{name}(a, b)", 3, a=a, b=flat) == near(a), name


@truth("std.mapping.reoriented_blend")
def test_details_turn_with_the_base() -> None:
    """The matrix that turns +z to the base around what is at a right angle to both."""
    back = DETAIL * [1, 1, -1]
    expected = []
    for base in BASE:
        axis = np.cross((0, 0, 1), base)
        k = np.cross(axis, np.eye(3)).T
        expected.append(np.eye(3) + k + k @ k / (1 + base[2]))
        assert expected[-1] @ (0, 0, 1) == near(base)
    for detail in (DETAIL, back):
        found = called(ALL, "reoriented_blend(a, b)", 3, a=BASE, b=detail)
        assert found == near(np.einsum("nij,nj->ni", expected, detail))
        # What a filter has shortened is turned alike.
        assert called(ALL, "reoriented_blend(a, 0.7 * b)", 3, a=BASE, b=detail) == near(found)


@truth("std.mapping.detailed")
def test_details_of_colours() -> None:
    found = called(
        ALL, "detailed(rgb(0.4, 0.5, 0.6), rgb(0.5, 0.25, 1), k)", 3, k=np.array([0, 1, 0.5])
    )
    assert found == near([(0.4, 0.5, 0.6), (0.4, 0.25, 1.2), (0.4, 0.375, 0.9)])


@truth("std.mapping.bump_from_slopes", "std.mapping.bump_from_height")
def test_bumps_are_the_normals_of_moved_points() -> None:
    """A plane whose height is linear: the normal is at a right angle to both moved sides."""
    n, across = D, scattered(COUNT, 3, 1, 4)
    down = scattered(COUNT, 3, 1, 5)
    across -= np.sum(across * n, axis=1, keepdims=True) * n
    down -= np.sum(down * n, axis=1, keepdims=True) * n
    change = scattered(COUNT, 2, 0.4, 6)
    expected = np.cross(across + change[:, :1] * n, down + change[:, 1:] * n)
    expected *= np.sign(np.sum(expected * n, axis=1, keepdims=True))
    found = called(
        ALL, "bump_from_slopes(normalize(n), a, b, c)", 3, n=n, a=across, b=down, c=change
    )
    assert found == near(unit_rows(expected))
    still = np.zeros((COUNT, 3))
    found = called(
        ALL, "bump_from_slopes(normalize(n), a, b, c)", 3, n=n, a=still, b=still, c=change
    )
    assert found == near(n)
    # Where the sides span hardly anything, nothing is known of the slopes.
    for area, bent in ((1.1e-18, (-0.6, 0, 0.8)), (1e-18, (0, 0, 1)), (0.9e-18, (0, 0, 1))):
        found = called(
            ALL, "bump_from_slopes(normalize(n), a, b, c)", 3, n=np.array([[0, 0, 1]]),
            a=np.array([[area, 0, 0]]), b=np.array([[0, 1, 0]]), c=np.array([[0.75 * area, 0]]),
        )  # fmt: skip
        assert found == near([bent])
    # The same in a quad of pixels.
    i, j = np.meshgrid((0, 1), (0, 1))
    points = i[..., None] * across[0] + j[..., None] * down[0]
    height = i * change[0, 0] + j * change[0, 1]
    normal = Quad(np.broadcast_to(n[0], (2, 2, 3)))
    found = called(
        ALL, "bump_from_height((p as point<world>), normalize((n as vector<world>)), h)", 3,
        p=Quad(points), n=normal, h=Quad(height),
    )  # fmt: skip
    assert found.reshape(-1, 3) == near(np.tile(unit_rows(expected)[0], (4, 1)))


# --- parallax ------------------------------------------------------------------------------------

SIGHT = unit_rows(np.column_stack([scattered(COUNT, 2, 1, 3), np.ones(COUNT)]))


@truth("std.mapping.parallax_offset")
def test_heights_move_towards_the_eye() -> None:
    found = called(ALL, "parallax_offset(p, s, 0.3)", 2, p=UV, s=SIGHT)
    assert found == near(UV + 0.3 * SIGHT[:, :2] * (1, -1))


@truth("std.mapping.parallax_occlusion", "std.mapping.ParallaxStep")
@pytest.mark.parametrize(
    ("layers", "deep"), [(16, 0.55), (4, 0.25), (1, 0.8), (0, 0.8), (8, 0.0), (8, -0.5)]
)
def test_a_flat_bottom_is_found_where_the_sight_meets_it(layers: int, deep: float) -> None:
    bottom = Picture(lambda u, _: (deep + 0 * u, 9 + 0 * u, 9 + 0 * u, 9 + 0 * u))
    found = called(ALL, f"parallax_occlusion(t, p, s, 0.2, {layers})", 2, t=bottom, p=UV, s=SIGHT)
    way = 0.2 * max(deep, 0) * SIGHT[:, :2] / SIGHT[:, 2:]
    assert found == near(UV + way * (-1, 1))


@truth("std.mapping.parallax_occlusion", "std.mapping.ParallaxStep")
def test_a_slope_is_found_where_the_sight_meets_it() -> None:
    """The relief 0.5 + u / 2 - v / 4, and a ray that sinks by 1 over its whole way."""
    slope = Picture(lambda u, v: (0.5 + 0.5 * u - 0.25 * v, 0 * u, 0 * u, 0 * u))
    start = 0.1 * UV
    found = called(ALL, "parallax_occlusion(t, p, s, 0.2, 16)", 2, t=slope, p=start, s=SIGHT)
    way = 0.2 * SIGHT[:, :2] / SIGHT[:, 2:] * (-1, 1)
    share = (0.5 + start @ (0.5, -0.25)) / (1 - way @ (0.5, -0.25))
    assert found == near(start + share[:, None] * way)
    # What lies deeper than the deepest is as deep as this.
    pit = Picture(lambda u, _: (2 + 0 * u, 0 * u, 0 * u, 0 * u))
    found = called(ALL, "parallax_occlusion(t, p, s, 0.2, 64)", 2, t=pit, p=start, s=SIGHT)
    assert found == near(start + way)
    # Where the relief is bent, steps come near to it.
    waves = Picture(lambda u, v: (0.5 + 0.2 * np.sin(9 * u + 7 * v), 0 * u, 0 * u, 0 * u))
    found = called(ALL, "parallax_occlusion(t, p, s, 0.2, 16)", 2, t=waves, p=start, s=SIGHT)
    share = np.sum((found - start) * way, axis=1) / np.sum(way * way, axis=1)
    assert share == near(0.5 + 0.2 * np.sin(found @ (9, 7)), 2e-3)
    # One step takes all between its ends to be straight.
    for layers in (1, 0):
        found = called(
            ALL, f"parallax_occlusion(t, p, s, 0.2, {layers})", 2, t=waves, p=start, s=SIGHT
        )
        first, last = (0.5 + 0.2 * np.sin(place @ (9, 7)) for place in (start, start + way))
        assert found == near(start + (first / (1 + first - last))[:, None] * way)
    # A glancing sight goes no farther than twenty times the depth.
    low = np.array([[math.sqrt(1 - 0.01**2), 0, 0.01]])
    level = Picture(lambda u, _: (1 + 0 * u, 0 * u, 0 * u, 0 * u))
    found = called(ALL, "parallax_occlusion(t, p, s, 0.2, 16)", 2, t=level, p=start[:1], s=low)
    assert found == near(start[:1] - (0.2 * low[0, 0] / 0.05, 0))
    assert all(step == near((0, 0)) for step in level.steps)


@truth("std.mapping.parallax_occlusion")
def test_a_ray_ends_where_it_touches_the_relief() -> None:
    """A needle as high as the ray is after its first step, in a deep pit."""
    pit = Picture(lambda u, _: (np.where(np.abs(u + 0.05) < 0.01, 0.25, 0.9), u, u, u))
    sight = np.array([[math.sqrt(0.5), 0, math.sqrt(0.5)]])
    place = np.zeros((1, 2))
    found = called(ALL, "parallax_occlusion(t, p, s, 0.2, 4)", 2, t=pit, p=place, s=sight)
    assert found == near([[-0.05, 0]])


@truth("std.mapping.parallax_occlusion")
def test_relief_is_read_as_sharply_as_the_surface() -> None:
    """Reads below the surface take the changes of its coordinate from pixel to pixel."""
    relief = Picture(lambda u, _: (0.5 + 0 * u, u, u, u))
    place = Quad(np.array([[[0.1, 0.2], [0.13, 0.21]], [[0.11, 0.25], [0.14, 0.26]]]))
    sight = Quad(np.broadcast_to([0.0, 0, 1], (2, 2, 3)))
    called(ALL, "parallax_occlusion(t, p, s, 0.2, 4)", 2, t=relief, p=place, s=sight)
    steps = np.array([[np.mean(lane) for lane in step] for step in relief.steps])
    assert len(steps) > 2
    assert steps[0::2] == near(np.tile([0.03, 0.01], (len(steps) // 2, 1)))
    assert steps[1::2] == near(np.tile([0.01, 0.05], (len(steps) // 2, 1)))


@pytest.mark.parametrize(
    "expression",
    [
        "polar_uv(o.xy, o.xy), 0", "scaled_uv(o.xy, o.xy, o.xy), 0", "texel_center(o.xy, o.xy), 0",
        "flipbook_uv(o.xy, n, n, n), 0", "crisp_uv(o.xy, o.xy, o.xy), 0", "octahedral_uv(o), 0",
        "equirectangular_uv(o), 0", "cylindrical_uv(o, o.x), 0", "octahedral_direction(o.xy)",
        "matcap_uv(o, o), 0", "unpacked_normal(o, 0)", "linear_blend(o, -o)", "slopes_blend(o, o)",
        "reoriented_blend(o, o - vec3(0, 0, 1))", "reoriented_blend(o - vec3(0, 0, 1), o)",
        "triplanar_weights(o, o.x)", "triplanar_whiteout(o, o, o, normalize(o), o)",
        "biplanar_weights(o.xy, 8), 0",
        "hex_tiles(o.xy + 1e9).weights",
    ],
)  # fmt: skip
def test_nothing_is_without_a_number(expression: str) -> None:
    given = {"o": np.zeros((1, 3)), "n": np.array([0])}
    assert np.isfinite(called(ALL, expression, 3, **given)).all()

"""Distances against the nearest point of an outline that NumPy walks along."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .calls import Quad, called, scattered
from .kit import Floats
from .outlines import (
    along_arc,
    from_mesh,
    from_outline,
    from_segment,
    regular,
    revolved,
    slices,
)
from .truth import truth

ALL = "import std.distances"
PLANE = scattered(400, 2, 2)
SPACE = scattered(300, 3, 2)
BOX = np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])


def near(expected: Any, within: float = 1e-9) -> Any:
    return pytest.approx(np.asarray(expected, np.float64), abs=within)


def of_points(expression: str, points: Floats, **given: Any) -> Floats:
    """The distances of points."""
    return called(ALL, expression, 1, p=points, **given)


# --- in the plane --------------------------------------------------------------------------------


@truth("std.distances.circle", "std.distances.ring")
def test_discs_and_rings() -> None:
    away = np.hypot(*PLANE.T)
    assert of_points("circle(p, 0.7)", PLANE) == near(away - 0.7)
    between = np.where(away > 0.7, away - 0.85, 0.55 - away)
    assert of_points("ring(p, 0.7, 0.3)", PLANE) == near(between)


@truth("std.distances.box", "std.distances.rounded_box")
def test_boxes_of_the_plane() -> None:
    box = BOX * (0.7, 1.1)
    assert of_points("box(p, vec2(0.7, 1.1))", PLANE) == near(from_outline(box, PLANE))
    inner = BOX * (0.5, 0.9)
    expected = from_outline(inner, PLANE) - 0.2
    assert of_points("rounded_box(p, vec2(0.7, 1.1), 0.2)", PLANE) == near(expected)


@truth("std.distances.segment", "std.distances.capsule", "std.distances.plane")
def test_lines() -> None:
    a, b = np.array([0.3, -0.8]), np.array([-1.1, 0.6])
    ends = {"a": np.tile(a, (400, 1)), "b": np.tile(b, (400, 1))}
    away = from_segment(a, b, PLANE)
    assert of_points("segment(p, a, b)", PLANE, **ends) == near(away)
    assert of_points("capsule(p, a, b, 0.3)", PLANE, **ends) == near(away - 0.3)
    # A segment without a length is a point.
    point = np.tile(a, (400, 1))
    found = of_points("segment(p, a, b)", PLANE, a=point, b=point)
    assert found == near(np.hypot(*(PLANE - a).T))
    below = 0.6 * PLANE[:, 0] - 0.8 * PLANE[:, 1] - 0.4
    assert of_points("plane(p, vec2(0.6, -0.8), 0.4)", PLANE) == near(below)


@truth("std.distances.triangle", "std.distances.doubled_area")
@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0)])
def test_triangles(order: tuple[int, ...]) -> None:
    corners = np.array([[-1.2, -0.4], [1.0, -0.9], [0.2, 1.3]])[list(order)]
    names = ", ".join(f"vec2({x}, {y})" for x, y in corners)
    assert of_points(f"triangle(p, {names})", PLANE) == near(from_outline(corners, PLANE))
    # Half a unit square, counted twice.
    area = called(ALL, "doubled_area(vec2(1, 1), vec2(2, 1), vec2(1, 3))")
    assert area == near(2)


@truth("std.distances.triangle")
def test_a_triangle_without_an_inside_is_a_line() -> None:
    found = of_points("triangle(p, vec2(-1, 0), vec2(0, 0), vec2(1, 0))", PLANE)
    assert found == near(from_segment(np.array([-1.0, 0]), np.array([1.0, 0]), PLANE))


@truth("std.distances.star", "std.distances.regular_polygon", "std.distances.repeated_around")
@pytest.mark.parametrize("n", [3, 5, 8])
def test_stars_and_polygons(n: int) -> None:
    corners = np.empty((2 * n, 2))
    corners[::2], corners[1::2] = 1.4 * regular(n), 0.5 * regular(n, 0.5)
    found = of_points(f"star(p, {n}, 1.4, 0.5)", PLANE)
    assert found == near(from_outline(corners, PLANE))
    found = of_points(f"regular_polygon(p, {n}, 1.2)", PLANE)
    assert found == near(from_outline(1.2 * regular(n), PLANE))
    folded = called(ALL, f"repeated_around(p, {n})", 2, p=PLANE)
    assert np.hypot(*folded.T) == near(np.hypot(*PLANE.T))
    turned = np.arctan2(*PLANE.T)
    to_middles = turned[:, None] - 2 * np.pi / n * np.arange(-n, n + 1)
    assert np.arctan2(*folded.T) == near(np.abs(to_middles).min(axis=1))


@truth("std.distances.hexagon")
def test_hexagons() -> None:
    corners = 0.9 / math.cos(math.pi / 6) * regular(6, 0.5)
    assert of_points("hexagon(p, 0.9)", PLANE) == near(from_outline(corners, PLANE))


@truth("std.distances.cross_shape")
def test_crosses() -> None:
    a, b = 1.3, 0.4
    quarter = np.array([[a, b], [b, b], [b, a]])
    turned = [quarter @ np.array([[c, s], [-s, c]]) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    expected = from_outline(np.concatenate(turned), PLANE)
    assert of_points(f"cross_shape(p, vec2({a}, {b}))", PLANE) == near(expected)


@truth("std.distances.pie")
@pytest.mark.parametrize("degrees", [35, 130])
def test_slices(degrees: float) -> None:
    rim = 1.3 * along_arc(-math.radians(degrees), math.radians(degrees))
    expected = from_outline(np.concatenate([[[0, 0]], rim]), PLANE)
    assert of_points(f"pie(p, {degrees}deg, 1.3)", PLANE) == near(expected, 1e-5)


@truth("std.distances.arc")
@pytest.mark.parametrize("degrees", [35, 130])
def test_arcs(degrees: float) -> None:
    line = 1.1 * along_arc(-math.radians(degrees), math.radians(degrees))
    expected = np.abs(from_outline(line, PLANE, is_closed=False)) - 0.15
    assert of_points(f"arc(p, {degrees}deg, 1.1, 0.3)", PLANE) == near(expected, 1e-5)


@truth("std.distances.heart")
def test_hearts() -> None:
    """Two quarters of a square's outline and two half circles over its upper sides."""
    right = np.array([0.25, 0.75]) + math.sqrt(2) / 4 * along_arc(-math.pi / 4, math.pi * 3 / 4)
    left = right[::-1] * (-1, 1)
    expected = from_outline(np.concatenate([[[0, 0]], left, right])[::-1], PLANE)
    assert of_points("heart(p)", PLANE) == near(expected, 1e-5)


@truth("std.distances.ellipsoid")
def test_an_ellipse_is_right_at_its_edge() -> None:
    turn = np.linspace(0, 2 * np.pi, 60)
    edge = np.stack([1.4 * np.cos(turn), 0.6 * np.sin(turn)], axis=1)
    upright = edge / (1.4**2, 0.6**2)
    upright /= np.linalg.norm(upright, axis=1, keepdims=True)
    for step in (-1e-5, 0, 1e-5):
        found = of_points("ellipsoid(p, vec2(1.4, 0.6))", edge + step * upright)
        assert found == near(np.full(60, step), 1e-9)
    # Exact along the axes, and in the middle.
    expected = [0.6 - 1.4, 0.4 - 0.6, 0.5, -0.6]
    points = np.array([[0.6, 0], [0, 0.4], [0, -1.1], [0, 0]])
    assert of_points("ellipsoid(p, vec2(1.4, 0.6))", points) == near(expected)
    assert of_points("ellipsoid(p, vec2(0.6, 1.4))", points[3:]) == near([-0.6])


# --- in space ------------------------------------------------------------------------------------


@truth("std.distances.sphere", "std.distances.ellipsoid")
def test_balls() -> None:
    away = np.linalg.norm(SPACE, axis=1)
    assert of_points("sphere(p, 0.8)", SPACE) == near(away - 0.8)
    assert of_points("ellipsoid(p, vec3(0.8))", SPACE) == near(away - 0.8)
    assert of_points("ellipsoid(p, vec3(3, 1, 2))", np.zeros((1, 3))) == near([-1])


@truth("std.distances.box", "std.distances.rounded_box", "std.distances.capsule")
def test_boxes_of_space() -> None:
    expected = from_mesh(*slices(BOX * (0.5, 0.9), 1.2), SPACE)
    assert of_points("box(p, vec3(0.5, 0.9, 1.2))", SPACE) == near(expected)
    inner = from_mesh(*slices(BOX * (0.4, 0.8), 1.1), SPACE)
    assert of_points("rounded_box(p, vec3(0.5, 0.9, 1.2), 0.1)", SPACE) == near(inner - 0.1)
    a, b = np.array([0.1, -0.5, 0.7]), np.array([0.9, 0.4, -1.0])
    found = of_points("capsule(p, vec3(0.1, -0.5, 0.7), vec3(0.9, 0.4, -1), 0.2)", SPACE)
    assert found == near(from_segment(a, b, SPACE) - 0.2)


@truth("std.distances.torus", "std.distances.revolved")
def test_a_torus() -> None:
    ring = along_arc(0, 2 * np.pi) * 0.3 + (1.1, 0)
    flat = revolved(SPACE)
    nearest = np.linalg.norm(flat[:, None] - ring, axis=2).min(axis=1)
    sign = np.where(np.hypot(flat[:, 0] - 1.1, flat[:, 1]) < 0.3, -1, 1)
    assert of_points("torus(p, 1.1, 0.3)", SPACE) == near(sign * nearest, 5e-5)


@truth("std.distances.cylinder", "std.distances.revolved")
def test_a_cylinder() -> None:
    expected = from_outline(BOX * (0.7, 1.2), revolved(SPACE))
    assert of_points("cylinder(p, 0.7, 1.2)", SPACE) == near(expected)


@truth("std.distances.cone", "std.distances.revolved")
def test_a_cone() -> None:
    profile = np.array([[-0.9, 0], [0.9, 0], [0, 1.4]])
    expected = from_outline(profile, revolved(SPACE))
    assert of_points("cone(p, 0.9, 1.4)", SPACE) == near(expected)


@truth("std.distances.hexagonal_prism", "std.distances.extruded")
def test_a_prism() -> None:
    corners = 0.9 / math.cos(math.pi / 6) * regular(6, 0.5)[::-1]
    expected = from_mesh(*slices(corners, 0.8), SPACE)
    assert of_points("hexagonal_prism(p, 0.9, 0.8)", SPACE) == near(expected)


@truth("std.distances.octahedron", "std.distances.beside")
def test_an_octahedron() -> None:
    signs = np.array([(x, y, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)], np.float64)
    faces = np.array([np.diag(1.2 * sign) for sign in signs])
    normals = signs / math.sqrt(3)
    expected = from_mesh(faces, normals, SPACE)
    assert of_points("octahedron(p, 1.2)", SPACE) == near(expected)


@truth("std.distances.plane")
def test_a_plane() -> None:
    found = of_points("plane(p, vec3(0, 0.6, 0.8), -0.5)", SPACE)
    assert found == near(SPACE @ (0, 0.6, 0.8) + 0.5)


# --- of distances --------------------------------------------------------------------------------

A, B = scattered(200, 2, 1, 11).T


@truth(
    "std.distances.union", "std.distances.intersection", "std.distances.difference",
    "std.distances.exclusion",
)  # fmt: skip
def test_shapes_are_put_together() -> None:
    """What is inside follows from what is inside of both; the nearer edge decides how far."""
    inside = {
        "union": (A < 0) | (B < 0), "intersection": (A < 0) & (B < 0),
        "difference": (A < 0) & (B > 0), "exclusion": (A < 0) ^ (B < 0),
    }  # fmt: skip
    for name, expected in inside.items():
        found = called(ALL, f"{name}(a, b)", 1, a=A, b=B)
        assert ((found < 0) == expected).all(), name
        assert (np.isclose(abs(found), abs(A)) | np.isclose(abs(found), abs(B))).all(), name
        # Each is a bound: it changes no faster than the distances do.
        moved = called(ALL, f"{name}(a, b)", 1, a=A + 0.1, b=B - 0.1)
        assert (abs(moved - found) <= 0.1 + 1e-12).all(), name


@truth(
    "std.distances.smooth_union", "std.distances.smooth_intersection",
    "std.distances.smooth_difference", "std.distances.fillet",
)  # fmt: skip
def test_shapes_are_put_together_smoothly() -> None:
    """Between straight lines with the slopes 0 and 1 lies the parabola that touches both."""
    k = 0.6
    apart = A - B
    t = np.clip(0.5 + 0.5 * apart / k, 0, 1)
    blended = np.where(apart > k, B, np.where(apart < -k, A, A + (B - A) * t - k * t * (1 - t)))
    assert called(ALL, f"smooth_union(a, b, {k})", 1, a=A, b=B) == near(blended)
    found = called(ALL, f"smooth_intersection(a, b, {k})", 1, a=-A, b=-B)
    assert found == near(-blended)
    found = called(ALL, f"smooth_difference(a, b, {k})", 1, a=-A, b=B)
    assert found == near(-blended)
    assert called(ALL, "smooth_union(a, b, 0)", 1, a=A, b=B) == near(np.minimum(A, B))


@truth("std.distances.rounded", "std.distances.onion")
def test_edges_grow() -> None:
    assert called(ALL, "rounded(a, 0.3)", 1, a=A) == near(A - 0.3)
    expected = np.where(A > 0, A - 0.2, -A - 0.2)
    assert called(ALL, "onion(a, 0.4)", 1, a=A) == near(expected)


@truth("std.distances.coverage")
def test_coverage_is_what_a_straight_edge_leaves_of_a_pixel() -> None:
    away = np.array([-0.3, -0.1, -0.05, 0, 0.05, 0.1, 0.3])
    expected = [1, 1, 0.75, 0.5, 0.25, 0, 0]
    assert called(ALL, "coverage(a, 0.2)", 1, a=away) == near(expected)
    # Without a width it is a step.
    assert called(ALL, "coverage(a, 0)", 1, a=away) == near([1, 1, 1, 0.5, 0, 0, 0])
    found = called(ALL, "coverage(a, 0)", 1, a=np.array([-2e-13, 3e-13]))
    assert found == near([0.7, 0.2], 1e-6)
    # In a quad of pixels: the distance grows by (3, 4) from pixel to pixel, so over 5.
    quad = np.array([[-2.0, 1.0], [2.0, 5.0]])
    shares = 0.5 - quad / 5
    assert called(ALL, "coverage(a)", 1, a=Quad(quad)) == near(np.clip(shares, 0, 1))


# --- of places -----------------------------------------------------------------------------------


@truth("std.distances.repeated")
def test_shapes_are_repeated() -> None:
    spacing = np.array([0.7, 0.4])
    found = called(ALL, "repeated(p, vec2(0.7, 0.4))", 2, p=PLANE)
    assert (np.abs(found) <= spacing / 2 + 1e-12).all()
    cells = (PLANE - found) / spacing
    assert cells == near(np.round(cells))
    found = called(ALL, "repeated(p, vec2(0.7, 0.4), vec2(1, 2))", 2, p=PLANE)
    cells = (PLANE - found) / spacing
    assert cells == near(np.round(cells))
    # The nearest of three by five cells.
    middles = np.array([(x, y) for x in (-1, 0, 1) for y in range(-2, 3)]) * spacing
    lanes = np.abs(PLANE[:, None] - middles)
    assert np.abs(found) == near(lanes.min(axis=1))


@truth("std.distances.reflected", "std.distances.elongated")
def test_places_are_folded() -> None:
    normal = np.array([0.6, 0.8])
    found = called(ALL, "reflected(p, vec2(0.6, 0.8), 0.3)", 2, p=PLANE)
    before = PLANE @ normal - 0.3
    assert found @ normal - 0.3 == near(np.abs(before))
    assert found @ (0.8, -0.6) == near(PLANE @ (0.8, -0.6))
    found = called(ALL, "elongated(p, vec3(0.5, 0.2, 0))", 3, p=SPACE)
    reach = np.array([0.5, 0.2, 0])
    expected = np.where(reach < SPACE, SPACE - reach, np.where(-reach > SPACE, SPACE + reach, 0))
    assert found == near(expected)


@truth("std.distances.twisted", "std.distances.bent")
def test_places_are_turned() -> None:
    x, y, z = SPACE.T
    # As one complex number, a plane turns by a factor.
    plane = (x + 1j * z) * np.exp(1j * math.radians(40) * y)
    found = called(ALL, "twisted(p, 40deg)", 3, p=SPACE)
    assert found == near(np.stack([plane.real, y, plane.imag], axis=1))
    plane = (x + 1j * y) * np.exp(1j * math.radians(40) * x)
    found = called(ALL, "bent(p, 40deg)", 3, p=SPACE)
    assert found == near(np.stack([plane.real, plane.imag, z], axis=1))


# --- all of them ---------------------------------------------------------------------------------

EXACT = (
    "box(p.xy, vec2(0.7, 1.1))", "star(p.xy, 5, 1.2, 0.5)", "heart(p.xy)", "pie(p.xy, 40deg, 1)",
    "arc(p.xy, 40deg, 1, 0.2)", "hexagon(p.xy, 1)", "cross_shape(p.xy, vec2(1.2, 0.4))",
    "box(p, vec3(1))",
    "torus(p, 1, 0.3)", "cone(p, 1, 1)", "octahedron(p, 1)", "hexagonal_prism(p, 1, 1)",
)  # fmt: skip


@pytest.mark.parametrize("expression", EXACT)
def test_exact_distances_grow_by_one_for_each_unit(expression: str) -> None:
    step = 1e-6
    steps = [step * axis for axis in np.eye(3)]
    slopes = [
        (of_points(expression, SPACE + each) - of_points(expression, SPACE - each)) / (2 * step)
        for each in steps
    ]
    lengths = np.linalg.norm(slopes, axis=0)
    # All but at creases, on which no point of these lies.
    assert lengths == near(np.ones(len(SPACE)), 1e-4)


DEGENERATE = (
    "box(p, o)", "rounded_box(p, o, 1)", "segment(p, p, p)", "ellipsoid(p, o)",
    "star(p.xy, n, k, k)",
    "star(p.xy, n, 1, 2)", "regular_polygon(p.xy, n, 1)", "triangle(p.xy, p.xy, p.xy, p.xy)",
    "hexagon(p.xy, k)", "cross_shape(p.xy, o.xy)", "pie(p.xy, 0deg, k)", "octahedron(p, k)",
    "cone(p, k, k)", "smooth_union(p.x, p.y, k)", "coverage(p.x, k)", "repeated(p, o).x",
    "repeated_around(p.xy, n).x", "smooth_union(p.x, p.y, -1)",
)  # fmt: skip
"""Shapes without a size, and what else a host might set."""


@pytest.mark.parametrize("expression", DEGENERATE)
@pytest.mark.parametrize("n", [0, -3])
def test_no_shape_is_without_a_number(expression: str, n: int) -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, -1, 0], [0.3, 0.5, -0.2], [1e6, -1e6, 0]])
    zeros = {"o": np.zeros((1, 3)), "k": np.zeros(1), "n": np.array([n])}
    assert np.isfinite(of_points(expression, points, **zeros)).all()

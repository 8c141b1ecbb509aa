"""The mixins of `std.tessellation`, held against what they are known for."""

from __future__ import annotations

import random
from collections.abc import Sequence

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.compiler.ir.stages import EDGE_LEVEL, TARGET

from ..passes.kit import elaborated
from ..passes.test_lower_expansion import Primitive
from ..passes.test_lower_tessellation import at_patch, directly
from .kit import close, of, unit, written
from .truth import truth

Floats = NDArray[np.float64]


def drawn(
    mixin: str, value: str, points: Floats, where: Sequence[float] | Floats, members: str = ""
) -> Floats:
    """The value of a slot at a place of a patch; its control points are given with normals."""
    (shader,) = elaborated(
        f"import std.tessellation.{{{mixin}}}\n"
        f"material M : Surface + {mixin} {{ {members}\n"
        f"color = vec3({value}.x, {value}.y, {value}.z) }}"
    )
    values = {
        (name, number): tuple(map(float, lanes))
        for number, point in enumerate(points)
        for name, lanes in (
            ("vertex_position", point[:3]),
            ("vertex_normal", point[3:]),
            ("vertex_uv", point[:2]),
        )
    }
    place = Primitive(0, 0, tuple(range(len(points))), values)
    (color,) = shader.results_of(TARGET)
    return np.array(directly(shader, color.value, place, tuple(map(float, where))))[:3]


def on_a_ball(*directions: Sequence[float]) -> Floats:
    """Points of the unit sphere with its normals."""
    points = np.array(directions, float)
    points /= np.linalg.norm(points, axis=1)[:, None]
    return np.concatenate([points, points], axis=1)


def flat(*points: Sequence[float]) -> Floats:
    normal = np.broadcast_to([0.0, 0.0, 1.0], (len(points), 3))
    return np.concatenate([np.array(points, float), normal], axis=1)


PART_OF_A_BALL = on_a_ball([1, 0, 0.2], [0.3, 1, 0], [0, 0.1, 1])


def anyhow(count: int, seed: int) -> Floats:
    """Points without a pattern, whose normals are of no surface."""
    dice = np.random.default_rng(seed)
    points, normals = dice.uniform(-1, 1, (count, 3)), dice.uniform(-1, 1, (count, 3))
    return np.concatenate([points, normals / np.linalg.norm(normals, axis=1)[:, None]], axis=1)


TRIANGLES = [PART_OF_A_BALL, PART_OF_A_BALL * (1, 1, 1, -1, -1, -1), anyhow(3, 1), anyhow(3, 2)]
PLACES = [(1, 0, 0), (0, 0, 1), (0.5, 0.5, 0), (0.25, 0.25, 0.5), (0.2, 0.3, 0.5)]


@truth("std.tessellation.PhongTessellation", "std.tessellation.PNTriangles")
@pytest.mark.parametrize("mixin", ["PhongTessellation", "PNTriangles"])
@pytest.mark.parametrize("where", PLACES)
def test_triangles_are_drawn_towards_the_ball_that_their_normals_are_of(
    mixin: str, where: tuple[float, ...]
) -> None:
    plain = np.array(where) @ PART_OF_A_BALL[:, :3]
    radius = np.linalg.norm(drawn(mixin, "position", PART_OF_A_BALL, where))
    missing = 1 - np.linalg.norm(plain)
    if max(where) == 1:
        assert radius == pytest.approx(1)
    else:
        assert abs(1 - radius) < 0.5 * missing


@truth("std.tessellation.PhongTessellation", "std.tessellation.PNTriangles")
@pytest.mark.parametrize("mixin", ["PhongTessellation", "PNTriangles"])
@pytest.mark.parametrize("where", PLACES)
def test_a_flat_triangle_stays_flat(mixin: str, where: tuple[float, ...]) -> None:
    corners = flat([0, 0, 1], [2, 0, 1], [1, 3, 1])
    found = drawn(mixin, "position", corners, where)
    assert found == pytest.approx(np.array(where) @ corners[:, :3])


@truth("std.tessellation.PhongTessellation", "std.tessellation.to_plane")
@pytest.mark.parametrize("triangle", TRIANGLES)
def test_phong_tessellation_is_what_the_paper_says(triangle: Floats) -> None:
    where = np.array([0.2, 0.5, 0.3])
    corners, normals = triangle[:, :3], triangle[:, 3:]
    plain = where @ corners
    projected = [plain - ((plain - p) @ n) * n for p, n in zip(corners, normals, strict=True)]
    wanted = 0.25 * plain + 0.75 * (where @ np.array(projected))
    assert drawn("PhongTessellation", "position", triangle, where) == pytest.approx(wanted)


@truth(
    "std.tessellation.PNTriangles",
    "std.tessellation.bulge",
    "std.tessellation.moved",
    "std.tessellation.between",
)
@pytest.mark.parametrize("triangle", TRIANGLES)
def test_pn_triangles_are_what_the_paper_says(triangle: Floats) -> None:
    """Vlachos and others, equations 1 to 3."""
    where = np.array([0.2, 0.5, 0.3])
    p, n = triangle[:, :3], triangle[:, 3:]

    def near(i: int, j: int) -> Floats:
        return np.array((2 * p[i] + p[j] - ((p[j] - p[i]) @ n[i]) * n[i]) / 3)

    edges = {(i, j): near(i, j) for i in range(3) for j in range(3) if i != j}
    mean = sum(edges.values()) / 6
    middle = mean + (mean - p.mean(axis=0)) / 2
    u = where
    wanted = sum(u[i] ** 3 * p[i] for i in range(3)) + 6 * u.prod() * middle
    wanted += sum(3 * u[i] ** 2 * u[j] * value for (i, j), value in edges.items())
    assert drawn("PNTriangles", "position", triangle, where) == pytest.approx(wanted)

    def between(i: int, j: int) -> Floats:
        edge, both = p[j] - p[i], n[i] + n[j]
        found = both - 2 * (edge @ both) / (edge @ edge) * edge
        return np.array(found / np.linalg.norm(found))

    normal = sum(u[i] ** 2 * n[i] for i in range(3))
    normal += sum(u[i] * u[j] * between(i, j) for i, j in ((0, 1), (1, 2), (2, 0)))
    normal /= np.linalg.norm(normal)
    assert drawn("PNTriangles", "normal", triangle, where) == pytest.approx(normal)


@truth("std.tessellation.between")
@pytest.mark.parametrize("length", [2.0, 2e-6, 5e-7])
def test_edges_of_almost_no_length_divide_by_no_less_than_a_square_of_a_millionth(
    length: float,
) -> None:
    edge = length * np.array((0.6, 0.0, 0.8))
    normals = np.array(((0.36, 0.48, 0.8), (0.0, 0.6, 0.8)))
    both = normals.sum(axis=0)
    found = both - 2 * (edge @ both) / max(edge @ edge, 1e-12) * edge
    first, last = (written(normal, "normal<world>") for normal in normals)
    call = f"between({written((0, 0, 0))}, {written(edge)}, {first}, {last})"
    assert of(call, "M", "import std.tessellation.{between}") == close(unit(found))


def bezier(t: float) -> Floats:
    s = 1 - t
    return np.array([s**3, 3 * s * s * t, 3 * s * t * t, t**3])


def cubic(t: float) -> Floats:
    """A uniform B-spline's weights, as Cox and de Boor's recursion gives them."""
    return np.array([cox_de_boor(3, k, t + 3) for k in range(4)])


def quadratic(t: float) -> Floats:
    return np.array([cox_de_boor(2, k, t + 2) for k in range(3)])


def cox_de_boor(degree: int, start: int, t: float) -> float:
    """A B-spline over the knots ``start``, ``start + 1`` …"""
    if degree == 0:
        return float(start <= t < start + 1)
    rise = (t - start) / degree * cox_de_boor(degree - 1, start, t)
    fall = (start + degree + 1 - t) / degree * cox_de_boor(degree - 1, start + 1, t)
    return rise + fall


CURVES = {
    "bernstein": ("bernstein_slope", bezier),
    "spline": ("spline_slope", cubic),
    "quadratic_spline": ("quadratic_slope", quadratic),
}


@truth(*(f"std.tessellation.{name}" for each in CURVES for name in (each, CURVES[each][0])))
@pytest.mark.parametrize("t", [0.2, 0.7])
@pytest.mark.parametrize("curve", CURVES)
def test_weights_and_their_derivatives(curve: str, t: float) -> None:
    slope, weights = CURVES[curve]
    rising = (weights(t + 1e-5) - weights(t - 1e-5)) / 2e-5
    imports = f"import std.tessellation.{{{curve}, {slope}}}"
    for number, (value, change) in enumerate(zip(weights(t), rising, strict=True)):
        found = of(f"{curve}({t})[{number}], {slope}({t})[{number}], 0", "M", imports)
        assert found == pytest.approx((value, change, 0), rel=1e-8, abs=1e-8)


NETS = {
    "BezierPatches": (4, bezier),
    "SplinePatches": (4, cubic),
    "QuadraticSplines": (3, quadratic),
}


@truth(
    "std.tessellation.BezierPatches",
    "std.tessellation.SplinePatches",
    "std.tessellation.QuadraticSplines",
    "std.tessellation.bernstein",
    "std.tessellation.bernstein_slope",
    "std.tessellation.spline",
    "std.tessellation.spline_slope",
    "std.tessellation.quadratic_spline",
    "std.tessellation.quadratic_slope",
)
@pytest.mark.parametrize("mixin", NETS)
@pytest.mark.parametrize("where", [(0.0, 0.0), (0.3, 0.75), (0.99, 0.1)])
def test_a_net_is_mixed_by_its_weights(mixin: str, where: tuple[float, float]) -> None:
    side, weights = NETS[mixin]
    dice = random.Random(side)
    points = flat(*(
        (i + 0.3 * dice.random(), j + 0.3 * dice.random(), dice.random())
        for j in range(side) for i in range(side)
    ))  # fmt: skip

    def at(u: float, v: float) -> Floats:
        net = points[:, :3].reshape(side, side, 3)
        return np.array(np.einsum("j,i,jik->k", weights(v), weights(u), net))

    u, v = where
    assert drawn(mixin, "position", points, where) == pytest.approx(at(u, v))
    step = 1e-5
    along_u, along_v = at(u + step, v) - at(u, v), at(u, v + step) - at(u, v)
    normal = np.cross(along_u, along_v)
    normal /= np.linalg.norm(normal)
    assert drawn(mixin, "normal", points, where) == pytest.approx(normal, abs=1e-3)


@truth("std.tessellation.Displaced", "std.tessellation.DisplacedQuads")
@pytest.mark.parametrize("mixin", ["Displaced", "DisplacedQuads"])
def test_what_is_between_moves_along_the_normal(mixin: str) -> None:
    if mixin == "Displaced":
        corners, where = flat([0, 0, 1], [2, 0, 1], [1, 3, 1]), np.array((0.25, 0.25, 0.5))
        plain = where @ corners[:, :3]
    else:
        corners, where = flat([0, 0, 1], [2, 0, 1], [2, 3, 1], [0, 3, 1]), np.array((0.25, 0.5))
        plain = np.array((0.5, 1.5, 1.0))
    normal = np.array((0.48, -0.64, 0.6))
    corners[:, 3:] = normal
    found = drawn(mixin, "position", corners, where, "displacement = 0.25")
    assert found == pytest.approx(plain + 0.25 * normal)
    assert drawn(mixin, "position", corners, where) == pytest.approx(plain)


MIXINS = {
    "Displaced": (3, (0, 1, 2)), "DisplacedQuads": (4, (0, 1, 2, 3)),
    "PhongTessellation": (3, (0, 1, 2)), "PNTriangles": (3, (0, 1, 2)),
    "QuadraticSplines": (9, (0, 1, 4, 3)), "BezierPatches": (16, (0, 3, 15, 12)),
    "SplinePatches": (16, (5, 6, 10, 9)),
}  # fmt: skip
"""The number of control points of a patch, and which of them are its corners, around it."""


@truth(*(f"std.tessellation.{name}" for name in MIXINS))
@pytest.mark.parametrize("mixin", MIXINS)
def test_edges_are_as_fine_as_the_detail_says(mixin: str) -> None:
    count, corners = MIXINS[mixin]
    (shader,) = elaborated(
        f"import std.tessellation.{{{mixin}}}\n"
        f"material M : Surface + {mixin} {{ detail = 2 + object_position.x  color = vec3(1) }}"
    )
    values = {("vertex_position", number): (3.0, 0.0, 0.0) for number in range(count)}
    place = Primitive(0, 0, tuple(range(count)), values)
    levels = {at_patch(shader, row.value, place) for row in shader.results_of(EDGE_LEVEL)}
    assert levels == {5.0}
    assert shader.tessellation is not None
    assert (shader.tessellation.points, shader.tessellation.ends) == (count, corners)


@truth(*(f"std.tessellation.{name}" for name in MIXINS))
@pytest.mark.parametrize("mixin", MIXINS)
def test_an_edge_is_as_fine_as_the_finer_of_its_ends(mixin: str) -> None:
    count, corners = MIXINS[mixin]
    (shader,) = elaborated(
        f"import std.tessellation.{{{mixin}}}\n"
        f"material M : Surface + {mixin} {{ fineness = object_position.x  color = vec3(1) }}"
    )
    finenesses = [float(2 + (5 * number) % 17) for number in range(count)]
    values = {
        ("vertex_position", number): (fineness, 0.0, 0.0)
        for number, fineness in enumerate(finenesses)
    }
    place = Primitive(0, 0, tuple(range(count)), values)
    found = sorted(at_patch(shader, row.value, place) for row in shader.results_of(EDGE_LEVEL))
    ends = zip(corners, corners[1:] + corners[:1], strict=True)
    assert found == sorted(max(finenesses[a], finenesses[b]) for a, b in ends)

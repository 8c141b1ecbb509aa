"""Displaced surfaces against NumPy: points of a ball that are moved, and the normals that what they
become has, by differences of the moved points themselves."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.evaluate import evaluate

from ..semantics.kit import leaves, shader
from .calls import Quad, called, directions
from .kit import MESH, WORLD, Floats, close, columns
from .truth import truth

COUNT = 40
STILL = np.eye(4)
PLACES = directions(COUNT)
PIXEL = 1e-5
"""How far neighbouring pixels are apart on the ball."""
IMPORTS = "import std.mtlx.displacement\nimport std.mtlx.surface"


def axes_at(normal: Floats) -> tuple[Floats, Floats]:
    """A tangent of a ball towards the east, and the third axis, which points north."""
    east = np.cross((0.0, 1.0, 0.0), normal)
    east /= np.linalg.norm(east, axis=-1, keepdims=True)
    return east, np.cross(normal, east)


def around(normal: Floats, x: Any, y: Any) -> Floats:
    """The point of the ball a little further east and north."""
    east, north = axes_at(normal)
    moved = normal + x * east + y * north
    return np.asarray(moved / np.linalg.norm(moved, axis=-1, keepdims=True))


def quads(x: float = PIXEL, y: float = PIXEL) -> Floats:
    """Two by two pixels at each place, (place, row, column, lane)."""
    rows = [[around(PLACES, x * column, y * row) for column in (0, 1)] for row in (0, 1)]
    return np.moveaxis(np.array(rows), 2, 0)


def drawn(slot: str, equation: str, points: Floats, world: Floats = STILL) -> Floats:
    """A slot at the first pixel of each quad on a displaced ball."""
    text = f"{IMPORTS}\nmaterial M : DisplacedSurface {{ {equation}\n color = vec3({slot}) }}"
    east, _ = axes_at(points)
    handed = np.concatenate([east, np.ones((*east.shape[:-1], 1))], axis=-1)
    given = {
        "vertex_position": Quad(points).lanes, "vertex_normal": Quad(points).lanes,
        "vertex_tangent": Quad(handed).lanes, "object_to_world": columns(world),
        "vertex_uv": Quad(points[..., :2]).lanes,
    }  # fmt: skip
    whole = shader(text)
    with np.errstate(all="ignore"):
        found = evaluate(whole.results_of(TARGET)[0].value, leaves(whole, {**MESH, **given}), np)
    shape = points.shape[:-1]
    return np.stack([np.broadcast_to(np.asarray(lane), shape)[:, 0, 0] for lane in found[:3]], -1)


Moves = Callable[[Floats], Floats]
"""How points of the ball are moved, in the object."""


def by_height(p: Floats) -> Floats:
    return np.asarray((0.1 * np.sin(3 * p[..., :1]) * np.cos(2 * p[..., 1:2] - p[..., 2:])) * p)


def by_vector(p: Floats) -> Floats:
    east, north = axes_at(p)
    x, y, z = (p[..., lane, None] for lane in range(3))
    return np.asarray(0.1 * x * y * east + 0.05 * np.sin(4 * z) * north + 0.1 * x * p)


HEIGHT = (
    "displacement = 0.1 * sin(3 * position_object.x)"
    " * cos(2 * position_object.y - mesh_normal_object.z)"
)
VECTOR = (
    "displacement_vector = vec3(0.1 * uv.x * uv.y, 0.05 * sin(4 * position_object.z), 0.1 * st.x)"
)
CASES = {"a height": (HEIGHT, by_height), "a vector": (VECTOR, by_vector)}
MIRRORED = WORLD @ np.diag((-0.7, 1.0, 1.9, 1.0))


def expected_normal(moves: Moves, world: Floats) -> Floats:
    """Of the moved points themselves, by central differences."""

    def place(x: float, y: float) -> Floats:
        points = around(PLACES, x, y)
        return np.asarray((points + moves(points)) @ world[:3, :3].T)

    step = 1e-4
    east, north = place(step, 0) - place(-step, 0), place(0, step) - place(0, -step)
    found = np.cross(east, north) * np.sign(np.linalg.det(world[:3, :3]))
    return np.asarray(found / np.linalg.norm(found, axis=-1, keepdims=True))


@truth(
    "std.mtlx.displacement.Displaced", "std.mtlx.displacement.DisplacedSurface",
    "std.mtlx.displacement.displaced_here", "std.mtlx.displacement.displaced_beside",
)  # fmt: skip
@pytest.mark.parametrize("world", [WORLD, MIRRORED], ids=["turned", "mirrored"])
@pytest.mark.parametrize("case", CASES)
def test_points_move_and_normals_are_those_of_the_moved_ball(case: str, world: Floats) -> None:
    equation, moves = CASES[case]
    wanted = (PLACES + moves(PLACES)) @ world[:3, :3].T + world[:3, 3]
    assert drawn("position", equation, quads(), world) == close(wanted)
    normals = expected_normal(moves, world)
    for slot in ("normal", "normal_world"):
        assert np.abs(drawn(slot, equation, quads(), world) - normals).max() < 2e-4
    in_object = normals @ world[:3, :3]
    in_object /= np.linalg.norm(in_object, axis=-1, keepdims=True)
    assert np.abs(drawn("normal_object", equation, quads(), world) - in_object).max() < 2e-4


@pytest.mark.parametrize(("x", "y"), [(0.2, PIXEL), (PIXEL, 0.2)])
def test_the_surface_is_looked_at_nearby_where_it_is_seen_from_the_side(x: float, y: float) -> None:
    """The next pixel may be far away on it: then its height says nothing of the slope."""
    found = drawn("normal", HEIGHT, quads(x, y))
    assert np.abs(found - expected_normal(by_height, np.eye(4))).max() < 0.03


def test_an_even_displacement_moves_points_and_leaves_normals() -> None:
    assert drawn("position", "displacement = 0.25", quads()) == close(1.25 * PLACES)
    assert np.abs(drawn("normal", "displacement = 0.25", quads()) - PLACES).max() < 1e-9
    assert np.abs(drawn("normal", "", quads()) - PLACES).max() < 1e-9


def test_what_a_material_reads_of_a_mesh_is_not_moved() -> None:
    assert drawn("position_object", HEIGHT, quads()) == close(PLACES)
    assert drawn("position_world", HEIGHT, quads(), MIRRORED) == close(
        PLACES @ MIRRORED[:3, :3].T + MIRRORED[:3, 3]
    )
    assert drawn("mesh_normal_world", HEIGHT, quads()) == close(PLACES)


@truth("std.mtlx.displacement.displaced_normal", "std.mtlx.displacement.across")
def test_a_slope_tilts_a_plane() -> None:
    """Of a plane z = 2x + y, in whichever order its two ways are; where there are none, and where
    a surface is moved to a point, the normal stays."""
    up = np.array([[0.0, 0.0, 1.0]])
    way_x, way_y = np.array([[0.1, 0.0, 0.3]]), np.array([[0.0, 0.2, -0.1]])
    moved_x, moved_y = np.array([[0.0, 0.0, 0.2]]), np.array([[0.0, 0.0, 0.2]])
    call = "displaced_normal(n, a, b, p, q)"

    def bent(a: Floats, b: Floats, p: Floats, q: Floats) -> Floats:
        found = called(IMPORTS, call, 3, n=up, a=a, b=b, p=p, q=q)
        return np.asarray(found[0])

    wanted = np.array([-2.0, -1.0, 1.0]) / np.sqrt(6.0)
    assert bent(way_x, way_y, moved_x, moved_y) == close(wanted)
    assert bent(way_y, way_x, moved_y, moved_x) == close(wanted)
    zero = np.zeros((1, 3))
    assert bent(zero, zero, zero, zero) == close(up[0])
    assert bent(way_x, way_y, -way_x * (1, 1, 0), zero) == close(up[0])

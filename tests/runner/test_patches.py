"""Patches of meshes, and the patterns into which they are divided."""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.targets.runner.expanded_draws import as_drawn
from burnish.targets.runner.instances.host_values import MissingValuesError
from burnish.targets.runner.meshes import Mesh, MeshError, mesh
from burnish.targets.runner.patches import patches, pattern

POSITIONS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]], float)


def flat(*triangles: tuple[int, int, int], **more: object) -> Mesh:
    return Mesh({"position": POSITIONS}, np.array(triangles, np.int64).reshape(-1, 3), **more)  # type: ignore[arg-type]


def test_triangles_are_patches() -> None:
    whole = flat((0, 1, 2), (0, 2, 3))
    assert patches(whole, "triangle", 3, (0, 1, 2)).tolist() == [[0, 1, 2], [0, 2, 3]]


def test_pairs_of_triangles_are_quads_that_go_round() -> None:
    whole = flat((0, 1, 2), (0, 2, 3), (4, 5, 2), (1, 4, 2))
    assert patches(whole, "quad", 4, (0, 1, 2, 3)).tolist() == [[1, 2, 3, 0], [5, 2, 1, 4]]


def test_a_grid_has_quads_that_share_their_ends() -> None:
    whole = mesh("plane")
    position, cells = whole.channels["position"], 8
    quads = patches(whole, "quad", 4, (0, 1, 2, 3))
    assert len(quads) == cells * cells
    lower_left, lower_right, upper_right, upper_left = np.moveaxis(position[quads], 1, 0)
    assert (lower_right - lower_left == [0.25, 0, 0]).all()
    assert (upper_right - lower_right == [0, 0.25, 0]).all()
    assert (upper_left - upper_right == [-0.25, 0, 0]).all()
    bezier = patches(whole, "quad", 16, (0, 3, 15, 12))
    assert len(bezier) == 4
    assert bezier[0, 3] == bezier[1, 0] and bezier[0, 12] == bezier[2, 0]
    downwards = patches(whole, "quad", 16, (0, 12, 15, 3))
    assert downwards.tolist() == bezier.tolist()
    spline = patches(whole, "quad", 16, (5, 6, 10, 9))
    assert len(spline) == 36
    assert spline[0, 6] == spline[1, 5] and spline[0, 9] == spline[6, 5]


def test_a_small_grid_repeats_its_last_vertices() -> None:
    found = patches(mesh("cube"), "quad", 9, (0, 2, 8, 6))
    assert len(found) == 6
    a, b, c, d = patches(mesh("cube"), "quad", 4, (0, 1, 2, 3))[0]
    assert found[0].tolist() == [a, b, b, d, c, c, d, c, c]


@pytest.mark.parametrize(
    ("ends", "middles"),
    [((0, 2, 5), (1, 4, 3)), ((0, 2, 4), (1, 3, 5)), ((0, 1, 2), (3, 4, 5))],
    ids=["row by row", "round", "ends first"],
)
def test_a_grid_has_triangles_of_six_points(
    ends: tuple[int, ...], middles: tuple[int, ...]
) -> None:
    whole = mesh("plane")
    position = whole.channels["position"]
    found = patches(whole, "triangle", 6, ends)
    assert len(found) == 2 * 4 * 4
    corners = position[found[:, list(ends)]]
    between = (corners + np.roll(corners, -1, axis=1)) / 2
    assert (position[found[:, list(middles)]] == between).all()
    along, beside = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    assert (np.cross(along, beside) == [0, 0, 0.25]).all(), "counter-clockwise, and all of it"


@pytest.mark.parametrize("ends", [(0, 3, 9), (0, 3, 6), (0, 1, 2)])
def test_a_grid_has_triangles_of_ten_points(ends: tuple[int, ...]) -> None:
    whole = mesh("sphere")
    found = patches(whole, "triangle", 10, ends)
    assert len(found) == 2 * 21 * 10
    assert all(len(set(map(int, patch))) == 10 for patch in found)
    first, second = found[0, list(ends)], found[1, list(ends)]
    assert set(map(int, first)) & set(map(int, second)) == {int(first[1]), int(first[2])}


@pytest.mark.parametrize(("points", "ends"), [(4, (1, 2, 0)), (7, (0, 1, 2)), (32, (0, 10, 31))])
def test_a_grid_has_triangles_of_any_number_of_points(points: int, ends: tuple[int, ...]) -> None:
    whole = mesh("sphere")
    found = patches(whole, "triangle", points, ends)
    assert all(len(set(map(int, patch))) == points for patch in found)
    first, second = found[0, list(ends)], found[1, list(ends)]
    assert set(map(int, first)) & set(map(int, second)) == {int(first[1]), int(first[2])}


@pytest.mark.parametrize(
    ("points", "ends"), [(5, (0, 1, 2, 3)), (12, (0, 3, 6, 9)), (32, (9, 0, 31, 8))]
)
def test_a_grid_has_quads_of_any_number_of_points(points: int, ends: tuple[int, ...]) -> None:
    whole = mesh("plane")
    position = whole.channels["position"]
    found = patches(whole, "quad", points, ends)
    assert all(len(set(map(int, patch))) == points for patch in found)
    corners = position[found[:, list(ends)]]
    one, other = corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0]
    assert (one[:, 1:] == 0).all() and (other[:, [0, 2]] == 0).all(), "along u and along v"
    assert (one[:, 0] == other[:, 1]).all() and (one[:, 0] > 0).all()
    assert (corners[:, 2] == corners[:, 0] + one + other).all(), "and round them"


def test_a_grid_has_lines_of_several_points() -> None:
    whole = mesh("plane")
    row = patches(whole, "isoline", 3, (0, 2))[:4]
    assert row[:-1, 2].tolist() == row[1:, 0].tolist()
    along = np.diff(whole.channels["position"][row], axis=1)
    assert (along == [0.25, 0, 0]).all()
    spline = patches(whole, "isoline", 4, (1, 2))
    assert spline[0, 1:].tolist() == spline[1, :3].tolist()


def test_edges_are_lines() -> None:
    assert patches(flat((0, 1, 2), (0, 2, 3)), "isoline", 2, (0, 1)).tolist() == [
        [0, 1], [1, 2], [2, 0], [2, 3], [3, 0],
    ]  # fmt: skip


def test_a_mesh_says_its_own_control_points() -> None:
    own = np.array([[0, 1, 2, 3, 4, 5]], np.int64)
    whole = flat((0, 1, 2), patches=own)
    assert patches(whole, "triangle", 6, (0, 1, 2)).tolist() == own.tolist()
    with pytest.raises(MeshError, match="of the mesh have 6 control points, and this material div"):
        patches(whole, "triangle", 3, (0, 1, 2))


WRONG = {
    "control points": (flat((0, 1, 2)), "quad", 16, "of 16 control points, and the mesh has non"),
    "an odd one": (flat((0, 1, 2)), "quad", 4, "no pairs, so they make no quads"),
    "apart": (flat((0, 1, 2), (3, 4, 5)), "quad", 4, r"\[0, 1, 2\] and \[3, 4, 5\] share no edge"),
    "nothing": (flat(), "triangle", 3, "has no triangle patch to divide"),
}


@pytest.mark.parametrize(("whole", "patch", "points", "problem"), WRONG.values(), ids=WRONG)
def test_other_meshes_are_told(whole: Mesh, patch: str, points: int, problem: str) -> None:
    with pytest.raises(MeshError, match=problem):
        patches(whole, patch, points, ())  # type: ignore[arg-type]


@pytest.mark.parametrize("own", [np.zeros(3, np.int64), np.array([[0, 1, 9]])])
def test_patches_of_a_mesh_have_to_be_whole(own: np.ndarray) -> None:
    with pytest.raises(MeshError, match=r"patches have the shape|a patch names a vertex"):
        flat((0, 1, 2), patches=own)


def test_a_pattern_lies_in_its_patch() -> None:
    places, triangles = pattern("quad", "equal", (2, 1, 1, 1), (1, 1))
    assert places.tolist()[:2] == [[0, 1], [0, 0.5]]
    assert places.min() == 0 and places.max() == 1
    weights, _ = pattern("triangle", "fractional_odd", (3, 3, 3), (3,))
    assert weights.shape[1] == 3 and (weights.sum(axis=1) == 1).all()
    assert triangles.max() < len(places)


def test_levels_need_only_the_values_that_they_read() -> None:
    text = """import std.lights.{Point}
    import std.terms.{lambert}
    material M {
        param detail : float in 1..64
        tessellate triangle by 2 * detail {}
        color = lambert(vec3(1))
    }
    rig R { lamp : Point }"""
    (material,) = burnish.compile(text, "wgsl")
    instance = material.instance()
    with pytest.raises(MissingValuesError) as error:
        instance.patch_levels()
    assert error.value.names == ("detail",)
    instance.set("detail", 1.5)
    assert instance.patch_levels() == ((3.0,) * 3, (3.0,))
    assert instance.missing == ("lamp.place",)


def test_every_patch_is_an_instance_of_the_pattern() -> None:
    text = """material M {
        param detail : float in 1..64 = 2
        tessellate quad by detail as at { position = inherited.position + vec3(at, 0) }
        color = vec3(uv, 0)
    }"""
    (material,) = burnish.compile(text, "wgsl")
    row = material.reflection.draw
    assert (row.primitive, row.corners) == ("patch", 4)
    assert row.tessellation is not None and row.tessellation.divided_by == "instances"
    instance, plane = material.instance(), mesh("plane")
    instance.set("detail", 2.5)
    assert instance.patch_levels() == ((2.5,) * 4, (2.5,) * 2)
    names = {each.mesh.name for each in material.reflection.vertex_inputs if each.mesh}
    data = {name: np.zeros((len(plane), 3)) for name in names}
    data["vertex_position"] = plane.channels["position"]
    drawn = as_drawn(instance, data, plane)
    count = 64
    assert drawn.instance_count == count
    # Three steps along each edge.
    assert drawn.attributes["pattern.patch_coordinate"].shape == (16, 2)
    assert len(drawn.corners) == 2 * 9
    first = drawn.attributes["corner0.vertex_position"]
    found = patches(plane, "quad", 4, (0, 1, 2, 3))
    assert (first == plane.channels["position"][found[:, 0]]).all()

"""Patches of meshes, and the patterns into which they are divided."""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.targets.runner.expanding import as_drawn
from burnish.targets.runner.meshes import Mesh, MeshError, mesh
from burnish.targets.runner.patches import patches, pattern

POSITIONS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]], float)


def flat(*triangles: tuple[int, int, int], **more: object) -> Mesh:
    return Mesh({"position": POSITIONS}, np.array(triangles, np.int64).reshape(-1, 3), **more)  # type: ignore[arg-type]


def test_triangles_are_patches() -> None:
    whole = flat((0, 1, 2), (0, 2, 3))
    assert patches(whole, "triangle", 3).tolist() == [[0, 1, 2], [0, 2, 3]]


def test_pairs_of_triangles_are_quads_that_go_round() -> None:
    whole = flat((0, 1, 2), (0, 2, 3), (4, 5, 2), (1, 4, 2))
    assert patches(whole, "quad", 4).tolist() == [[1, 2, 3, 0], [5, 2, 1, 4]]


def test_edges_are_lines() -> None:
    assert patches(flat((0, 1, 2), (0, 2, 3)), "isoline", 2).tolist() == [
        [0, 1], [1, 2], [2, 0], [2, 3], [3, 0],
    ]  # fmt: skip


def test_a_mesh_says_its_own_control_points() -> None:
    own = np.array([[0, 1, 2, 3, 4, 5]], np.int64)
    whole = flat((0, 1, 2), patches=own)
    assert patches(whole, "triangle", 6).tolist() == own.tolist()
    with pytest.raises(MeshError, match="of the mesh have 6 control points, and this material div"):
        patches(whole, "triangle", 3)


WRONG = {
    "control points": (flat((0, 1, 2)), "quad", 16, "of 16 control points, and the mesh has tri"),
    "an odd one": (flat((0, 1, 2)), "quad", 4, "no pairs, so they make no quads"),
    "apart": (flat((0, 1, 2), (3, 4, 5)), "quad", 4, r"\[0, 1, 2\] and \[3, 4, 5\] share no edge"),
    "nothing": (flat(), "triangle", 3, "has no triangle patch to divide"),
}


@pytest.mark.parametrize(("whole", "patch", "points", "problem"), WRONG.values(), ids=WRONG)
def test_other_meshes_are_told(whole: Mesh, patch: str, points: int, problem: str) -> None:
    with pytest.raises(MeshError, match=problem):
        patches(whole, patch, points)  # type: ignore[arg-type]


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


def test_every_patch_is_an_instance_of_the_pattern() -> None:
    text = """material M {
        param detail : float in 1..64 = 2
        tessellate quad by detail as at { position = inherited.position + vec3(at, 0) }
        color = vec3(uv, 0)
    }"""
    (material,) = burnish.compile(text, "wgsl")
    row = material.reflection["draw"]
    assert (row["primitive"], row["corners"]) == ("patch", 4)
    assert row["tessellation"]["divided_by"] == "instances"
    instance, plane = material.instance(), mesh("plane")
    instance.set("detail", 2.5)
    assert instance.levels() == ((2.5,) * 4, (2.5,) * 2)
    names = {each["mesh"]["name"] for each in material.reflection["vertex_inputs"]}
    data = {name: np.zeros((len(plane), 3)) for name in names}
    data["vertex_position"] = plane.channels["position"]
    drawn = as_drawn(instance, data, plane)
    count = len(plane.triangles) // 2
    assert drawn.instance_count == count
    # Three steps along each edge.
    assert drawn.attributes["pattern.patch_coordinate"].shape == (16, 2)
    assert len(drawn.corners) == 2 * 9
    first = drawn.attributes["corner0.vertex_position"]
    found = patches(plane, "quad", 4)
    assert (first == plane.channels["position"][found[:, 0]]).all()

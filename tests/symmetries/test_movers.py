"""Whatever moves a mesh, all that belongs to a point of it moves along.

The same transform by the object, by an instance, by a bone and by a mixin of one's own has to make
the same point, and one that mirrors makes the mirror image, bumps included.
"""

from __future__ import annotations

from itertools import permutations
from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference.namespace import Lanes

from ..library.kit import (
    EYE,
    NORMAL,
    PLACE,
    WORLD,
    Floats,
    close,
    columns,
    lanes,
    of,
    shown,
    unit,
    upright,
)
from ..semantics.kit import Painted

IMPORTS = """
import std.billboards.{Billboard}
import std.instancing.{Instanced}
import std.morphing.{Morphed}
import std.motion.{moved_by}
import std.skinning.{Skinned}
import std.tangents.{Bumped, Tangents}

mixin Moved {
    param by : mat4 per draw = mat4(1)
    object_place = moved_by(by, inherited.object_place)
}
"""
TURN = np.array(
    [[0.4, -1.1, 0.3, 0.2], [0.9, 0.5, -0.1, -0.3], [0.2, 0.1, 1.3, 0.5], [0.0, 0.0, 0.0, 1.0]]
)
MIRROR = np.diag((-1.0, 1.0, 1.0, 1.0))
MOTIONS = {"turned": TURN, "mirrored": TURN @ MIRROR, "mirrored twice": MIRROR @ TURN @ MIRROR}
TANGENT = (0.7, -0.2, 0.4)
SLOTS = ("vec3(position)", "normal", "tangent", "bitangent")


def texel(u: float, v: float) -> Lanes:
    """A bump that leans to no side by chance."""
    return (0.2 + 0.5 * u, 0.9 - 0.4 * v, 0.85, 1.0)


MESH = {"vertex_tangent": (*TANGENT, -1.0), "normal_map": Painted(texel)}


def by_object(matrix: Floats, world: Floats) -> tuple[str, dict[str, Any]]:
    """The header of a material whose object a matrix moves before ``world``, and its inputs."""
    return "", {"object_to_world": columns(world @ matrix)}


def by_instance(matrix: Floats, world: Floats) -> tuple[str, dict[str, Any]]:
    own = {f"instance_transform.{i}": column for i, column in enumerate(columns(matrix))}
    return " + Instanced", {"object_to_world": columns(world), **own}


def by_bone(matrix: Floats, world: Floats) -> tuple[str, dict[str, Any]]:
    bones = tuple(columns(matrix if number == 3 else np.eye(4)) for number in range(128))
    own = {"vertex_joints": (3, 0, 0, 0), "vertex_weights": (1.0, 0.0, 0.0, 0.0), "bones": bones}
    return " + Skinned", {"object_to_world": columns(world), **own}


def by_mixin(matrix: Floats, world: Floats) -> tuple[str, dict[str, Any]]:
    return " + Moved", {"object_to_world": columns(world), "by": columns(matrix)}


WAYS = (by_instance, by_bone, by_mixin)


def seen(way: Any, matrix: Floats, world: Floats = WORLD, /, **given: Any) -> Floats:
    """Where a point with a bump lies and looks to, row by row."""
    mixins, moved = way(matrix, world)
    header = f"M : Surface{mixins} + Tangents + Bumped"
    return np.array([of(slot, header, IMPORTS, **{**MESH, **moved, **given}) for slot in SLOTS])


@pytest.mark.parametrize("matrix", MOTIONS.values(), ids=MOTIONS)
@pytest.mark.parametrize("way", WAYS)
def test_all_ways_to_move_a_mesh_are_alike(way: Any, matrix: Floats) -> None:
    assert seen(way, matrix) == close(seen(by_object, matrix))


@pytest.mark.parametrize("way", [by_object, *WAYS])
def test_a_mirrored_mesh_is_the_mirror_image(way: Any) -> None:
    """All vectors are mirrored as the mesh is, those in its bumps included."""
    place, *vectors = seen(way, np.eye(4), np.eye(4))
    mirrored = seen(way, MIRROR, np.eye(4))
    expected = [MIRROR[:3, :3] @ each for each in (place, *vectors)]
    assert mirrored == close(np.array(expected))


@pytest.mark.parametrize("order", [*permutations(("Tangents", "Morphed", "Skinned", "Instanced"))])
def test_the_order_of_mixins_has_no_effect(order: tuple[str, ...]) -> None:
    """A shape is morphed, then moved by bones, then placed; the expected numbers are NumPy's."""
    shift, lean, slant = np.array((0.5, -0.2, 0.7)), (-0.4, 0.1, 0.6), (0.3, 0.4, -0.2)
    bone = np.linalg.inv(TURN) @ MIRROR
    given = {
        **by_bone(bone, WORLD)[1], **by_instance(TURN, WORLD)[1], "morph": 0.3,
        "morph_position": lanes(shift), "morph_normal": lean, "morph_tangent": slant, **MESH,
    }  # fmt: skip
    whole = WORLD @ TURN @ bone
    header = f"M : Surface + {' + '.join(order)}"
    place = whole @ [*(np.array(PLACE) + 0.3 * shift), 1.0]
    assert of("vec3(position)", header, IMPORTS, **given) == close(place[:3])
    normal = unit(upright(whole, np.array(NORMAL) + 0.3 * np.array(lean)))
    assert of("normal", header, IMPORTS, **given) == close(normal)
    tangent = unit(whole[:3, :3] @ (np.array(TANGENT) + 0.3 * np.array(slant)))
    assert of("tangent", header, IMPORTS, **given) == close(tangent)
    # The bone mirrors, and the side of the mesh is -1: both together are the plain right hand.
    bitangent = np.cross(normal, tangent) * -1 * np.sign(np.linalg.det(whole[:3, :3]))
    assert of("bitangent", header, IMPORTS, **given) == close(bitangent)


@pytest.mark.parametrize("matrix", MOTIONS.values(), ids=MOTIONS)
@pytest.mark.parametrize("header", ["Billboard + Instanced", "Instanced + Billboard"])
def test_each_instance_of_a_billboard_turns_where_it_stands(header: str, matrix: Floats) -> None:
    """It is like an object of its own."""
    given = {**MESH, **by_instance(matrix, WORLD)[1]}
    alone = {**MESH, **by_object(matrix, WORLD)[1]}
    for slot in SLOTS:
        found = of(slot, f"M : Surface + {header} + Tangents + Bumped", IMPORTS, **given)
        expected = of(slot, "M : Surface + Tangents + Bumped + Billboard", IMPORTS, **alone)
        assert found == close(expected)


def test_a_billboard_faces_the_viewer_with_its_bumps() -> None:
    """The normal of a quad that faces +z, and its tangent along x, turn with the quad."""
    given = {
        "vertex_normal": (0.0, 0.0, 1.0), "vertex_tangent": (1.0, 0.0, 0.0, 1.0),
        "object_to_world": columns(np.eye(4)),
    }  # fmt: skip
    right = unit(np.cross((0.0, 1.0, 0.0), EYE))
    for slot, expected in (("tangent", right), ("bitangent", (0, 1, 0)),
                           ("normal", np.cross(right, (0, 1, 0)))):  # fmt: skip
        header = "M : Surface + Billboard + Tangents"
        assert of(slot, header, IMPORTS, **given) == close(expected)


def test_a_shape_of_its_own_moves_along() -> None:
    """A material that gives the mesh another shape is moved as that mesh would be."""
    members = "object_position = 0.5 * vertex_position  color = vec3(position)"
    text = f"{IMPORTS}\nabstract material A {{ {members} }}\nmaterial M : A + Instanced {{}}"
    given = {**by_instance(TURN, WORLD)[1]}
    found = of(
        "vec3(position)", "M", IMPORTS, **by_object(TURN @ np.diag((0.5, 0.5, 0.5, 1)), WORLD)[1]
    )
    assert shown(text, **given) == close(found)

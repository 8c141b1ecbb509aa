"""The library's mixins, which give meshes more attributes or move them, against NumPy."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from burnish.compiler.reference.namespace import Lanes

from ..semantics.kit import Painted
from .kit import (
    EYE,
    NORMAL,
    NORMAL_IN_WORLD,
    PLACE,
    TANGENT,
    WORLD,
    Floats,
    close,
    columns,
    moved,
    of,
    shown,
    unit,
    upright,
)
from .truth import truth

CHANCE = np.random.default_rng(20)
"""Numbers without a pattern, so that an exchange of lanes is seen."""


@truth("std.tangents.Tangents")
@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_tangents(sign: float, mirror: float) -> None:
    """In a mirrored object the third axis has the other sign."""
    header, imports = "M : Surface + Tangents", "import std.tangents.{Tangents}"
    world = WORLD @ np.diag((mirror, 1.0, 1.0, 1.0))
    normal, tangent = unit(upright(world, NORMAL)), unit(world[:3, :3] @ TANGENT)
    bitangent = np.cross(normal, tangent) * sign * mirror
    arrow = (0.3, -0.6, 0.9)
    basis = tangent * arrow[0] + bitangent * arrow[1] + normal * arrow[2]
    given = {"vertex_tangent": (*TANGENT, sign), "object_to_world": columns(world)}
    assert of("tangent", header, imports, **given) == close(tangent)
    assert of("bitangent", header, imports, **given) == close(bitangent)
    found = of("(vec3(0.3, -0.6, 0.9) as vector<tangent>) in world", header, imports, **given)
    assert found == close(basis)


@truth("std.tangents.Bumped")
def test_a_normal_map_bends_the_normal() -> None:
    def texel(u: float, v: float) -> Lanes:
        return (0.2 + 0.5 * u, 0.9 - 0.4 * v, 0.85, 1.0)

    tangent = unit(WORLD[:3, :3] @ TANGENT)
    x, y, z = (2.0 * lane - 1.0 for lane in texel(0.3, 0.8)[:3])
    bent = tangent * x - np.cross(NORMAL_IN_WORLD, tangent) * y + NORMAL_IN_WORLD * z
    header, imports = "M : Surface + Tangents + Bumped", "import std.tangents.{Tangents, Bumped}"
    found = of("normal", header, imports,
               vertex_tangent=(*TANGENT, -1.0), normal_map=Painted(texel))  # fmt: skip
    assert found == close(unit(bent))


BONES = np.zeros((128, 4, 4))
BONES[:, 3, 3] = 1.0
BONES[:, :3, :] = np.eye(3, 4) + 0.3 * CHANCE.uniform(-1.0, 1.0, (128, 3, 4))
JOINTS, WEIGHTS = (5, 2, 63, 17), (0.4, 0.1, 0.3, 0.2)
SKIN = sum(weight * BONES[joint] for joint, weight in zip(JOINTS, WEIGHTS, strict=True))
SKINNED = {
    "vertex_joints": JOINTS, "vertex_weights": WEIGHTS, "bones": tuple(map(columns, BONES)),
}  # fmt: skip


@truth("std.skinning.Skinned")
def test_bones_move_a_vertex() -> None:
    header, imports = "M : Surface + Skinned", "import std.skinning.{Skinned}"
    place = moved(WORLD, moved(np.asarray(SKIN), PLACE))
    assert of("position", header, imports, **SKINNED) == close(place)
    normal = unit(upright(WORLD, upright(SKIN, NORMAL)))
    assert of("normal", header, imports, **SKINNED) == close(normal)


@truth("std.skinning.Skinned")
def test_bones_move_a_tangent() -> None:
    found = of("tangent", "M : Surface + Tangents + Skinned",
               "import std.skinning.{Skinned}\nimport std.tangents.{Tangents}",
               vertex_tangent=(*TANGENT, 1.0), **SKINNED)  # fmt: skip
    assert found == close(unit(WORLD[:3, :3] @ np.asarray(SKIN)[:3, :3] @ TANGENT))


@truth("std.prelude.Surface", "std.motion.at_rest")
def test_motion_as_a_whole_begins_behind_bones() -> None:
    """Billboards ask where an object stands, whatever its bones do."""
    found = of("(object_place.motion * vec4(1, 2, 3, 1)).xyz", "M : Surface + Skinned",
               "import std.skinning.{Skinned}", **SKINNED)  # fmt: skip
    assert found == close((1, 2, 3))


@truth("std.morphing.Morphed")
def test_a_mesh_on_its_way_to_another_shape() -> None:
    header, imports = "M : Surface + Morphed", "import std.morphing.{Morphed}"
    given = {"morph": 0.3, "morph_position": (0.5, -0.2, 0.7), "morph_normal": (-0.4, 0.1, 0.6)}
    place = moved(WORLD, np.array(PLACE) + 0.3 * np.array((0.5, -0.2, 0.7)))
    normal = unit(upright(WORLD, np.array(NORMAL) + 0.3 * np.array((-0.4, 0.1, 0.6))))
    assert of("position", header, imports, **given) == close(place)
    assert of("normal", header, imports, **given) == close(normal)


@truth("std.morphing.Morphed")
def test_tangents_change_with_a_shape() -> None:
    imports = "import std.morphing.{Morphed}\nimport std.tangents.{Tangents}"
    given = {"vertex_tangent": (*TANGENT, 1.0), "morph": 0.3, "morph_tangent": (-0.9, 0.5, 0.2)}
    found = of("tangent", "M : Surface + Tangents + Morphed", imports, **given)
    changed = np.array(TANGENT) + 0.3 * np.array((-0.9, 0.5, 0.2))
    assert found == close(unit(WORLD[:3, :3] @ changed))


@truth("std.instancing.Instanced")
def test_an_instance_stands_where_its_transform_says() -> None:
    header, imports = "M : Surface + Instanced", "import std.instancing.{Instanced}"
    own = np.eye(4)
    own[:3] += 0.4 * CHANCE.uniform(-1.0, 1.0, (3, 4))
    # A matrix at the vertices is one input for each column.
    given = {f"instance_transform.{i}": column for i, column in enumerate(columns(own))}
    assert of("position", header, imports, **given) == close(moved(WORLD, moved(own, PLACE)))
    normal = unit(upright(WORLD, upright(own, NORMAL)))
    assert of("normal", header, imports, **given) == close(normal)


def facing(world: Floats, eye: Sequence[float] = EYE) -> Floats:
    """A billboard's transform instead of this one: upright, as large, and turned to the eye.

    One that mirrors is mirrored along x.
    """
    center, scale = world[:3, 3], np.linalg.norm(world[:3, :3], axis=0)
    scale[0] *= np.sign(np.linalg.det(world[:3, :3]))
    right = unit(np.cross((0.0, 1.0, 0.0), eye - center))
    found = np.eye(4)
    found[:3, 0], found[:3, 1] = scale[0] * right, (0.0, scale[1], 0.0)
    found[:3, 2], found[:3, 3] = scale[2] * unit(np.cross(right, (0.0, 1.0, 0.0))), center
    return found


@truth("std.billboards.Billboard")
@pytest.mark.parametrize("mirror", [1.0, -1.0])
@pytest.mark.parametrize("eye", [EYE, (-2.5, 0.4, -1.2)])
def test_a_billboard_faces_the_viewer(mirror: float, eye: tuple[float, float, float]) -> None:
    header, imports = "M : Surface + Billboard", "import std.billboards.{Billboard}"
    world = WORLD @ np.diag((mirror, 1.0, 1.0, 1.0))
    turned, given = facing(world, eye), {"object_to_world": columns(world), "eye": eye}
    assert of("position", header, imports, **given) == close(moved(turned, PLACE))
    assert of("normal", header, imports, **given) == close(unit(upright(turned, NORMAL)))
    last_row = of("object_to_world[0].w, object_to_world[1].w, object_to_world[2].w",
                  header, imports, **given)  # fmt: skip
    assert last_row == close((0, 0, 0))
    assert of("object_to_world[3].w", header, imports, **given) == close([1] * 3)


@truth("std.billboards.Billboard")
def test_each_instance_of_a_billboard_turns_where_it_stands() -> None:
    imports = "import std.billboards.{Billboard}\nimport std.instancing.{Instanced}"
    own = np.diag((-1.5, 0.5, 2.0, 1.0)) + 0.1 * CHANCE.uniform(-1.0, 1.0, (4, 4))
    own[3] = (0.0, 0.0, 0.0, 1.0)
    given = {f"instance_transform.{i}": column for i, column in enumerate(columns(own))}
    place = moved(facing(WORLD @ own), PLACE)
    for header in ("M : Surface + Instanced + Billboard", "M : Surface + Billboard + Instanced"):
        assert of("position", header, imports, **given) == close(place)


@truth("std.vertices.VertexColors", "std.vertices.SecondUv")
def test_more_attributes() -> None:
    imports = "import std.vertices.{VertexColors, SecondUv}"
    given = {"vertex_color": (0.5, 0.25, 0.125, 0.3), "vertex_uv2": (0.6, 0.9)}
    found = of("vec3(0.8, 0.4, 0.2)", "M", "", **given)
    painted = shown(
        f"{imports}\nabstract material A {{ color = vec3(0.8, 0.4, 0.2) }}\n"
        "material M : A + VertexColors {}", **given,
    )  # fmt: skip
    assert painted == close(found * (0.5, 0.25, 0.125))
    seen = of("vec3(alpha, uv2)", "M : A + VertexColors + SecondUv",
              f"{imports}\nabstract material A {{ alpha = 0.5 }}", **given)  # fmt: skip
    assert seen == close(np.array((0.15, 0.6, 0.9)))


MOVING = np.array(
    [[0.9, 0.3, -0.2, 0.5], [-0.1, 1.1, 0.4, -0.3], [0.2, -0.5, 0.8, 0.7], [0, 0, 0, 1]]
)


@truth("std.motion.moved_by", "std.motion.at_rest", "std.motion.mirrors", "std.motion.MeshPoint")
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_all_that_a_mesh_has_moves_along(sign: float) -> None:
    """A mirrored mesh has the other hand; the motion counts from the resting place."""
    matrix = MOVING @ np.diag((sign, 1.0, 1.0, 1.0))
    header = "M : Surface + Tangents"
    imports = "import std.motion.{moved_by, at_rest, mirrors}\nimport std.tangents.{Tangents}"
    given = {"vertex_tangent": (*TANGENT, 1.0)}
    columns_ = (f"vec4({', '.join(map(repr, map(float, column)))})" for column in matrix.T)
    by = f"mat4({', '.join(columns_)})"
    single = f"moved_by({by}, object_shape)"
    point, rested = f"moved_by({by}, {single})", f"moved_by({by}, at_rest({single}))"
    twice = matrix @ matrix
    assert of(f"{point}.position", header, imports, **given) == close(moved(twice, PLACE))
    assert of(f"{point}.tangent", header, imports, **given) == close(twice[:3, :3] @ TANGENT)
    assert of(f"{point}.normal", header, imports, **given) == close(upright(twice, NORMAL))
    assert of(f"{point}.handedness", header, imports, **given) == close([1.0] * 3)
    assert of(f"{single}.handedness", header, imports, **given) == close([sign] * 3)
    assert of(f"({point}.motion * vec4(1, 2, 3, 1)).xyz", header, imports, **given) == close(
        moved(twice, (1, 2, 3))
    )
    assert of(f"({rested}.motion * vec4(1, 2, 3, 1)).xyz", header, imports, **given) == close(
        moved(matrix, (1, 2, 3))
    )
    assert of(f"{rested}.position", header, imports, **given) == close(moved(twice, PLACE))
    assert of(f"{rested}.tangent", header, imports, **given) == close(twice[:3, :3] @ TANGENT)
    assert of(f"{rested}.normal", header, imports, **given) == close(upright(twice, NORMAL))
    assert of(f"{rested}.handedness", header, imports, **given) == close([1.0] * 3)


@truth("std.motion.mirrors")
@pytest.mark.parametrize(
    ("depth", "is_mirrored"), [(1, 0), (0.5, 0), (1e-6, 0), (0, 0), (-1e-6, 1), (-0.5, 1)]
)
def test_a_transform_mirrors_if_it_turns_space_inside_out(depth: float, is_mirrored: int) -> None:
    """One that makes everything flat does not."""
    diagonal = f"mat3(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, {depth}))"
    found = of(f"float(mirrors({diagonal}))", "M", "import std.motion.{mirrors}")
    assert found == close([is_mirrored] * 3)

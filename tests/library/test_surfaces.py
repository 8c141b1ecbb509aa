"""The library's surfaces, mixins and transforms, against NumPy.

``truth.py`` says why.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from burnish.compiler.ir.stages import CLIP_POSITION, TARGET
from burnish.compiler.reference.namespace import Lanes

from ..semantics.kit import Painted, at, shader
from .kit import (
    CLIP,
    EYE,
    MESH,
    NORMAL,
    NORMAL_IN_WORLD,
    PLACE,
    POSITION_IN_WORLD,
    TO_EYE,
    WORLD,
    Floats,
    close,
    columns,
    matrix,
    moved,
    of,
    shown,
    unit,
    upright,
)
from .truth import truth

CHANCE = np.random.default_rng(20)
"""Numbers without a pattern, so that an exchange of lanes is seen."""

# --- surfaces ------------------------------------------------------------------------------------


@truth("std.prelude.Surface", "std.prelude.pi")
@pytest.mark.parametrize(
    ("slot", "expected"),
    [
        ("position", POSITION_IN_WORLD),
        ("normal", NORMAL_IN_WORLD),
        ("to_eye", TO_EYE),
        ("object_position", PLACE),
        ("vec3(uv, pi)", (0.3, 0.8, math.pi)),
        ("ambient_light", (0.1, 0.1, 0.1)),
    ],
)
def test_a_surface(slot: str, expected: Any) -> None:
    assert of(slot) == close(expected)


def clip_position(text: str, **given: Any) -> Lanes:
    whole = shader(text)
    return at(whole, whole.results_of(CLIP_POSITION)[0].value, {**MESH, **given})


@truth("std.prelude.Surface")
def test_a_surface_in_clip_space() -> None:
    assert clip_position("material M {}") == close(CLIP @ [*POSITION_IN_WORLD, 1.0])


@truth("std.prelude.Forward")
def test_the_librarys_pass_writes_colour_and_alpha() -> None:
    whole = shader("material M { color = vec3(0.5, 0.25, 0.75)  alpha = 0.125 }")
    (target,) = whole.results_of(TARGET)
    assert at(whole, target.value, MESH) == close((0.5, 0.25, 0.75, 0.125))


# --- mixins --------------------------------------------------------------------------------------

TANGENT = (0.7, -0.2, 0.4)


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


@truth("std.spaces.upright", "std.spaces.upright_back")
def test_what_is_at_a_right_angle_stays_so_in_any_axes() -> None:
    """The tangent leans towards the normal, so the inverse transpose is no longer the matrix."""
    header, imports = "M : Surface + Tangents", "import std.tangents.{Tangents}"
    tangent = unit(WORLD[:3, :3] @ TANGENT)
    axes = np.stack([tangent, np.cross(NORMAL_IN_WORLD, tangent), NORMAL_IN_WORLD], axis=1)
    arrow, given = np.array((0.3, -0.6, 0.9)), {"vertex_tangent": (*TANGENT, 1.0)}
    there = of("(vec3(0.3, -0.6, 0.9) as covector<tangent>) in world", header, imports, **given)
    assert there == close(np.linalg.inv(axes).T @ arrow)
    back = of("(vec3(0.3, -0.6, 0.9) as covector<world>) in tangent", header, imports, **given)
    assert back == close(axes.T @ arrow)


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
JOINTS, WEIGHTS = (5, 0, 63, 17), (0.4, 0.1, 0.3, 0.2)
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


def facing(world: Floats) -> Floats:
    """A billboard's transform instead of this one: upright, as large, and turned to the eye.

    One that mirrors is mirrored along x.
    """
    center, scale = world[:3, 3], np.linalg.norm(world[:3, :3], axis=0)
    scale[0] *= np.sign(np.linalg.det(world[:3, :3]))
    right = unit(np.cross((0.0, 1.0, 0.0), EYE - center))
    found = np.eye(4)
    found[:3, 0], found[:3, 1] = scale[0] * right, (0.0, scale[1], 0.0)
    found[:3, 2], found[:3, 3] = scale[2] * unit(np.cross(right, (0.0, 1.0, 0.0))), center
    return found


@truth("std.billboards.Billboard")
@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_a_billboard_faces_the_viewer(mirror: float) -> None:
    header, imports = "M : Surface + Billboard", "import std.billboards.{Billboard}"
    world = WORLD @ np.diag((mirror, 1.0, 1.0, 1.0))
    turned, given = facing(world), {"object_to_world": columns(world)}
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


@truth("std.motion.mirrors")
@pytest.mark.parametrize(("depth", "is_mirrored"), [(1, 0), (0.5, 0), (0, 0), (-0.5, 1)])
def test_a_transform_mirrors_if_it_turns_space_inside_out(depth: float, is_mirrored: int) -> None:
    """One that makes everything flat does not."""
    diagonal = f"mat3(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, {depth}))"
    found = of(f"float(mirrors({diagonal}))", "M", "import std.motion.{mirrors}")
    assert found == close([is_mirrored] * 3)


# --- spaces and transforms -----------------------------------------------------------------------


@truth("std.spaces.moved", "std.spaces.upright", "std.spaces.upright_back", "std.spaces.matrix")
@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("(vec3(0.2, -0.7, 0.5) as point<object>) in world", moved(WORLD, (0.2, -0.7, 0.5))),
        ("(vec3(0.2, -0.7, 0.5) as vector<object>) in world", WORLD[:3, :3] @ (0.2, -0.7, 0.5)),
        (
            "(vec3(0.2, -0.7, 0.5) as point<world>) in object",
            moved(np.linalg.inv(WORLD), (0.2, -0.7, 0.5)),
        ),
        ("(vec3(0.2, -0.7, 0.5) as covector<object>) in world", upright(WORLD, (0.2, -0.7, 0.5))),
        (
            "(vec3(0.2, -0.7, 0.5) as covector<world>) in object",
            upright(np.linalg.inv(WORLD), (0.2, -0.7, 0.5)),
        ),
    ],
)
def test_from_one_space_to_another(expression: str, expected: Any) -> None:
    assert of(expression) == close(expected)


def turning(axis: Sequence[float], angle: float) -> Floats:
    """The rotation as the exponential of its generator, by its series."""
    x, y, z = unit(axis)
    generator = angle * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    term, total = np.eye(3), np.eye(3)
    for n in range(1, 30):
        term = term @ generator / n
        total = total + term
    return total


@truth("std.transforms.translation", "std.transforms.scaling")
def test_translation_and_scale() -> None:
    expected = np.eye(4)
    expected[:3, 3] = (0.2, -0.7, 0.5)
    assert matrix("translation((vec3(0.2, -0.7, 0.5) as vector<world>))") == close(expected)
    assert matrix("scaling(vec3(2, 3, 5))") == close(np.diag((2, 3, 5, 1)))


@truth("std.transforms.rotation", "std.transforms.turned")
@pytest.mark.parametrize("angle", [0.7, -2.5])
def test_rotation(angle: float) -> None:
    expected = np.eye(4)
    expected[:3, :3] = turning((2.0, -1.0, 2.0), angle)
    axis = "(normalize(vec3(2, -1, 2)) as direction<world>)"
    assert matrix(f"rotation({axis}, {angle}rad)") == close(expected)


@truth("std.transforms.look_at")
def test_looking_at_a_place() -> None:
    eye, target, up = np.array((1.0, 2.0, 3.0)), np.array((-0.5, 0.4, 0.2)), (0.1, 1.0, 0.0)
    seen = matrix(
        "look_at((vec3(1, 2, 3) as point<world>), (vec3(-0.5, 0.4, 0.2) as point<world>),"
        " (vec3(0.1, 1, 0) as vector<world>))"
    )
    assert moved(seen, eye) == close((0, 0, 0))
    ahead = moved(seen, target)
    assert ahead == close((0, 0, -np.linalg.norm(target - eye)))
    above = seen[:3, :3] @ np.asarray(up)
    assert above[0] == pytest.approx(0.0, abs=1e-12) and above[1] > 0
    assert seen[:3, :3] @ seen[:3, :3].T == close(np.eye(3))
    assert np.linalg.det(seen[:3, :3]) == pytest.approx(1.0)


@truth("std.transforms.perspective")
def test_perspective() -> None:
    lens = matrix("perspective(50deg, 1.5, 0.5, 20)")
    edge = math.tan(math.radians(25.0))

    def projected(*place: float) -> Floats:
        clip = lens @ (*place, 1.0)
        return np.asarray(clip[:3] / clip[3])

    assert projected(1.5 * edge * 4, edge * 4, -4)[:2] == close((1, 1))
    assert projected(0, 0, -0.5) == close((0, 0, 0))
    assert projected(0, 0, -20) == close((0, 0, 1))
    assert lens @ (0, 0, -7, 1) == close((0, 0, 20 / 19.5 * 7 - 10 / 19.5, 7))


@truth("std.transforms.orthographic")
def test_orthographic() -> None:
    lens = matrix("orthographic(6, 4, 0.5, 20)")
    assert lens @ (3, 2, -0.5, 1) == close((1, 1, 0, 1))
    assert lens @ (-3, -2, -20, 1) == close((-1, -1, 1, 1))


SUN = np.array([0.36, -0.8, 0.48])
"""The direction in which the light travels."""


@truth(
    "std.shadows.cascade",
    "std.shadows.corner",
    "std.shadows.how_far",
    "std.shadows.slice_end",
    "std.shadows.seen_by_sun",
)
@pytest.mark.parametrize("number", [0, 1, 2])
def test_a_cascade_contains_its_slice_of_the_view_and_what_shades_it(number: int) -> None:
    camera = "perspective(60deg, 2, 0.5, 4.5) * look_at({eye}, {target}, {up})".format(
        eye="(vec3(0, 0, 5) as point<world>)", target="(vec3(0) as point<world>)",
        up="(vec3(0, 1, 0) as vector<world>)",
    )  # fmt: skip
    sun = "(vec3(0.36, -0.8, 0.48) as direction<world>)"
    cascade = matrix(f"cascade({camera}, {sun}, {number}, 3, 7)")

    # Half way between equal depths, and equal ratios, 9 ^ (i / 3).
    ends = [0.5 * (0.5 + 4 * i / 3 + 0.5 * 9 ** (i / 3)) for i in (number, number + 1)]
    steep = math.tan(math.radians(30))
    corners = np.array([
        (x * 2 * steep * d, y * steep * d, 5 - d) for d in ends for x in (-1, 1) for y in (-1, 1)
    ])  # fmt: skip
    # A ball around the corners, seen from behind everything that shades it.
    middle = corners.mean(axis=0)
    radius = np.linalg.norm(corners - middle, axis=1).max()
    for place in (*corners, *(corners - 7 * SUN)):
        x, y, depth = moved(cascade, place)
        along = float((place - middle) @ SUN)
        beside = np.linalg.norm(place - middle - along * SUN)
        assert math.hypot(x, y) == pytest.approx(beside / radius)
        assert depth == pytest.approx((along + radius + 7) / (2 * radius + 7))
        assert depth > -1e-9
    assert np.linalg.det(cascade[:3, :3]) < 0  # Depths grow away from the sun: not mirrored.


@truth("std.shadows.slice_end", "std.shadows.how_far", "std.shadows.cascade")
def test_slices_of_a_view_without_a_perspective_are_equally_deep() -> None:
    camera = "orthographic(4, 2, 1, 10) * look_at({eye}, {target}, {up})".format(
        eye="(vec3(0, 0, 5) as point<world>)", target="(vec3(0) as point<world>)",
        up="(vec3(0, 1, 0) as vector<world>)",
    )  # fmt: skip
    cascade = matrix(f"cascade({camera}, (vec3(0, -1, 0) as direction<world>), 1, 3, 2)")
    # The second third of the way from 4 to -5, around (0, 0, -0.5), 4 by 2 by 3 large.
    radius = math.sqrt(2**2 + 1**2 + 1.5**2)
    assert moved(cascade, (0.0, radius + 2, -0.5)) == close((0, 0, 0))
    assert moved(cascade, (0.0, -radius, -0.5)) == close((0, 0, 1))
    assert abs(moved(cascade, (radius, 0.0, -0.5))[0]) == pytest.approx(1)

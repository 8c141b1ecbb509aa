"""What surfaces of MaterialX read of a mesh, against NumPy: in a turned, stretched and mirrored
object."""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.runner.cameras import looking
from burnish.targets.runner.meshes import Mesh
from burnish.targets.runner.reference import expected
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import set_up

from .kit import (
    EYE,
    NORMAL,
    PLACE,
    TANGENT,
    WORLD,
    Floats,
    close,
    columns,
    moved,
    of,
    unit,
    upright,
)
from .truth import truth

IMPORTS = "import std.mtlx.surface"
HEADER = "M : MaterialXSurface"
ARROW = (0.3, -0.6, 0.9)
WRITTEN = "vec3(0.3, -0.6, 0.9)"


def _world(mirror: float) -> Floats:
    """A transform that turns, stretches each axis differently, and perhaps mirrors."""
    return np.asarray(WORLD @ np.diag((mirror * 0.7, 1.0, 1.9, 1.0)))


def _seen(expression: str, mirror: float = 1.0, sign: float = 1.0) -> Floats:
    """The value of an expression in a material that is imported, on the mesh."""
    given = {"vertex_tangent": (*TANGENT, sign), "object_to_world": columns(_world(mirror))}
    return of(expression, HEADER, IMPORTS, **given)


@truth("std.mtlx.surface.MaterialXSurface")
@pytest.mark.parametrize(("mirror", "sign"), [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0)])
def test_the_axes_of_the_mesh(mirror: float, sign: float) -> None:
    """In a mirrored object, the third axis of the world has the other sign."""
    world = _world(mirror)
    normal, tangent = unit(NORMAL), unit(TANGENT)
    assert _seen("normal_object", mirror, sign) == close(normal)
    assert _seen("tangent_object", mirror, sign) == close(tangent)
    assert _seen("bitangent_object", mirror, sign) == close(unit(np.cross(normal, tangent)) * sign)
    normal, tangent = unit(upright(world, NORMAL)), unit(world[:3, :3] @ TANGENT)
    third = unit(np.cross(normal, tangent)) * sign * mirror
    assert _seen("normal_world", mirror, sign) == close(normal)
    assert _seen("tangent_world", mirror, sign) == close(tangent)
    assert _seen("bitangent_world", mirror, sign) == close(third)


AXES = tuple(
    f"{axis}_{space}"
    for space in ("object", "world")
    for axis in ("normal", "tangent", "bitangent")
)
CORNERS = np.array([[-2.0, -2.0, 0.0], [2.0, -2.0, 0.4], [0.0, 2.5, -0.3]])
NORMALS = np.array([[0.1, 0.4, 1.5], [-0.3, 0.05, 0.4], [0.2, -1.0, 2.0]])
TANGENTS = np.array([[0.6, 0.1, 0.2], [1.5, -0.4, 0.3], [0.9, 0.8, -0.1]])
"""A triangle whose normals and tangents have different lengths."""
SHAPE = np.array([[0.8, 0.2, 0.0, 0.1], [0, 0.9, -0.3, 0], [0.1, 0, 1.3, 0.2], [0, 0, 0, 1]])


@truth("std.mtlx.surface.MaterialXSurface")
def test_axes_have_length_one_before_and_after_they_are_interpolated() -> None:
    shown = ("position_object", *AXES)
    targets = [f"target t{i} : rgba32f = vec4(material.{each}, 1)" for i, each in enumerate(shown)]
    text = (
        f"burnish 1\n{IMPORTS}.{{MaterialXSurface}}\nmaterial {HEADER} {{ }}\n"
        "pass P {\n" + "\n".join(targets) + "\n}"
    )
    material = burnish.compile(text, (), pass_="P").materials[0]
    tangents = np.column_stack([TANGENTS, np.ones(3)])
    uv = np.zeros((3, 2))
    channels = {"position": CORNERS, "normal": NORMALS, "tangent": tangents, "uv": uv}
    scene = Scene(looking(eye=(0.0, 0.0, 6.0)), tuple(map(tuple, SHAPE.tolist())))
    state = set_up(material.instance(), Mesh(channels, np.array([[0, 1, 2]])), scene, (9, 9))
    at, *drawn = expected(material.shader, state, RasterRules(9, 9)).targets
    seen = at[..., 3] == 1
    shares = np.linalg.solve(CORNERS.T, at[seen][:, :3].T).T
    assert len(shares) > 9
    to_world = SHAPE[:3, :3]
    for space, normals, tangents in (
        ("object", NORMALS, TANGENTS),
        ("world", NORMALS @ np.linalg.inv(to_world), TANGENTS @ to_world.T),
    ):
        axes = [units(normals), units(tangents)]
        axes.append(np.cross(axes[0], axes[1]))
        for name, axis in zip(("normal", "tangent", "bitangent"), axes, strict=True):
            found = drawn[AXES.index(f"{name}_{space}")][seen][:, :3]
            assert found == pytest.approx(units(shares @ axis), abs=1e-6), (name, space)


def units(vectors: Floats) -> Floats:
    """Vectors in rows, made as long as one."""
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))


@truth("std.mtlx.surface.third_axis")
def test_the_third_axis_depends_on_no_length() -> None:
    two = ", ".join(f"vec3({x}, {y}, {z})" for x, y, z in (NORMAL, TANGENT))
    third = np.cross(unit(NORMAL), unit(TANGENT))
    assert _seen(f"third_axis({two}, -1)") == close(-third)


@truth("std.mtlx.surface.MaterialXSurface")
@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_the_point_and_the_way_to_the_eye(mirror: float) -> None:
    world = _world(mirror)
    place = moved(world, PLACE)
    to_eye = unit(np.array(EYE) - place)
    assert _seen("position_object", mirror) == close(PLACE)
    assert _seen("position_world", mirror) == close(place)
    assert _seen("view_world", mirror) == close(-to_eye)
    inverse = np.linalg.inv(world[:3, :3])
    assert _seen("view_object", mirror) == close(unit(inverse @ -to_eye))


@truth("std.mtlx.surface.MaterialXSurface")
def test_a_bent_normal_leaves_the_axes_of_the_mesh() -> None:
    text = (
        f"{IMPORTS}\nabstract material Bent : MaterialXSurface {{ normal = normalize({WRITTEN}) }}"
    )
    given = {"vertex_tangent": (*TANGENT, 1.0), "object_to_world": columns(WORLD)}
    normal, tangent = unit(upright(WORLD, NORMAL)), unit(WORLD[:3, :3] @ TANGENT)
    assert of("normal_world", "M : Bent", text, **given) == close(normal)
    assert of("bitangent_world", "M : Bent", text, **given) == close(
        unit(np.cross(normal, tangent))
    )


@truth("std.mtlx.surface.MaterialXSurface", "std.mtlx.surface.upright")
def test_coordinates_of_textures_run_upwards() -> None:
    assert _seen("st, 0") == close((0.3, 0.2, 0.0))
    assert _seen("upright(vec2(0.4, 0.9)), 0") == close((0.4, 0.1, 0.0))


@truth("std.mtlx.surface.MaterialXSurface")
def test_a_surface_without_a_clock_stands_at_its_beginning() -> None:
    assert _seen("time, frame, 0") == close((0.0, 0.0, 0.0))
    given = {"vertex_tangent": (*TANGENT, 1.0), "time": 2.5, "frame": 60.0}
    assert of("time, frame, 0", HEADER, IMPORTS, **given) == close((2.5, 60.0, 0.0))


@truth(
    *(
        f"std.mtlx.surface.{kind}_to_{space}"
        for kind in ("point", "vector", "normal")
        for space in ("world", "object")
    )
)
@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_moves_between_the_object_and_the_world(mirror: float) -> None:
    world = _world(mirror)
    back = np.asarray(np.linalg.inv(world), np.float64)
    expected = {
        "point_to_world": moved(world, ARROW),
        "point_to_object": moved(back, ARROW),
        "vector_to_world": world[:3, :3] @ ARROW,
        "vector_to_object": back[:3, :3] @ ARROW,
        "normal_to_world": unit(upright(world, ARROW)),
        "normal_to_object": unit(upright(back, ARROW)),
    }
    for name, value in expected.items():
        assert _seen(f"{name}({WRITTEN})", mirror) == close(value), name

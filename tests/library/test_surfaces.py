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

from ..semantics.kit import at, shader
from .kit import (
    CLIP,
    MESH,
    NORMAL_IN_WORLD,
    PLACE,
    POSITION_IN_WORLD,
    TANGENT,
    TO_EYE,
    WORLD,
    Floats,
    close,
    matrix,
    moved,
    of,
    unit,
    upright,
)
from .truth import truth

# --- surfaces ------------------------------------------------------------------------------------


@truth("std.prelude.Surface", "std.prelude.pi")
@pytest.mark.parametrize(
    ("slot", "expected"),
    [
        ("position", POSITION_IN_WORLD),
        ("normal", NORMAL_IN_WORLD),
        ("to_eye", TO_EYE),
        ("object_position", PLACE),
        ("object_tangent", (0.0, 0.0, 0.0)),
        ("float(is_hidden)", (0.0, 0.0, 0.0)),
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


# --- spaces and transforms -----------------------------------------------------------------------


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

"""A mesh of one point, and what the library makes of it: for tests that compare it with NumPy.

The tests write the library's formulas anew, from what papers and its comments say (``truth.py``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.namespace import Lanes

from ..semantics.kit import Given, at, color, shader

Floats = NDArray[np.float64]


def unit(v: Any) -> Floats:
    """The vector of length one in the same direction."""
    return np.asarray(np.asarray(v, np.float64) / np.linalg.norm(v))


def columns(m: Any) -> Lanes:
    """A matrix as the kit takes it."""
    return tuple(tuple(map(float, column)) for column in np.asarray(m).T)


def lanes(v: Any) -> Lanes:
    return tuple(map(float, v))


def moved(matrix: Floats, point: Any) -> Floats:
    """A point, moved by a matrix."""
    return np.asarray(matrix[:3, :3] @ np.asarray(point) + matrix[:3, 3])


WORLD = np.array(
    [[1.2, -0.4, 0.1, 0.3], [0.5, 0.7, -0.2, -0.6], [-0.1, 0.3, 0.9, 0.2], [0.0, 0.0, 0.0, 1.0]]
)
CLIP = np.array(
    [[0.9, 0.1, -0.2, 0.4], [0.0, 1.3, 0.3, -0.1], [0.2, -0.3, -1.1, 0.7], [0.1, 0.2, -0.8, 2.0]]
)
PLACE, NORMAL, EYE = (0.4, -0.3, 0.6), (0.3, 0.8, 0.5), (1.5, -0.7, 2.2)
TANGENT = (0.7, -0.2, 0.4)
MESH: Given = {
    "vertex_position": PLACE,
    "vertex_normal": NORMAL,
    "vertex_uv": (0.3, 0.8),
    "object_to_world": columns(WORLD),
    "view_projection": columns(CLIP),
    "eye": EYE,
}


def upright(matrix: Any, normal: Any) -> Floats:
    """A normal, moved so that it stays at a right angle to the surface."""
    return np.asarray(np.linalg.inv(np.asarray(matrix)[:3, :3]).T @ np.asarray(normal))


POSITION_IN_WORLD = moved(WORLD, PLACE)
NORMAL_IN_WORLD = unit(upright(WORLD, NORMAL))
TO_EYE = unit(EYE - POSITION_IN_WORLD)


def shown(text: str, /, **given: Any) -> Floats:
    """The colour of the only material of a text, on the mesh."""
    return np.array(color(text, {**MESH, **given}))


def of(expression: str, header: str = "M", imports: str = "", /, **given: Any) -> Floats:
    """An expression in a material whose header is given, on the mesh."""
    return shown(f"{imports}\nmaterial {header} {{ color = vec3({expression}) }}", **given)


def close(expected: Any) -> Any:
    return pytest.approx(np.asarray(expected, np.float64), rel=1e-9, abs=1e-12)


def matrix(expression: str, imports: str = "") -> Floats:
    """The value of a matrix."""
    targets = "\n".join(f"target t{i} : rgba32f = material.m[{i}]" for i in range(4))
    whole = shader(
        "import std.transforms.{translation, scaling, rotation, look_at}\n"
        "import std.transforms.{perspective, orthographic}\n"
        "import std.shadows.{cascade}\n"
        f"{imports}\nmaterial M {{ m = {expression} }}\npass P {{ {targets} }}",
        pass_="P",
    )
    return np.array([at(whole, result.value) for result in whole.results_of(TARGET)]).T


def written(v: Sequence[float] | Floats, kind: str = "point<world>") -> str:
    """A vector as an expression."""
    return f"(vec3({', '.join(map(repr, map(float, v)))}) as {kind})"


# --- samples -------------------------------------------------------------------------------------


def hammersley(count: int) -> Floats:
    """Points of a square: the middles of as many strips, and the numbers' bits in reverse order."""
    numbers = np.arange(count)
    reverse = [int(f"{number:024b}"[::-1], 2) / 2**24 for number in numbers]
    return np.stack([(numbers + 0.5) / count, reverse], axis=1)


def on_circle(turn: Floats) -> Floats:
    return np.stack([np.cos(2 * np.pi * turn), np.sin(2 * np.pi * turn)], axis=1)


def facets(count: int, width: float) -> Floats:
    """Normals of microfacets around +z (Walter 2007, equations 35 and 36)."""
    x, y = hammersley(count).T
    squared = (1 - y) / (1 + (width**2 - 1) * y)
    return np.concatenate(
        [np.sqrt(1 - squared)[:, None] * on_circle(x), np.sqrt(squared)[:, None]], axis=1
    )


def mirrored_by(normals: Floats) -> Floats:
    """The directions to which these mirror +z."""
    return np.asarray(2 * normals[:, 2:] * normals - np.array([0.0, 0.0, 1.0]))


# --- textures ------------------------------------------------------------------------------------


@dataclass
class Place:
    """A texture that is the same everywhere, and notes where it is read."""

    value: Lanes
    size: Lanes = (64, 64)
    at: Lanes = ()
    """The coordinate of the last read."""
    level: Lanes = ()
    """The level of the last read, if it named one."""

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of a read, or the size."""
        if "size" in name:
            return self.size
        self.at = tuple(map(float, operands[0]))
        self.level = operands[1] if name == "sample_level" else ()
        return self.value

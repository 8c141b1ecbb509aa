"""Helpers for the tests of the reference's pictures: meshes, cameras, and shaders with values."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from burnish.compiler.diagnostics.diagnostic import CompileError, Report
from burnish.compiler.frontend import Frontend
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.bounds import Errors
from burnish.compiler.reference.namespace import Lanes
from burnish.compiler.reference.picture import (
    Expected,
    Geometry,
    RasterRules,
    Texels,
    draw,
)
from burnish.compiler.reference.picture.scene import Floats

BLACK = (0.0, 0.0, 0.0, 0.0)


def shader(source: str, pass_: str | None = None) -> Shader:
    """The only shader of a text, under the pass named."""
    report = Report()
    frontend = Frontend(report)
    module = frontend.open_text(source, "<test>")
    assert module is not None
    found = frontend.shaders(module, None, None, pass_)
    if report.failed:
        raise CompileError(report.diagnostics)
    (only,) = found
    return only


def geometry(triangles: Any, **attributes: Any) -> Geometry:
    """Triangles with attributes by name."""
    arrays = {name: np.asarray(value) for name, value in attributes.items()}
    return Geometry(arrays, np.asarray(triangles, dtype=np.int64).reshape(-1, 3))


def sphere(columns: int = 64, rows: int = 32) -> Geometry:
    """A sphere of radius 1, counter-clockwise from outside."""
    grid = np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1))
    u, v = (axis.ravel() for axis in grid)
    longitude, latitude = 2 * np.pi * u, np.pi * v
    place = np.stack(
        [
            np.sin(longitude) * np.sin(latitude),
            np.cos(latitude),
            np.cos(longitude) * np.sin(latitude),
        ],
        axis=1,
    )
    upper = np.arange(rows * (columns + 1)).reshape(rows, columns + 1)[:, :-1].ravel()
    lower = upper + columns + 1
    triangles = np.stack([upper, lower, upper + 1, upper + 1, lower, lower + 1], axis=1)
    return geometry(
        triangles.reshape(-1, 3), vertex_position=place, vertex_normal=place,
        vertex_uv=np.stack([u, v], axis=1),
    )  # fmt: skip


def perspective(angle: float, near: float, far: float) -> Floats:
    """A projection for a square picture along -z, as a matrix of rows."""
    scale = 1 / math.tan(angle / 2)
    return np.array(
        [
            [scale, 0, 0, 0],
            [0, scale, 0, 0],
            [0, 0, far / (near - far), near * far / (near - far)],
            [0, 0, -1, 0],
        ]
    )


def moved(x: float, y: float, z: float) -> Floats:
    """A translation as a matrix of rows."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def columns(matrix: Floats) -> Lanes:
    """A matrix in the evaluator's form."""
    return tuple(tuple(column) for column in matrix.T.tolist())


def defaults(given: Shader) -> dict[str, Lanes]:
    """The parameters' declared values."""
    values: dict[str, Lanes] = {}
    for info in given.parameters:
        if isinstance(info.default, tuple):
            values[info.leaf.name] = info.default
        elif info.default is not None:
            values[info.leaf.name] = (info.default,)
    return values


def few_ulps(_name: str, _operand: Any, result: Any) -> Any:
    """Errors of a platform whose functions are nearly exact."""
    return 4 * 2.0**-23 * np.abs(result)


WHITE = Texels((np.ones((1, 1, 4)),))


def picture(
    given: Shader,
    mesh: Geometry,
    rules: RasterRules,
    textures: Mapping[str, Texels] | None = None,
    clear: Sequence[float] = BLACK,
    errors: Errors | None = None,
    **values: Lanes,
) -> Expected:
    """The picture with the given values, or else the declared ones; textures are white."""
    white = {info.leaf.name: WHITE for info in given.textures}
    return draw(
        given,
        {**defaults(given), **values},
        {**white, **(textures or {})},
        mesh,
        rules,
        [clear] * len(given.results_of(TARGET)),
        errors,
    )

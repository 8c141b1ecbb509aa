"""Meshes as a material draws them that says what each of their primitives turns into.

``scene_state.py`` calls ``as_drawn``. Where a draw of instances stands for a geometry stage, each
primitive is an instance, and each vertex input has a value for each of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.ir.stages import GEOMETRY
from .meshes import Indices, Mesh, MeshError
from .primitives import primitives

Values = Mapping[str, NDArray[Any]]


@dataclass(frozen=True, slots=True)
class Drawn:
    """What a draw call gets."""

    attributes: Values
    """By vertex input, of shape (vertices or instances, lanes)."""
    corners: Indices
    """The vertices of each primitive, (primitives, corners); of each instance, where one stands for
    a primitive that is expanded."""
    instance_count: int


def as_drawn(reflection: Mapping[str, Any], data: Values, mesh: Mesh) -> Drawn:
    """What is drawn of a mesh; ``data`` are its values by the names of declared vertex inputs."""
    draw = reflection["draw"]
    corners = primitives(mesh, draw["primitive"])
    if draw["expanded_by"] is None:
        return Drawn(data, corners, mesh.instance_count)
    if not len(corners):
        raise MeshError(f"the mesh has no {draw['primitive']} to expand")
    if draw["expanded_by"] == GEOMETRY.name:
        return Drawn(data, corners, mesh.instance_count)
    copies = mesh.instance_count
    rows = reflection["vertex_inputs"]
    attributes = {row["name"]: _values(row["mesh"], data, corners, copies) for row in rows}
    captured = reflection["capture"]
    emits_points = captured is not None and captured["primitive"] == "point"
    listed = np.arange(draw["vertices"]).reshape(-1, 1 if emits_points else 3)
    return Drawn(attributes, listed, copies * len(corners))


def _values(wanted: Mapping[str, Any], data: Values, corners: Indices, copies: int) -> NDArray[Any]:
    """The values of an input for each primitive of each instance of the mesh."""
    count, corner = len(corners), wanted["corner"]
    if corner is not None:
        numbers = corners[:, corner]
        values = numbers[:, None] if wanted["is_number"] else data[wanted["name"]][numbers]
        return np.tile(values, (copies, 1))
    if not wanted["is_number"]:
        return np.repeat(data[wanted["name"]], count, axis=0)
    if wanted["name"] == "primitive_index":
        return np.tile(np.arange(count), copies)[:, None]
    return np.repeat(np.arange(copies), count)[:, None]

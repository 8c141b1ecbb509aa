"""Makes the draw calls of materials that turn primitives or patches of a mesh into others.

``scene_state.py`` calls ``as_drawn``. Where a draw of instances stands for another stage, each
primitive is an instance, and each vertex input has a value for each of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.documents.drawing import MeshInputRow, TessellationRow
from ...compiler.ir.primitives import CORNERS
from ...compiler.ir.stages import EVALUATION, GEOMETRY, PATCH_INDEX, PRIMITIVE_INDEX
from .instances.instance import Instance
from .meshes import Indices, Mesh, MeshError
from .patches import patches, pattern
from .primitives import primitives

Values = Mapping[str, NDArray[Any]]


@dataclass(frozen=True, slots=True)
class Drawn:
    """The vertices and instances of a draw call."""

    attributes: Values
    """The values of vertex inputs, by input, of shape (vertices or instances, lanes)."""
    corners: Indices
    """The vertices of each primitive, (primitives, corners); or of each instance, if an instance
    stands for a primitive that is expanded."""
    instance_count: int


def as_drawn(instance: Instance, data: Values, mesh: Mesh) -> Drawn:
    """The draw call for a mesh; ``data`` are its values by the names of declared vertex inputs."""
    reflection = instance.reflection
    draw = reflection.draw
    if draw.tessellation is not None:
        return _divided(instance, draw.tessellation, data, mesh)
    corners = primitives(mesh, draw.primitive)
    is_expanded = draw.expanded_by is not None
    if not len(corners) and (is_expanded or reflection.capture is not None):
        work = "expand" if is_expanded else "capture"
        raise MeshError(f"the mesh has no {draw.primitive} to {work}")
    if draw.expanded_by in (None, GEOMETRY.name):
        return Drawn(data, corners, mesh.instance_count)
    copies = mesh.instance_count
    rows = reflection.vertex_inputs
    attributes = {
        row.name: _values(row.mesh, data, corners, copies) for row in rows if row.mesh is not None
    }
    assert draw.vertices is not None, "primitives are expanded"
    listed = np.arange(draw.vertices).reshape(-1, CORNERS[draw.topology])
    return Drawn(attributes, listed, copies * len(corners))


def _divided(instance: Instance, row: TessellationRow, data: Values, mesh: Mesh) -> Drawn:
    """The patches of a mesh, which a tessellation stage divides or a pattern of the host's."""
    reflection = instance.reflection
    draw = reflection.draw
    found = patches(mesh, row.kind, draw.corners, row.ends)
    copies = mesh.instance_count
    if row.divided_by == EVALUATION.name:
        return Drawn(data, found, copies)
    rows = reflection.vertex_inputs
    attributes = {
        each.name: _values(each.mesh, data, found, copies)
        for each in rows
        if each.mesh is not None and not each.mesh.is_of_pattern
    }
    if row.levels is None:
        # The pattern has no vertex inputs: each vertex computes its position from its number.
        assert draw.vertices is not None, "patches are listed"
        cells = np.arange(draw.vertices).reshape(-1, CORNERS[draw.topology])
    else:
        of_pattern, cells = pattern_of(instance, row)
        attributes.update(of_pattern)
    return Drawn(attributes, cells, copies * len(found))


def pattern_of(instance: Instance, row: TessellationRow) -> tuple[dict[str, NDArray[Any]], Indices]:
    """The pattern into which the host divides each patch: the vertex inputs that are of it, and the
    vertices of each triangle or line."""
    draw = instance.reflection.draw
    vertices = draw.vertices
    places, cells = pattern(row.kind, row.spacing, *instance.patch_levels())
    numbers = cells
    if vertices is not None:
        # Each vertex of a cell gets the positions of all corners of the cell.
        numbers = np.repeat(cells, vertices, axis=0)
        cells = np.arange(len(numbers)).reshape(-1, CORNERS[draw.topology])
    attributes = {}
    for each in instance.reflection.vertex_inputs:
        if each.mesh is not None and each.mesh.is_of_pattern:
            corner = each.mesh.corner
            found_at = slice(None) if corner is None else numbers[:, corner]
            attributes[each.name] = places[found_at]
    return attributes, cells


def _values(wanted: MeshInputRow, data: Values, corners: Indices, copies: int) -> NDArray[Any]:
    """The values of an input for each primitive of each instance of the mesh."""
    count, corner = len(corners), wanted.corner
    if corner is not None:
        numbers = corners[:, corner]
        values = numbers[:, None] if wanted.is_number else data[wanted.name][numbers]
        return np.tile(values, (copies, 1))
    if not wanted.is_number:
        return np.repeat(data[wanted.name], count, axis=0)
    if wanted.name in (PRIMITIVE_INDEX.name, PATCH_INDEX.name):
        return np.tile(np.arange(count), copies)[:, None]
    return np.repeat(np.arange(copies), count)[:, None]

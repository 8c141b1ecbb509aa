"""Puts meshes into storage buffers, where shaders read these instead of vertex inputs.

``scene_state.py`` gives the vertex stage its corners, and ``capturing.py`` a kernel its vertices.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.documents.drawing import InBuffer, VertexInputRow
from ...compiler.documents.reflection import Reflection
from .instances.instance import Instance
from .instances.shapes import stored_as


def mesh_rows(reflection: Reflection) -> list[tuple[VertexInputRow, InBuffer]]:
    """The vertex inputs that are members of a storage buffer, and this buffer."""
    rows = reflection.vertex_inputs
    return [(row, row.buffer) for row in rows if row.buffer is not None]


def give_mesh(instance: Instance, values: Mapping[str, NDArray[Any]]) -> None:
    """Set the buffer that has the mesh; ``values`` are by vertex input, one for each element."""
    rows = mesh_rows(instance.reflection)
    fields = []
    for row, place in rows:
        lanes = values[row.name].shape[1:]
        kind = stored_as(row.representation)
        fields.append((place.member, kind, lanes if lanes[0] > 1 else ()))
    elements = np.zeros(len(values[rows[0][0].name]), fields)
    for row, place in rows:
        each = values[row.name]
        elements[place.member] = each if each.shape[1] > 1 else each[:, 0]
    instance.set(rows[0][1].name, elements)

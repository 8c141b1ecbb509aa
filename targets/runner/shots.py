"""One picture of one material, as the reference and every route have to draw it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.ir.stages import INSTANCES, VERTICES
from ...compiler.reference.picture import Geometry, instanced
from .drivers.draw import Draw
from .instances.instance import Instance
from .meshes import Indices, Mesh
from .scene import Scene, vertex_data

Color = tuple[float, float, float, float]

CLEAR: Color = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False, slots=True)
class Shot:
    """What is drawn once: everything but the shader."""

    width: int
    height: int
    attributes: Mapping[str, NDArray[Any]]
    """By vertex input: (vertices or instances, lanes), numbers that their 32-bit formats hold
    exactly."""
    triangles: Indices
    instance: Instance
    clear: tuple[Color, ...]
    """For each render target."""
    instance_count: int = 1

    def geometry(self) -> Geometry:
        """The shot's triangles, of all instances, as the reference takes them."""
        per_vertex, per_instance = self._stepping(VERTICES), self._stepping(INSTANCES)
        return instanced(per_vertex, per_instance, self.triangles, self.instance_count)

    def _stepping(self, step: str) -> dict[str, NDArray[Any]]:
        rows = self.instance.reflection["vertex_inputs"]
        return {row["name"]: self.attributes[row["name"]] for row in rows if row["step"] == step}

    def draw(self) -> Draw:
        """The shot as bytes, in the order of the reflection's inputs, blocks and textures."""
        reflection = self.instance.reflection
        blocks, textures = self.instance.blocks(), self.instance.textures()
        return Draw(
            width=self.width,
            height=self.height,
            vertex_count=Geometry(self._stepping(VERTICES), self.triangles).vertex_count,
            vertices=tuple(
                _bytes(row["representation"], self.attributes[row["name"]])
                for row in reflection["vertex_inputs"]
            ),
            indices=self.triangles.astype("<u4").tobytes(),
            blocks=tuple(blocks[row["name"]] for row in reflection["blocks"]),
            textures=tuple(
                textures[row["name"]].image() for row in reflection["textures"] if row["stages"]
            ),
            clear=self.clear,
            instance_count=self.instance_count,
        )


def take(
    instance: Instance, mesh: Mesh, scene: Scene, size: tuple[int, int], clear: Color = CLEAR
) -> Shot:
    """A shot of a mesh in a scene; what ``instance`` has no value for, the scene may set.

    Raises ``MeshError`` if the mesh lacks something that the shader reads.
    """
    width, height = size
    scene.apply(instance, width / height)
    reflection = instance.reflection
    data = vertex_data(reflection, mesh)
    cleared = (clear,) * len(reflection["targets"])
    return Shot(width, height, data, mesh.triangles, instance, cleared, mesh.instance_count)


def _bytes(representation: str, values: NDArray[Any]) -> bytes:
    kinds = {"i": "<i4", "u": "<u4"}
    return np.ascontiguousarray(values).astype(kinds.get(representation[0], "<f4")).tobytes()

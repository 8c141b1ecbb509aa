"""The state of a scene: everything that is needed to draw one picture, except the shader.

``render`` and ``conform`` set it up once, and hand it to the reference and to every route.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.ir.stages import INSTANCES, VERTICES
from ...compiler.reference.picture import Geometry, instanced
from .drivers.draws import Draw
from .expanded_draws import as_drawn
from .instances.instance import Instance
from .instances.shapes import stored_as
from .mesh_buffers import give_mesh, mesh_rows
from .meshes import Indices, Mesh
from .scene import Scene, vertex_data

Color = tuple[float, float, float, float]

KEPT_DRAWS = 32
"""The number of states whose draws are kept: those of the few materials that are drawn at once."""
CLEAR: Color = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False, slots=True)
class SceneState:
    """A mesh, the values of a material, and the size of the picture."""

    width: int
    height: int
    attributes: Mapping[str, NDArray[Any]]
    """Values by vertex input, of shape (vertices or instances, lanes); 32-bit formats hold all
    numbers exactly."""
    triangles: Indices
    instance: Instance
    clear: tuple[Color, ...]
    """The clear colour of each render target."""
    instance_count: int = 1
    blend_constant: Color = CLEAR
    """The colour of the blend factor ``constant``, for all targets."""

    def geometry(self) -> Geometry:
        """The triangles of all instances, in the form that the reference takes."""
        per_vertex, per_instance = self._stepping(VERTICES), self._stepping(INSTANCES)
        return instanced(per_vertex, per_instance, self.triangles, self.instance_count)

    def _stepping(self, step: str) -> dict[str, NDArray[Any]]:
        rows = self.instance.reflection.vertex_inputs
        return {row.name: self.attributes[row.name] for row in rows if row.step == step}

    def draw(self) -> Draw:
        """The bytes for a driver, in the order of the reflection's rows.

        These are vertex inputs, blocks, textures and buffers.
        """
        reflection = self.instance.reflection
        textures, buffers = self.instance.textures(), self.instance.buffers()
        return Draw(
            width=self.width,
            height=self.height,
            vertex_count=Geometry(self._stepping(VERTICES), self.triangles).vertex_count,
            vertices=tuple(
                _bytes(row.representation, self.attributes[row.name])
                for row in reflection.vertex_inputs
                if row.buffer is None
            ),
            indices=self.triangles.astype("<u4").tobytes(),
            blocks=_blocks(self.instance),
            textures=tuple(textures[row.name].image() for row in reflection.textures if row.stages),
            buffers=tuple(buffers[row.name].bound for row in reflection.buffers if row.stages),
            instance_count=self.instance_count,
        )

    def draws(self) -> tuple[Draw, ...]:
        """The draw of each layer, if every layer is a draw of its own, or else the only one.

        Draws of layers share everything but their blocks.
        """
        whole = self.draw()
        layers = (replace(whole, blocks=_blocks(each.instance)) for each in self.layers)
        return tuple(layers) or (whole,)

    @property
    def layers(self) -> tuple[SceneState, ...]:
        """The state of each layer of the picture, if every layer is a draw of its own."""
        row = self.instance.reflection.draw.layers
        if row is None or row.parameter is None:
            return ()
        return tuple(
            replace(self, instance=self.instance.having(row.parameter, layer))
            for layer in range(row.count)
        )


@dataclass(frozen=True, eq=False, slots=True)
class SettledState(SceneState):
    """A state whose values nobody changes any more: routes that draw it in turn share its draws."""

    @classmethod
    def of(cls, state: SceneState) -> SettledState:
        """The same state, settled."""
        return cls(**{each.name: getattr(state, each.name) for each in fields(state)})

    def draws(self) -> tuple[Draw, ...]:
        """The draws, which the first route that asks makes."""
        return _draws_of(self)


@lru_cache(KEPT_DRAWS)
def _draws_of(state: SettledState) -> tuple[Draw, ...]:
    return SceneState.draws(state)


def set_up(
    instance: Instance,
    mesh: Mesh,
    scene: Scene,
    size: tuple[int, int],
    clear: Color | None = None,
) -> SceneState:
    """Put a mesh into a scene. The scene may set parameters for which ``instance`` has no value.
    Without a ``clear`` colour for all targets, each has what its pass says, or black.

    Raises ``MeshError`` if the mesh lacks something that the shader reads.
    """
    width, height = size
    scene.apply(instance, width / height)
    return drawn_state(instance, mesh, size, clear)


def drawn_state(
    instance: Instance,
    mesh: Mesh,
    size: tuple[int, int],
    clear: Color | None = None,
) -> SceneState:
    """The state of a scene whose parameters have been set.

    Raises ``MeshError`` if the mesh lacks something that the shader reads.
    """
    width, height = size
    reflection = instance.reflection
    data, rows = vertex_data(reflection, mesh), reflection.targets
    drawn = as_drawn(instance, data, mesh)
    if mesh_rows(reflection) and reflection.capture is None:
        give_mesh(instance, drawn.attributes)
    own = (CLEAR if row.clear is None else row.clear for row in rows)
    cleared = tuple(own) if clear is None else (clear,) * len(rows)
    return SceneState(
        width, height, drawn.attributes, drawn.corners, instance, cleared, drawn.instance_count
    )


def _blocks(instance: Instance) -> tuple[bytes, ...]:
    """The bytes of the uniform blocks, in the order of the reflection."""
    blocks = instance.blocks()
    return tuple(blocks[row.name] for row in instance.reflection.blocks)


def _bytes(representation: str, values: NDArray[Any]) -> bytes:
    return np.ascontiguousarray(values).astype(stored_as(representation)).tobytes()

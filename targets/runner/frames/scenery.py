"""The scene of a frame: models with materials, seen by a camera.

``burnish render`` makes a ``Scenery`` of built-in meshes, or by ``staging.py`` of a file.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ..cameras import Camera, Matrix, Vector, Viewpoint, looking
from ..looks import PLAIN, Look
from ..meshes import MESHES, Mesh, lies
from ..scene import Scene

WHOLE = "scene"
"""The frame's name for all models of a scene; any other name is a tag."""

Rows = tuple[tuple[float, ...], ...]
"""A matrix, row by row."""

FLOOR = "floor"
"""The name of the models below all others."""

_APART = 2.2
"""The distance between the middles of models that stand in a row."""
_SIDE = 3.0
"""The distance by which the floor reaches beyond the models, to all sides."""
_MARGIN = 1.05
"""The factor by which a camera sees more than the ball that it looks at."""
_NEAR = 0.05
"""The near plane, as a share of the distance to the ball's middle."""
_FURTHER = 4.0
"""The distance of the far plane behind the ball's middle, in radii."""
_USUAL = 3.0
"""The distance of a camera's target if there are no models."""
_HOVERS = 0.5
"""The height above the floor of a mesh that lies itself, lest both hide each other."""
_VIEW = (0.25, 0.45, 1.0)
"""The direction from the models to the camera."""


@dataclass(frozen=True, eq=False, slots=True)
class Model:
    """A mesh with a material, at a place."""

    mesh: Mesh
    material: str
    placement: Rows
    """The rows of the transform from object to world space."""
    look: Look = PLAIN
    """The surface of the model as a file describes it."""
    tags: frozenset[str] = frozenset()
    bones: Matrix | None = None
    """The transform of each bone; ``None`` for the bones of the meshes here."""


@dataclass(frozen=True, eq=False, slots=True)
class Scenery:
    """Models, and the scene that they have in common."""

    models: tuple[Model, ...]
    scene: Scene = field(default_factory=Scene)

    def tagged(self, name: str) -> tuple[Model, ...]:
        """The models of a name in the frame, in the order in which they are drawn."""
        return tuple(m for m in self.models if name == WHOLE or name in m.tags)

    @property
    def target(self) -> Vector:
        """What the camera looks at: straight ahead, as far away as the middle of the models."""
        camera = self.scene.camera
        eye, forward = np.array(camera.eye), -camera.world_to_camera[2, :3]
        middles = [_middle(each) for each in self.models]
        distance = float(forward @ (np.mean(middles, axis=0) - eye)) if middles else 0.0
        if distance <= camera.near:
            distance = _USUAL
        x, y, z = (eye + distance * forward).tolist()
        return x, y, z

    def seen_from(self, viewpoint: Viewpoint) -> Scenery:
        """The same models before a camera that has been moved. Raises ``CameraError``."""
        camera = viewpoint.moved(self.scene.camera, self.target)
        return replace(self, scene=replace(self.scene, camera=camera))


def _middle(model: Model) -> NDArray[np.float64]:
    """The middle of a model in world space."""
    positions = model.mesh.channels["position"]
    ends = (positions.min(axis=0) + positions.max(axis=0)) / 2
    middle: NDArray[np.float64] = (np.array(model.placement) @ [*ends, 1.0])[:3]
    return middle


def in_a_row(
    materials: Sequence[str], tags: Mapping[str, Sequence[str]], mesh: str, room: float = 1
) -> Scenery:
    """One model of each material, side by side on a floor, before a camera that sees all of them.

    ``tags`` are the materials of the models that a frame asks for by each name. The floor has the
    material that only the name ``floor`` asks for, or the last one of all. The camera sees ``room``
    times as much as the models fill.
    """
    if not materials:
        return Scenery(())
    standing = [name for name in materials if name not in tags.get(FLOOR, ())] or list(materials)
    width = _APART * max(len(standing) - 1, 0)
    shape = MESHES[mesh]()
    models = [
        Model(shape, material, _moved((_APART * number - width / 2, 0.0, 0.0)))
        for number, material in enumerate(standing)
    ]
    below = tags.get(FLOOR, materials)[-1]
    lowest = float(shape.channels["position"][:, 1].min())
    if lies(shape):
        lowest -= _HOVERS
    models.append(Model(MESHES["plane"](), below, _lying(room * (width / 2 + _SIDE), lowest)))
    tagged = tuple(
        replace(model, tags=frozenset(_tags_of(model.material, tags))) for model in models
    )
    reach = float(np.linalg.norm(shape.channels["position"], axis=1).max())
    camera = overview(np.zeros(3), room * (width / 2 + reach))
    return Scenery(tagged, Scene(camera, light_distance=3 + width / 2))


def overview(middle: NDArray[np.float64], radius: float) -> Camera:
    """A camera that sees a ball from above."""
    usual = looking()
    assert usual.fov is not None
    distance = _MARGIN * radius / math.sin(usual.fov / 2)
    x, y, z = (middle + distance * np.array(_VIEW) / np.linalg.norm(_VIEW)).tolist()
    at_x, at_y, at_z = middle.tolist()
    near, far = _NEAR * distance, distance + _FURTHER * radius
    return looking((x, y, z), (at_x, at_y, at_z), near=near, far=far)


def _tags_of(material: str, tags: Mapping[str, Sequence[str]]) -> Iterator[str]:
    for name, materials in tags.items():
        if name != WHOLE and material in materials:
            yield name


def _moved(by: Vector) -> Rows:
    x, y, z = by
    return (1.0, 0.0, 0.0, x), (0.0, 1.0, 0.0, y), (0.0, 0.0, 1.0, z), (0.0, 0.0, 0.0, 1.0)


def _lying(half: float, height: float) -> Rows:
    """The transform that turns a square that faces +z, so that it faces +y."""
    return (half, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0, height), (0.0, -half, 0.0, 0.0), (0, 0, 0, 1.0)

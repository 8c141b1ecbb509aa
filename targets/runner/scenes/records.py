"""What a scene holds: models, cameras and lights, whichever file they come from.

``gltf/`` makes a ``Scenery`` of a glTF file. ``burnish render --scene`` draws what is in it.
World space is right-handed with y upwards.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..meshes import Mesh
from ..textures.texture import Texture

Matrix = NDArray[np.float64]
"""Rows and columns as in mathematics: ``m[row, column]``."""

Vector = tuple[float, float, float]


class SceneError(ValueError):
    """A scene cannot be used; the text tells people why."""


@dataclass(frozen=True, eq=False, slots=True)
class Look:
    """What a file says about a surface. The keys are the words of ``stdlib/scene.toml``."""

    name: str
    """The name of its material in the file, or an empty text."""
    parameters: Mapping[str, Any] = field(default_factory=dict)
    textures: Mapping[str, Texture] = field(default_factory=dict)


PLAIN = Look("")
"""For what has no material."""


@dataclass(frozen=True, eq=False, slots=True)
class Model:
    """A mesh at a place, with its look."""

    name: str
    mesh: Mesh
    """Models with the same mesh share it."""
    object_to_world: Matrix
    look: Look = PLAIN
    tags: frozenset[str] = frozenset()
    """Words by which frames choose what they draw."""
    bones: Matrix | None = None
    """The transform of each bone, from where the mesh rests to world space: (bones, 4, 4)."""
    morph: float = 0.0
    """How far it has gone to the shape that the channels ``morph_…`` of its mesh lead to."""


@dataclass(frozen=True, eq=False, slots=True)
class Camera:
    """Where somebody looks from: along -z of its own space, with y upwards."""

    name: str
    camera_to_world: Matrix
    near: float
    far: float
    """May be infinite for a perspective."""
    fov: float | None
    """The vertical angle of view in radians; ``None`` for a camera without perspective."""
    height: float = 2.0
    """Without perspective: how much it sees from bottom to top."""

    @property
    def eye(self) -> Vector:
        """Where it stands."""
        x, y, z = self.camera_to_world[:3, 3].tolist()
        return x, y, z

    def world_to_clip(self, aspect: float) -> Matrix:
        """The projection times the view; clip space has z from 0 to w, ``aspect`` is width divided
        by height."""
        return self._projection(aspect) @ np.linalg.inv(self.camera_to_world)

    def _projection(self, aspect: float) -> Matrix:
        near, far = self.near, self.far
        if self.fov is None:
            depth = 1 / (near - far)
            diagonal = [2 / (self.height * aspect), 2 / self.height, depth, 1]
            projection = np.diag(diagonal)
            projection[2, 3] = near * depth
            return projection
        scale = 1 / math.tan(self.fov / 2)
        depth = -1.0 if math.isinf(far) else far / (near - far)
        return np.array([
            [scale / aspect, 0, 0, 0], [0, scale, 0, 0], [0, 0, depth, near * depth], [0, 0, -1, 0],
        ])  # fmt: skip


LampKind = Literal["directional", "point", "spot"]


@dataclass(frozen=True, slots=True)
class Lamp:
    """A light without size."""

    name: str
    kind: LampKind
    color: Vector
    """In linear light: what arrives of a directional light; of others, at distance one."""
    place: Vector
    direction: Vector
    """Where a directional light or the axis of a spot travels; of length one."""
    inner: float = 0.0
    """The angle in radians between a spot's axis and where it begins to fade."""
    outer: float = math.pi / 4
    """The angle between a spot's axis and where nothing is left of it."""
    reach: float = math.inf
    """At which distance nothing is left of it."""


@dataclass(frozen=True, eq=False, slots=True)
class Scenery:
    """All that a file shows."""

    models: tuple[Model, ...]
    cameras: tuple[Camera, ...] = ()
    lights: tuple[Lamp, ...] = ()
    notes: tuple[str, ...] = ()
    """What is left out, for people."""

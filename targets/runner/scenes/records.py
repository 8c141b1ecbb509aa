"""The records of a scene's file: objects, cameras and lamps.

``gltf/`` makes a ``SceneFile`` of a glTF file, and ``staging.py`` makes the models of frames from
it. World space is right-handed with y upwards.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..cameras import Camera, Matrix
from ..lamps import Lamp
from ..looks import Look
from ..meshes import Mesh


class SceneError(ValueError):
    """A scene cannot be used; the text tells people why."""


def short(text: str, most: int = 60) -> str:
    """A text of a file as a message quotes it."""
    return text if len(text) <= most else f"{text[:most]}…"


@dataclass(frozen=True, eq=False, slots=True)
class SceneObject:
    """A mesh at a place, with its look."""

    name: str
    mesh: Mesh
    """The mesh; several objects may share it."""
    object_to_world: Matrix
    look: Look
    tags: frozenset[str] = frozenset()
    """Words by which frames choose models."""
    bones: Matrix | None = None
    """The transform of each bone, from the mesh at rest to world space: (bones, 4, 4)."""


@dataclass(frozen=True, eq=False, slots=True)
class SceneFile:
    """The contents of a file."""

    objects: tuple[SceneObject, ...]
    cameras: tuple[Camera, ...] = ()
    lamps: tuple[Lamp, ...] = ()
    notes: tuple[str, ...] = ()
    """Notes for people about what was left out."""

"""What a frame draws: models with materials, seen by a camera.

``burnish render`` makes a ``Scenery`` of built-in meshes, or by ``staging.py`` of a file.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from ..cameras import Matrix, Vector, looking
from ..looks import PLAIN, Look
from ..meshes import MESHES, Mesh
from ..scene import Scene

WHOLE = "scene"
"""What the frame calls all models of a scene; any other name is a tag."""

_APART = 1.6
"""How far the middles of models are apart that stand in a row."""


@dataclass(frozen=True, eq=False, slots=True)
class Model:
    """A mesh with a material, at a place."""

    mesh: Mesh
    material: str
    placement: tuple[tuple[float, ...], ...]
    """The rows of the transform from object to world space."""
    look: Look = PLAIN
    """What a file says about its surface."""
    tags: frozenset[str] = frozenset()
    bones: Matrix | None = None
    """The transform of each bone; ``None`` for the bones of the meshes here."""


@dataclass(frozen=True, eq=False, slots=True)
class Scenery:
    """Models, and the scene that they have in common."""

    models: tuple[Model, ...]
    scene: Scene = field(default_factory=Scene)

    def tagged(self, name: str) -> tuple[Model, ...]:
        """The models that a frame calls by a name, in the order in which they are drawn."""
        return tuple(m for m in self.models if name == WHOLE or name in m.tags)


def in_a_row(materials: Sequence[str], tags: Mapping[str, Sequence[str]], mesh: str) -> Scenery:
    """One model of each material, side by side, in front of a camera that sees all of them.

    ``tags`` are the materials of the models that a frame asks for by each name.
    """
    width = _APART * (len(materials) - 1)
    shape = MESHES[mesh]()
    models = tuple(
        Model(
            shape, material, _moved((_APART * number - width / 2, 0.0, 0.0)),
            tags=frozenset(_tags_of(material, tags)),
        )
        for number, material in enumerate(materials)
    )  # fmt: skip
    x, y, z = looking().eye
    further = 1 + width / 3
    eye: Vector = (x, y * further, z * further)
    return Scenery(models, Scene(looking(eye)))


def _tags_of(material: str, tags: Mapping[str, Sequence[str]]) -> Iterator[str]:
    for name, materials in tags.items():
        if name != WHOLE and material in materials:
            yield name


def _moved(by: Vector) -> tuple[tuple[float, ...], ...]:
    x, y, z = by
    return (1.0, 0.0, 0.0, x), (0.0, 1.0, 0.0, y), (0.0, 0.0, 1.0, z), (0.0, 0.0, 0.0, 1.0)

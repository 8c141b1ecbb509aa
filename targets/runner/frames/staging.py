"""Stages the objects of a file for a frame: gives each a material, and all of them a camera.

``burnish render --scene`` calls ``staged``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..scenes.notes import Notes
from ..scenes.records import SceneError, SceneFile, SceneObject, short
from .scenery import WHOLE, Model, Scenery, overview

_TOLD = 20
"""The most tags of a scene that a message lists."""


def staged(file: SceneFile, materials: Sequence[str], names: Sequence[str]) -> Scenery:
    """The objects of a file, each with a material, seen by a camera.

    The material has the name of the object's own material in the file, or is the only one. The
    camera is the file's first one, or one that sees all objects. ``names`` are those by which the
    frame asks for models. Raises ``SceneError``.
    """
    if not file.objects:
        raise SceneError("the scene has nothing to draw")
    if not materials:
        raise SceneError("the frame draws no models")
    models = tuple(_model(each, materials) for each in file.objects)
    _check_tags(file, names)
    middle, radius = _extent(file.objects)
    camera = file.cameras[0] if file.cameras else overview(middle, radius)
    distance = 3 * radius + float(np.linalg.norm(middle))
    return Scenery(models, Scene(camera, light_distance=distance, lamps=file.lamps))


def left_out(scenery: Scenery, words: Mapping[str, Set[str]]) -> tuple[str, ...]:
    """Notes about what a file says of surfaces, and their materials in the frame do not take.

    ``words`` are those of the values that each material takes, by its name.
    """
    notes = Notes()
    for model in scenery.models:
        for said, word in model.look.needs.items():
            if word not in words[model.material]:
                notes.add(
                    f"material {short(model.look.name)!r}: {said}",
                    f" is left out, as {model.material} of the frame has no value for it: the "
                    "mixins of std.gltf_layers do",
                )
    return notes.told()


def _model(found: SceneObject, materials: Sequence[str]) -> Model:
    named = found.look.name
    if named not in materials and len(materials) > 1:
        said = f"the material {short(named)!r}" if named else "no material"
        raise SceneError(
            f"{short(found.name)!r} has {said} in the scene, and the frame draws "
            f"{', '.join(materials)}: call one of them like it, or let there be only one"
        )
    return Model(
        found.mesh,
        named if named in materials else materials[0],
        tuple(map(tuple, found.object_to_world.tolist())),
        found.look,
        found.tags,
        found.bones,
    )


def _check_tags(file: SceneFile, names: Sequence[str]) -> None:
    known = dict.fromkeys(sorted(set[str]().union(*(each.tags for each in file.objects))))
    for name in names:
        if name != WHOLE and name not in known:
            shown = [short(tag) for tag in [*known][:_TOLD]]
            more = ["…"] if len(known) > _TOLD else []
            said = f"there are {', '.join([*shown, *more])}" if known else "there are no tags"
            raise SceneError(f"the frame draws `{name}`, and nothing has this tag: {said}")


def _extent(objects: Sequence[SceneObject]) -> tuple[NDArray[np.float64], float]:
    """The middle of all objects, and the distance to the farthest."""
    boxes = list(_boxes(objects))
    low = np.min([low for low, _high in boxes], axis=0)
    high = np.max([high for _low, high in boxes], axis=0)
    return (low + high) / 2, max(float(np.linalg.norm(high - low)) / 2, 1e-6)


def _boxes(
    objects: Sequence[SceneObject],
) -> Iterator[tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """The lowest and highest coordinates of each object in world space, without moved bones."""
    for each in objects:
        position = each.mesh.channels["position"]
        ends = np.stack([position.min(axis=0), position.max(axis=0)])
        corners = np.array([
            (ends[i, 0], ends[j, 1], ends[k, 2], 1) for i in (0, 1) for j in (0, 1) for k in (0, 1)
        ])  # fmt: skip
        transform = each.object_to_world if each.bones is None else each.bones[0]
        moved = (corners @ transform.T)[:, :3]
        yield moved.min(axis=0), moved.max(axis=0)

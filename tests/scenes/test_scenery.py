"""The scenes of frames without a file: a model of each material, and a floor below them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.targets.runner.frames.scenery import Model, in_a_row
from burnish.targets.runner.meshes import MESHES


def vertices(model: Model) -> NDArray[np.float64]:
    """The vertices of a model in world space, with a fourth lane of 1."""
    position = model.mesh.channels["position"]
    whole = np.concatenate([position, np.ones((len(position), 1))], 1)
    moved: NDArray[np.float64] = whole @ np.array(model.placement).T
    return moved


def box(model: Model) -> tuple[list[float], list[float]]:
    """The lowest and the highest coordinates of a model in the world."""
    found = vertices(model)[:, :3]
    return found.min(axis=0).tolist(), found.max(axis=0).tolist()


@pytest.mark.parametrize("mesh", MESHES)
@pytest.mark.parametrize("count", [1, 2, 5])
def test_models_stand_on_a_floor_and_in_the_picture(mesh: str, count: int) -> None:
    names = [f"m{number}" for number in range(count)]
    scenery = in_a_row(names, {"scene": names}, mesh)
    *standing, floor = scenery.models
    assert [each.material for each in standing] == names
    assert floor.material == names[-1]
    boxes = [box(each) for each in standing]
    for (_low, high), (low, _high) in pairwise(boxes):
        assert high[0] < low[0], "none of them reaches into the next"
    (left, bottom, back), (right, top, front) = box(floor)
    lowest = min(low[1] for low, _high in boxes)
    hovers = 0.5 if mesh == "floor" else 0  # One square would hide the other.
    assert bottom == top == pytest.approx(lowest - hovers)
    assert left < boxes[0][0][0]
    assert right > boxes[-1][1][0]
    assert back < -1 < 1 < front
    world_to_clip = scenery.scene.camera.world_to_clip(1.0)
    x, y, z, w = world_to_clip @ np.concatenate([vertices(each) for each in standing]).T
    assert (np.maximum(abs(x), abs(y)) < w).all()
    assert ((z > 0) & (z < w)).all()


def test_a_floor_looks_upwards() -> None:
    (*_others, floor) = in_a_row(["a"], {}, "sphere").models
    up = np.array(floor.placement)[:3, :3] @ [0, 0, 1]
    assert up.tolist() == [0, 1, 0]


def test_a_frame_may_ask_for_a_floor_of_its_own() -> None:
    tags = {"scene": ["stone", "brass", "grass"], "shiny": ["brass"], "floor": ["grass"]}
    scenery = in_a_row(["stone", "brass", "grass"], tags, "sphere")
    assert [(each.material, sorted(each.tags)) for each in scenery.models] == [
        ("stone", []), ("brass", ["shiny"]), ("grass", ["floor"])
    ]  # fmt: skip
    assert scenery.tagged("floor") == scenery.models[2:]
    assert scenery.tagged("scene") == scenery.models

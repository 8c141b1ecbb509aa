"""The first camera of ``burnish view``, and the point that it turns around."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..runner.frames.scenery import Scenery

_USUAL = 3.0
"""The distance of a camera's target if there are no models."""


def orbit(scenery: Scenery) -> dict[str, Any]:
    """The camera of a scene, and the point that it turns around: straight ahead, as far away as the
    middle of the models."""
    camera = scenery.scene.camera
    eye = np.array(camera.eye)
    forward = -camera.world_to_camera[2, :3]
    middles = [_middle(each.placement, each.mesh.channels["position"]) for each in scenery.models]
    distance = float(forward @ (np.mean(middles, axis=0) - eye)) if middles else 0.0
    if distance <= camera.near:
        distance = _USUAL
    return {
        "eye": list(camera.eye),
        "target": (eye + distance * forward).tolist(),
        "up": camera.world_to_camera[1, :3].tolist(),
        "fov": camera.fov,
        "height": camera.height,
        "near": camera.near,
        "far": None if math.isinf(camera.far) else camera.far,
    }


def _middle(placement: Any, positions: Any) -> Any:
    """The middle of a model in world space."""
    ends = (positions.min(axis=0) + positions.max(axis=0)) / 2
    return (np.array(placement) @ [*ends, 1.0])[:3]

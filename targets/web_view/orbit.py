"""The first camera of ``burnish view``, and the point that it turns around."""

from __future__ import annotations

import math
from typing import Any

from ..runner.frames.scenery import Scenery


def orbit(scenery: Scenery) -> dict[str, Any]:
    """The camera of a scene, and the point that it turns around: straight ahead, as far away as the
    middle of the models."""
    camera = scenery.scene.camera
    return {
        "eye": list(camera.eye),
        "target": list(scenery.target),
        "up": camera.world_to_camera[1, :3].tolist(),
        "fov": camera.fov,
        "height": camera.height,
        "near": camera.near,
        "far": None if math.isinf(camera.far) else camera.far,
    }

"""Cameras: their position, direction and field of view.

``scene.py`` has one, and files of scenes bring theirs. World space is right-handed with y upwards;
clip space has z from 0 to w.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]
"""Rows and columns as in mathematics: ``m[row, column]``."""

Vector = tuple[float, float, float]


@dataclass(frozen=True, eq=False, slots=True)
class Camera:
    """A camera that looks along -z of its own space, with y upwards."""

    eye: Vector
    world_to_camera: Matrix
    near: float
    far: float
    """The far plane; may be infinite for a perspective."""
    fov: float | None
    """The vertical angle of view from bottom to top; ``None`` without perspective."""
    height: float = 2.0
    """Without perspective: the height that it sees, from bottom to top."""

    def world_to_clip(self, aspect: float) -> Matrix:
        """The projection times the view transform; ``aspect`` is width divided by height."""
        with np.errstate(all="ignore"):  # The parameter then refuses infinities and NaNs.
            return self._projection(aspect) @ self.world_to_camera

    def _projection(self, aspect: float) -> Matrix:
        if self.fov is not None:
            return _perspective(self.fov, aspect, self.near, self.far)
        depth = 1 / (self.near - self.far)
        projection = np.diag([2 / (self.height * aspect), 2 / self.height, depth, 1])
        projection[2, 3] = self.near * depth
        return projection


def looking(
    eye: Vector = (0.9, 0.8, 3.0),
    look_at: Vector = (0.0, 0.0, 0.0),
    fov: float = math.radians(38),
    near: float = 0.1,
    far: float = 20.0,
) -> Camera:
    """A camera that looks from one place to another."""
    return Camera(eye, _look_at(eye, look_at), near, far, fov)


def _look_at(eye: Vector, look_at: Vector) -> Matrix:
    back = np.subtract(eye, look_at)
    back = back / np.linalg.norm(back)
    right = np.cross([0.0, 1.0, 0.0], back)
    right = right / np.linalg.norm(right)
    view = np.eye(4)
    view[:3, :3] = [right, np.cross(back, right), back]
    view[:3, 3] = -view[:3, :3] @ np.array(eye)
    return view


def _perspective(fov: float, aspect: float, near: float, far: float) -> Matrix:
    scale = 1 / math.tan(fov / 2)
    depth = -1.0 if math.isinf(far) else far / (near - far)
    return np.array(
        [[scale / aspect, 0, 0, 0], [0, scale, 0, 0], [0, 0, depth, near * depth], [0, 0, -1, 0]]
    )

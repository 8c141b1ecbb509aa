"""Cameras: their position, direction and field of view.

``scene.py`` has one, and files of scenes bring theirs. World space is right-handed with y upwards;
clip space has z from 0 to w.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]
"""Rows and columns as in mathematics: ``m[row, column]``."""

Vector = tuple[float, float, float]


_STEEP = 0.9999
"""The height of a direction of length one from which it counts as straight up or down."""
_STEEPEST = math.radians(89.9)
"""The largest angle between the horizon and a camera that has been turned."""


class CameraError(ValueError):
    """A camera cannot stand there; the text tells people why."""


@dataclass(frozen=True, slots=True)
class Viewpoint:
    """Wishes of a person about a camera; what is left open stays as the scene has it."""

    eye: Vector | None = None
    look_at: Vector | None = None
    turn: tuple[float, float] = (0.0, 0.0)
    """The angles in radians by which the camera turns around what it looks at: to the right, and
    upwards."""

    def moved(self, camera: Camera, target: Vector) -> Camera:
        """A scene's camera as it is wished; ``target`` is what it looks at by itself.

        Raises ``CameraError`` for an eye that is where it looks at.
        """
        if self == USUAL:
            return camera
        eye = np.array(self.eye or camera.eye)
        at = np.array(self.look_at or target)
        before = float(np.linalg.norm(np.subtract(camera.eye, target)))
        away = eye - at
        distance = float(np.linalg.norm(away))
        if not distance > _LEAST * max(1.0, before):
            raise CameraError("the camera is at the place that it looks at: move one of them")
        if self.turn != (0.0, 0.0):
            away = _turned(away, *self.turn)
        x, y, z = (at + away).tolist()
        farther = distance / before if before > 0 else 1.0
        return replace(
            camera,
            eye=(x, y, z),
            world_to_camera=_look_at((x, y, z), tuple(at.tolist())),
            near=camera.near * min(farther, 1.0),
            far=camera.far * max(farther, 1.0),
        )


USUAL = Viewpoint()
"""No wishes at all."""
_LEAST = 1e-6
"""The least distance of an eye from what it looks at, as a share of the usual one."""


def _turned(away: NDArray[np.float64], right: float, up: float) -> NDArray[np.float64]:
    """The way from a camera's target to its eye, after the camera has turned around the target."""
    distance = float(np.linalg.norm(away))
    pitch = math.asin(away[1] / distance) + up
    pitch = min(max(pitch, -_STEEPEST), _STEEPEST)
    yaw = math.atan2(away[0], away[2]) + right
    ring = math.cos(pitch)
    turned = np.array([ring * math.sin(yaw), math.sin(pitch), ring * math.cos(yaw)])
    return distance * turned


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
    # A camera that looks straight down has the far side of the world at the top of its picture.
    upwards = [0.0, 1.0, 0.0] if abs(back[1]) < _STEEP else [0.0, 0.0, -back[1]]
    right = np.cross(upwards, back)
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

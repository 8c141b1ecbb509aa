"""A small ray tracer for balls on a floor: what shadows and mirrors have to show."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from burnish.targets.runner.cameras import Camera

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

FLOOR = -1
"""The number of the floor; balls count from 0."""
NOTHING = -2


@dataclass(frozen=True)
class Row:
    """Balls of radius 1 along x, on a floor."""

    middles: Sequence[float]
    half: float
    """The distance from the floor's centre to each of its sides."""

    def hit(self, start: Floats, way: Floats) -> tuple[Floats, NDArray[np.int64]]:
        """The distances that rays of unit length travel, and the numbers of the things they hit."""
        far = np.full(way.shape[:-1], np.inf)
        what = np.full(way.shape[:-1], NOTHING)
        with np.errstate(divide="ignore", invalid="ignore"):
            down = (-1 - start[..., 1]) / way[..., 1]
            there = start + down[..., None] * way
        inside = (np.abs(there[..., [0, 2]]) <= self.half).all(axis=-1) & (down > 1e-6)
        far[inside], what[inside] = down[inside], FLOOR
        for number, x in enumerate(self.middles):
            away = start - np.array([x, 0.0, 0.0])
            along = -(away * way).sum(axis=-1)
            under = along**2 - (away**2).sum(axis=-1) + 1
            distance = along - np.sqrt(np.maximum(under, 0))
            nearer = (under > 0) & (distance > 1e-6) & (distance < far)
            far[nearer], what[nearer] = distance[nearer], number
        return far, what

    def clearance(self, start: Floats, end: Floats, but: NDArray[np.int64]) -> Floats:
        """The distance from the line between two points to the nearest ball other than ``but``.

        It is negative if the line passes through a ball.
        """
        way = end - start
        found = np.full(start.shape[:-1], np.inf)
        for number, x in enumerate(self.middles):
            to_middle = np.array([x, 0.0, 0.0]) - start
            share = np.clip((to_middle * way).sum(axis=-1) / (way**2).sum(axis=-1), 0, 1)
            passed = np.linalg.norm(to_middle - share[..., None] * way, axis=-1) - 1
            found = np.where(but == number, found, np.minimum(found, passed))
        return found

    def normal(self, place: Floats, what: NDArray[np.int64]) -> Floats:
        """Away from the middle of a ball, or upwards."""
        found = np.broadcast_to([0.0, 1.0, 0.0], place.shape).copy()
        for number, x in enumerate(self.middles):
            found[what == number] = (place - np.array([x, 0.0, 0.0]))[what == number]
        return found


def rays(camera: Camera, size: int, shift: tuple[float, float] = (0.5, 0.5)) -> Floats:
    """The directions in which a camera sees the pixels of a square picture: (size, size, 3)."""
    assert camera.fov is not None
    reach = math.tan(camera.fov / 2)
    across, down = ((np.arange(size) + offset) / size * 2 - 1 for offset in shift)
    right, above, back = camera.world_to_camera[:3, :3]
    way = reach * (across[None, :, None] * right - down[:, None, None] * above) - back
    found: Floats = way / np.linalg.norm(way, axis=-1, keepdims=True)
    return found


def seen(row: Row, camera: Camera, size: int) -> tuple[Floats, NDArray[np.int64]]:
    """The points that the middles of pixels show, (size, size, 3), and the numbers of the things
    there; ``NOTHING`` also where a pixel shows the edge of something."""
    eye = np.array(camera.eye)
    way = rays(camera, size)
    far, what = row.hit(np.broadcast_to(eye, way.shape), way)
    for shift in ((0, 0), (0, 1), (1, 0), (1, 1)):
        corner = rays(camera, size, shift)
        _far, other = row.hit(np.broadcast_to(eye, way.shape), corner)
        what[other != what] = NOTHING
    return eye + np.where(what == NOTHING, 0, far)[..., None] * way, what


def linear(code: str) -> Floats:
    """The linear colour of a code ``#rrggbb``."""
    stored = np.array([int(code[at : at + 2], 16) for at in (1, 3, 5)]) / 255
    return np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)


def smoothstep(low: float, high: float, x: Floats) -> Floats:
    """The function ``smoothstep`` of shaders."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)

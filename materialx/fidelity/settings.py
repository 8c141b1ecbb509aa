"""The settings in which both sides draw: one mesh, camera and set of lights for both.

Normals and tangents of the mesh are of length one, and objects are scaled evenly: MaterialX makes
both of length one at the vertex, before they are interpolated, and Burnish only after. Under uneven
scaling, pictures would differ by about 1e-4.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...targets.runner.lamps import Lamp, LampKind
from ...targets.runner.meshes import MESHES, Mesh
from ...targets.runner.scene import Scene

Floats = NDArray[np.float64]

ALPHA_THRESHOLD = 0.001
"""The coverage below which MaterialX's text draws nothing."""

BACKGROUND = (-64.0, -64.0, -64.0, -64.0)
"""The colour of pixels where nothing is drawn: no document draws it, as it may draw zeros."""


@dataclass(frozen=True, eq=False, slots=True)
class Setting:
    """A mesh with a camera and lights, and the size of the picture."""

    scene: Scene
    """The camera, the object's transform, and the lights."""
    mesh: Mesh = field(default_factory=MESHES["sphere"])
    size: tuple[int, int] = (48, 48)
    decay: float = 2.0
    """The exponent by which light with a place decays (``decay_rate``): MaterialX divides by the
    power of the distance and one."""
    frame: float = 3.0
    time: float = 0.625
    """The frame and the seconds that animated documents are drawn at."""

    @property
    def lamps(self) -> tuple[Lamp, ...]:
        """The lights."""
        return self.scene.lamps

    @property
    def light_kinds(self) -> tuple[LampKind, ...]:
        """The kinds of the lights, each once."""
        return tuple(dict.fromkeys(lamp.kind for lamp in self.lamps))

    @property
    def aspect(self) -> float:
        """The width of the picture divided by its height."""
        width, height = self.size
        return width / height

    def channel(self, name: str, lanes: int) -> Floats:
        """The values of a channel that the mesh has, or of a smooth pattern if it has none."""
        held = self.mesh.channels.get(name)
        return pattern(name, lanes, self.mesh.channels["position"]) if held is None else held


def pattern(name: str, lanes: int, position: Floats) -> Floats:
    """The values of a primitive variable that a document reads and no mesh has: both sides draw the
    same waves, which depend on the variable's name."""
    phase = sum(map(ord, name)) % 7
    waves = [
        0.5 + 0.4 * np.sin(position @ [1.3 + lane, 0.7 * lanes, 2.1 - lane] + phase)
        for lane in range(lanes)
    ]
    rounded: Floats = np.stack(waves, 1).astype(np.float32).astype(float)
    return rounded


def whole(values: Floats) -> Floats:
    """The values of a variable that is a whole number or a truth."""
    return np.floor(8 * values)


def _turned(degrees: float, scale: float, x: float, y: float) -> tuple[tuple[float, ...], ...]:
    """The rows of a transform that turns around y, scales evenly and moves."""
    c, s = scale * math.cos(math.radians(degrees)), scale * math.sin(math.radians(degrees))
    rows = ((c, 0.0, s, x), (0.0, scale, 0.0, y), (-s, 0.0, c, 0.0), (0.0, 0.0, 0.0, 1.0))
    return tuple(tuple(float(np.float32(each)) for each in row) for row in rows)


def _unit(x: float, y: float, z: float) -> tuple[float, float, float]:
    length = math.sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


SUN = Lamp("sun", "directional", (1.0, 0.9, 0.8), (0.0, 0.0, 0.0), _unit(-0.5, -0.7, -0.6))
"""Shines from the upper right, in front of the object."""
BULB = Lamp("bulb", "point", (2.0, 3.0, 4.0), (-1.6, 0.4, 1.5), (0.0, 0.0, 0.0))
"""Shines from a place at the left."""

_PLACE = _turned(25.0, 0.9, 0.05, -0.04)

ONE_LIGHT = Setting(Scene(object_to_world=_PLACE, lamps=(SUN,)))
"""A sphere under one directional light; most documents are compared in it."""
TWO_LIGHTS = Setting(Scene(object_to_world=_PLACE, lamps=(SUN, BULB)))
"""The same with a light that has a place."""

SETTINGS: Mapping[str, Setting] = {"one light": ONE_LIGHT, "two lights": TWO_LIGHTS}


def columns(matrix: Any) -> Floats:
    """A matrix column by column, as OpenGL takes it."""
    return np.asarray(matrix, float).T.ravel()

"""The probes of a device: small drawings whose results show how it filters textures.

``measure.py`` draws them by a route, and ``derivation.py`` finds the device's precision from what
was drawn. ``probes.burnish`` has their materials.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...runner.instances.instance import Instance
from ...runner.meshes import plane
from ...runner.scene import Scene
from ...runner.scene_state import SceneState, set_up
from ...runner.subject import Subject
from ...runner.textures.texture import Texture

Floats = NDArray[np.float64]

FILE = Path(__file__).parent / "probes.burnish"
SIDE = 128
"""The width and the height of each picture; ``probes.burnish`` knows it, too."""
LADDER = 256
"""The side of the first of the levels that tell their numbers."""
CUBE = 64
"""The side of the first level of a cube of such levels."""
THIRD = float(np.float32(1 / 3))
"""A texel of a number that takes all places of a float."""

Pair = tuple[float, float]
FLOATS: Sequence[Pair] = ((0, 1), (0, 1), (THIRD, float(np.float32(7 / 9))), (THIRD, THIRD))
"""The two texels that are blended in each lane."""
FIXED: Sequence[Pair] = ((0, 1), (0, 1), (77 / 255, 78 / 255), (77 / 255, 77 / 255))
"""The same in fixed point: some are nearly the same."""
SADDLE = np.array([[1.0, 0.0], [0.0, 1.0]])
"""Texels whose blend hangs on the product of the weights along both axes."""


@dataclass(frozen=True, slots=True)
class Probe:
    """A material of ``probes.burnish``, and with what it is drawn."""

    material: str
    textures: Callable[[], Mapping[str, Texture]] = dict
    settings: Sequence[Mapping[str, object]] = field(default_factory=lambda: [{}])
    """The parameters of each picture."""

    @property
    def pass_(self) -> str:
        """The pass by which the material is drawn."""
        return f"{self.material}Read"

    def states(self, material: Subject) -> list[SceneState]:
        """The states in which it is drawn."""
        textures = self.textures()
        return [self._state(material, {**textures, **values}) for values in self.settings]

    def _state(self, material: Subject, values: Mapping[str, object]) -> SceneState:
        instance = Instance(material.reflection)
        for name, value in values.items():
            instance.set(name, value)
        return set_up(instance, plane(1), Scene(), (SIDE, SIDE))


def _square(pairs: Sequence[Pair]) -> Floats:
    """Two by two texels: the first lane changes to the right, the second one downwards, and the
    others to the right."""
    texels = np.empty((2, 2, 4))
    for lane, pair in enumerate(pairs):
        across = np.array(pair)
        texels[..., lane] = across[:, None] if lane == 1 else across
    return texels


def _weights() -> dict[str, Texture]:
    """Texels without further levels."""
    fixed, floats = np.rint(255 * _square(FIXED)), _square(FLOATS)
    return {
        "fixed": Texture.of_array(fixed.astype(np.uint8)),
        "floats": Texture.of_array(floats.astype(np.float32)),
        "saddle": Texture.of_array(np.repeat(SADDLE[..., None], 4, -1).astype(np.float32)),
    }


def ladder(side: int, kind: type[np.generic], lanes: Callable[[int], Sequence[float]]) -> Texture:
    """Levels each of which has texels of one colour, by its number."""
    count = side.bit_length()
    levels = [np.empty((side >> n, side >> n, 4), kind) for n in range(count)]
    for number, level in enumerate(levels):
        level[...] = lanes(number)
    return Texture.of_array(levels[0], levels=levels[1:])


def _numbers(number: int) -> Sequence[float]:
    return (number, number, number, 1)


def _alternating(number: int) -> Sequence[float]:
    """Black and white by turns, nearly the same by turns, and one that stays."""
    return (255 * (number % 2), 255 * (number % 2), 77 + number % 2, 77)


def _levels() -> dict[str, Texture]:
    fixed = ladder(LADDER, np.uint8, _alternating)
    return {"fixed": fixed, "single": fixed, **_steps()}


def _steps() -> dict[str, Texture]:
    return {"ladder": ladder(LADDER, np.float32, _numbers)}


def _directions() -> dict[str, Texture]:
    levels = []
    for number in range(CUBE.bit_length()):
        level = np.empty((6, CUBE >> number, CUBE >> number, 4), np.float32)
        level[...] = _numbers(number)
        levels.append(level)
    return {"ladder": Texture.of_array(levels[0], dimension="cube", levels=levels[1:])}


def cube_texels() -> Floats:
    """The texels of the cube whose corners are read: (6, 4, 4, 4)."""
    found: Floats = np.random.default_rng(3).integers(0, 256, (6, 4, 4, 4)).astype(np.float64)
    return found


def _corners() -> dict[str, Texture]:
    return {"cube": Texture.of_array(cube_texels().astype(np.uint8), dimension="cube")}


WEIGHTS = Probe("Weights", _weights)
LEVELS = Probe("Levels", _levels)
STEPS = Probe("Steps", _steps, [{"turns": 0.0}, {"turns": 1.0}])
CHANGES = Probe(
    "Changes",
    _steps,
    [
        {"stretched": (1.0, 1.0), "bent": 0.0},
        {"stretched": (1.0, 4.0), "bent": 3.0},
        {"stretched": (0.3, 0.2), "bent": 5.0},
    ],
)
DIRECTIONS = Probe("Directions", _directions, [{"bent": 0.0}, {"bent": 1.5}])
CORNERS = Probe("Corners", _corners)
SLOPES = Probe("Slopes")
PROBES = (WEIGHTS, LEVELS, STEPS, CHANGES, DIRECTIONS, CORNERS, SLOPES)

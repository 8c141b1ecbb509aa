"""The programs and meshes that show the conventions; each is drawn once by each route."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache

import numpy as np

from burnish.api.entry_points import CompiledMaterial
from burnish.targets.runner.cameras import looking
from burnish.targets.runner.meshes import Mesh, plane
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import Color, SceneState, set_up
from burnish.targets.runner.textures.texture import Texture

from .cells import CELLS, HEIGHT, WIDTH
from .kit import compiled
from .matrices import VALUES
from .rectangles import VALUES as OF_RECTANGLES

BARE: Color = (-8.0, -8.0, -8.0, -8.0)
"""The colour of pixels to which nothing is drawn."""

Size = tuple[int, int]


@dataclass(frozen=True, eq=False, slots=True)
class Drawing:
    """A program, its mesh and its scene."""

    file: str
    pass_: str
    mesh: Mesh
    size: Size
    scene: Scene = field(default_factory=Scene)
    values: Mapping[str, object] = field(default_factory=dict)
    hoist: bool = True

    def material(self, *, flip_y: bool) -> CompiledMaterial:
        """The compiled program."""
        return _material(self.file, self.pass_, self.hoist, flip_y)

    def state(self, material: CompiledMaterial) -> SceneState:
        """The mesh and the scene, with all values set."""
        state = set_up(material.instance(), self.mesh, self.scene, self.size, BARE)
        for name, value in self.values.items():
            state.instance.set(name, value)
        return state


@cache
def _material(file: str, pass_: str, hoist: bool, flip_y: bool) -> CompiledMaterial:
    return compiled(file, pass_=pass_, hoist=hoist, flip_y=flip_y)


# --- the world -----------------------------------------------------------------------------------

WORLD_SIZE = (96, 48)
IN_FRONT = Scene(looking(eye=(0.0, 0.0, 4.0), fov=2 * math.atan(0.5)))
"""A camera that sees 2 units up and down from the origin. There a unit is 12 pixels, and at z it is
48 / (4 - z) pixels."""

TURNED = Scene(
    IN_FRONT.camera,
    object_to_world=((0, -1, 0, 0.25), (1, 0, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)),
)
"""Rotates x to y, and then moves by a quarter to the right."""

RIGHT, UP, FAR_LAST, NEAR_FIRST, NEAR_LAST, FAR_FIRST = range(1, 7)


def _quad(left: float, right: float, low: float, high: float, z: float) -> list[list[float]]:
    """The corners of an upright rectangle, counter-clockwise when seen along -z."""
    return [[left, high, z], [left, low, z], [right, low, z], [right, high, z]]


def _world() -> Mesh:
    quads = {
        RIGHT: _quad(2, 3, -0.5, 0.5, 0),
        UP: _quad(-0.5, 0.5, 1, 1.75, 0),
        NEAR_FIRST: _quad(-3, -2, -0.5, 0.5, 1),
        FAR_LAST: _quad(-5, -2, -0.5, 0.5, -1),
        FAR_FIRST: _quad(-5, -2, -1.5, -0.75, -1),
        NEAR_LAST: _quad(-3, -2, -1.5, -0.75, 1),
    }
    marks = np.repeat(list(quads), 4)[:, None]
    fans = np.array([[0, 1, 2], [0, 2, 3]])
    triangles = np.concatenate([fans + 4 * number for number in range(len(quads))])
    return Mesh({"position": np.concatenate(list(quads.values())), "mark": marks}, triangles)


# --- textures ------------------------------------------------------------------------------------

SQUARE = np.array(
    [[[10, 20, 30, 40], [50, 60, 70, 80]], [[90, 100, 110, 120], [130, 140, 150, 160]]]
)
"""A texture of two by two texels, whose lanes are all different."""
OBLONG = (np.arange(12) * 20 + 5).reshape(3, 4)
"""A texture of four by three texels."""
TEXELS_SIZE = (12, 9)
"""Three times as many pixels in each direction, so that a pixel's centre is that of a texel of
``far``."""


def _textures() -> dict[str, Texture]:
    oblong = Texture.of_array(np.repeat(OBLONG[:, :, None], 4, 2).astype(np.uint8))
    square = Texture.of_array(SQUARE.astype(np.uint8))
    return {"square": square, "repeated": oblong, "clamped": oblong, "mirrored": oblong}


_CELLS_SIZE = (WIDTH, HEIGHT)
_COVER = plane(1)

DRAWINGS: Mapping[str, Drawing] = {
    "world": Drawing("world.burnish", "World", _world(), WORLD_SIZE, IN_FRONT),
    "turned": Drawing("world.burnish", "World", _world(), WORLD_SIZE, TURNED),
    "last on top": Drawing("world.burnish", "LastOnTop", _world(), WORLD_SIZE, IN_FRONT),
    "nothing hidden": Drawing("world.burnish", "NothingHidden", _world(), WORLD_SIZE, IN_FRONT),
    "farther": Drawing("world.burnish", "Farther", _world(), WORLD_SIZE, IN_FRONT),
    "cells": Drawing("clip.burnish", "Marks", CELLS, _CELLS_SIZE),
    "without back": Drawing("clip.burnish", "WithoutBack", CELLS, _CELLS_SIZE),
    "without front": Drawing("clip.burnish", "WithoutFront", CELLS, _CELLS_SIZE),
    "slopes": Drawing("clip.burnish", "Slopes", CELLS, _CELLS_SIZE),
    "integers": Drawing("clip.burnish", "Integers", CELLS, _CELLS_SIZE),
    "matrices": Drawing("matrices.burnish", "Row", _COVER, (50, 1), values=VALUES, hoist=False),
    "hoisted": Drawing("matrices.burnish", "Row", _COVER, (50, 1), values=VALUES),
    "rectangles": Drawing(
        "rectangles.burnish", "Row", _COVER, (80, 1), values=OF_RECTANGLES, hoist=False
    ),
    "hoisted rectangles": Drawing(
        "rectangles.burnish", "Row", _COVER, (80, 1), values=OF_RECTANGLES
    ),
    "textures": Drawing("textures.burnish", "Texels", _COVER, TEXELS_SIZE, values=_textures()),
}

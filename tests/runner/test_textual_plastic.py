"""The demo's material as Burnish writes it, drawn by OpenGL, WebGPU and WebGL 2."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt
import pytest

import burnish
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.meshes import mesh
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import set_up
from burnish.targets.runner.textures.texture import Texture
from burnish.targets.toolchain import Toolchain
from burnish.tests.structure.kit import ROOT

from .jobs_kit import draw_job
from .textual_kit import Floats, shoot

Covered = npt.NDArray[np.bool_]

SIZE = 96
ROUTE_OF = {"opengl": "llvmpipe:gl330", "webgpu": "chromium:webgpu", "webgl2": "chromium:webgl2"}
WAVE = np.cos(2 * np.pi * np.arange(64) / 64, dtype=np.float32)
"""A wave so smooth that the number of bits of a driver's filter does not matter."""


@pytest.fixture(scope="module")
def pictures() -> dict[str, Floats]:
    """A textured sphere, with every light of the rig, by each API."""
    profiles = tuple(ROUTES[route].profile for route in ROUTE_OF.values())
    source = ROOT / "examples" / "plastic.burnish"
    plastic = burnish.compile(source, targets=profiles)["Plastic"]
    instance = Instance(plastic.reflection)
    texels = np.ones((64, 64, 4), np.float32)
    texels[..., 0] -= 0.4 * (1 + WAVE)
    texels[..., 1] -= 0.4 * (1 + WAVE[:, None])
    instance.set("albedo", Texture.of_array(texels))
    draw = set_up(instance, mesh("sphere"), Scene(), (SIZE, SIZE)).draw()
    shown = {}
    for api, route in ROUTE_OF.items():
        codes = compile_one(ROUTES[route], plastic.files, Toolchain())
        made = pipeline(Exact.of(plastic).reflection, ROUTES[route], codes)
        shown[api] = shoot(api, draw_job(made, (draw,)))
    return shown


def neighbours(picture: Floats, distance: int = 1) -> Iterator[Floats]:
    """The picture, moved in each of four directions."""
    for axis in (0, 1):
        for step in (-distance, distance):
            yield np.roll(picture, step, axis)


def covered(picture: Floats) -> Covered:
    shown: Covered = picture[..., 3] > 0
    return shown


def interior(picture: Floats) -> Covered:
    """Pixels that are not near the rim, where triangles are slivers narrower than a pixel."""
    near: Covered = np.stack([covered(each) for each in neighbours(picture, distance=3)])
    inner: Covered = near.min(axis=0)
    return inner


@pytest.mark.parametrize("api", ["webgpu", "webgl2"])
def test_same_picture(api: str, pictures: dict[str, Floats]) -> None:
    """llvmpipe snaps vertices to 1/256 of a pixel and SwiftShader to 1/16.

    So the picture may move by 1/32 of a pixel along both axes, and no more.
    """
    one, other = pictures["opengl"], pictures[api]
    inner = interior(one) & interior(other)
    assert inner.mean() > 0.3
    assert one[inner][:, :3].std() > 0.1
    assert (covered(one) != covered(other)).mean() < 0.005
    slope = np.max([abs(one - each) for each in neighbours(one)], axis=0)
    allowed = 1e-3 + 2 * slope / 32
    assert (abs(one - other) <= allowed)[inner].all()

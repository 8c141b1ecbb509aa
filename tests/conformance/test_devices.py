"""The routes that draw with any device, here on lavapipe, and how a device is chosen for them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import burnish
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.conformance.summary import details
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.frames.states import draw_states
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.routes import DEVICE_ROUTES, Route
from burnish.targets.runner.runner import Runner
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import set_up
from burnish.targets.toolchain import Toolchain

from ..cli.kit import invoke

ROOT = Path(__file__).parents[2]
FILES = tuple(f"examples/{name}.burnish" for name in ("plastic", "shadow_map", "x_ray"))
MATERIALS = tuple(f"tests/conformance/materials/{name}.burnish" for name in ("kinds", "blended"))
SOFTWARE = "llvmpipe"
"""The name of lavapipe's device."""


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


WGPU = DEVICE_ROUTES["wgpu:wgsl"]


@pytest.fixture(scope="module")
def wgpu() -> Iterator[Runner]:
    """A driver that starts slowly, for all tests that draw with it."""
    with Runner([WGPU], device=SOFTWARE) as runner:
        yield runner


def rows(file: str, route: Route, runner: Runner, toolchain: Toolchain) -> list[Row]:
    materials = burnish.compile(ROOT / file, (route.profile,)).materials
    subjects = [(material.name, material) for material in materials]
    return list(conform(subjects, [route], runner, toolchain))


@pytest.mark.xdist_group("wgpu")
@pytest.mark.parametrize("file", [*FILES, *MATERIALS])
def test_wgpu_agrees(file: str, wgpu: Runner, toolchain: Toolchain) -> None:
    for row in rows(file, WGPU, wgpu, toolchain):
        assert row.status == "agrees", row.material
        assert row.device is not None and SOFTWARE in row.device.name


FRAMES = (
    "cascades", "deferred", "glow", "image_based", "outline", "ripples", "planar_mirror",
    "smooth_edges",
)  # fmt: skip
"""Frames with layers, kernels over buffers and images, several targets, stencil values, frames
that go on from the last one, and samples. lavapipe would crash on `shadow_volumes`: see
``docs/drivers.md``."""


@pytest.mark.xdist_group("wgpu")
@pytest.mark.parametrize("name", FRAMES)
def test_wgpu_draws_frames(name: str, wgpu: Runner, toolchain: Toolchain) -> None:
    (frame,) = burnish.compile(ROOT / f"examples/frames/{name}.burnish", "wgsl").frames
    (row,) = conform([(name, frame)], [WGPU], wgpu, toolchain, size=(48, 40))
    assert row.status == "agrees", list(details(row))


@pytest.mark.xdist_group("wgpu")
def test_wgpu_draws_nothing_of_patches_of_level_0(wgpu: Runner, toolchain: Toolchain) -> None:
    text = """material Flat {
        param rising : float in 0..1 = 0
        tessellate triangle by rising as at { }
        color = vec3(1)
    }"""
    (material,) = burnish.compile(text, "wgsl").materials
    clear = (0.25, 0.5, 0.75, 1.0)
    made = pipeline(material.reflection, WGPU, compile_one(WGPU, material.files, toolchain))
    state = set_up(
        material.instance(), with_inputs(material.reflection, plane(1)), Scene(), (2, 2), clear
    )
    (outcome,) = draw_states(material, [state], WGPU, made, wgpu)
    (target,) = outcome.pictures
    assert np.abs(target - clear).max() < 0.01


@pytest.mark.parametrize("name", ["vulkan:glsl", "opengl:gl330", "opengl:gl450", "opengl:es310"])
def test_a_device_by_its_name(name: str, toolchain: Toolchain) -> None:
    route = DEVICE_ROUTES[name]
    with Runner([route], device=SOFTWARE.upper()) as runner:
        (row,) = rows(FILES[0], route, runner, toolchain)
    assert row.status == "agrees", list(details(row))


@pytest.mark.parametrize("name", ["vulkan:glsl", "opengl:gl450", "wgpu:wgsl"])
def test_a_device_that_does_not_exist(name: str) -> None:
    route = DEVICE_ROUTES[name]
    with Runner([route], device="no such GPU") as runner, pytest.raises(DriverError) as error:
        runner.device(route)
    assert "no device is called `no such GPU`; the devices are number 0, " in str(error.value)
    assert SOFTWARE in str(error.value)


def test_fixed_drivers_take_no_device() -> None:
    file = ROOT / FILES[0]
    for command in (["conform", file, "--routes"], ["render", file, "-o", "a.png", "--on"]):
        result = invoke(*command, "lavapipe:glsl", "--device", "RTX")
        assert result.exit_code == 2
        assert "--device is for the routes vulkan:glsl, " in result.stderr


def test_a_name_that_no_device_has_is_told_once() -> None:
    """Before anything is drawn, as each material would fail for the same reason."""
    result = invoke("conform", ROOT / FILES[0], "--routes", "vulkan", "--device", "no such GPU")
    assert (result.exit_code, result.stdout) == (1, "")
    assert result.stderr.startswith("error: no device is called `no such GPU`; the devices are ")

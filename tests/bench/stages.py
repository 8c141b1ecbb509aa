"""The time to draw programs whose stages are lowered, beside the same programs with native stages.

Both forms of a material draw the same picture on lavapipe, in this process, so that nothing but the
driver's work is measured. A draw with a new pipeline also compiles it, so each time is that of more
draws by one job, without that of a single one.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

import burnish
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.drivers import mesa
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.vulkan.driver import VulkanDriver
from burnish.targets.runner.frames.states import states_job
from burnish.targets.runner.meshes import Mesh
from burnish.targets.runner.routes import ROUTES, inspect_tools
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import set_up
from burnish.targets.toolchain import Toolchain

from .clock import PATIENCE
from .table import Row, Section

EXAMPLES = Path(__file__).parents[2] / "examples"
ROUTE = ROUTES["lavapipe:glsl"]
SIZE = (512, 512)
SPRITES = 100_000
LIMIT = 1.5
"""The largest time of the lowered form, as a multiple of the native one's."""
ROUNDS = 5
"""The number of turns of each form; its best time counts."""
DRAWS = 4
"""The number of draws that are timed together."""

Draws = Callable[[int], FrameJob]
"""Makes a job of so many draws."""
FORMS: Mapping[str, Mapping[str, Any]] = {"native": {"native_stages": True}, "lowered": {}}
"""The options of ``compile`` for each form."""


def measure() -> Iterator[Section]:
    """One row for each material that has two forms."""
    drawn = {form: _sprites(options) for form, options in FORMS.items()}
    with _driver() as driver:
        yield Section(
            "stages", "Milliseconds of a draw on lavapipe, without a stage and with it",
            [_row(f"{SPRITES} sprites", driver, drawn)],
        )  # fmt: skip


def _row(what: str, driver: VulkanDriver, drawn: Mapping[str, Draws]) -> Row:
    """The forms in turn, so that what else the machine does spoils both alike."""
    best = dict.fromkeys(drawn, float("inf"))
    for _ in range(ROUNDS):
        for form, each in drawn.items():
            best[form] = min(best[form], _milliseconds(driver, each))
    ratio = best["lowered"] / best["native"]
    return {"what": what, **best, "ratio": ratio, f"at most {LIMIT}": ratio <= LIMIT}


def _milliseconds(driver: VulkanDriver, drawn: Draws) -> float:
    """The time of one draw by a pipeline that is there already."""
    times = []
    for count in (1, 1 + DRAWS):
        job = drawn(count)
        start = perf_counter()
        driver.draw_frame(job)
        times.append(perf_counter() - start)
    return 1000 * (times[1] - times[0]) / DRAWS


def _sprites(options: Mapping[str, Any]) -> Draws:
    """Many small sprites: each vertex of a mesh turns into a square that faces the viewer."""
    path = EXAMPLES / "sprites.burnish"
    (material,) = burnish.compile(path, ROUTE.profile, **options).materials
    instance = material.instance()
    instance.set("size", 0.01)
    instance.set("step", 1)
    state = set_up(instance, with_inputs(material.reflection, _cloud()), Scene(), SIZE)
    with Toolchain() as toolchain:
        codes = compile_one(ROUTE, material.files, toolchain)
    made = pipeline(material.reflection, ROUTE, codes)
    return lambda count: states_job(material, [state] * count, made)


def _cloud() -> Mesh:
    """A mesh of ``SPRITES`` points in a ball; its triangles only list the points."""
    chance = np.random.default_rng(0)
    directions = chance.normal(size=(SPRITES, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    channels = {
        "position": directions * chance.random((SPRITES, 1)) ** (1 / 3),
        "normal": directions,
        "uv": chance.random((SPRITES, 2)),
    }
    numbers = np.arange(-(-SPRITES // 3) * 3).reshape(-1, 3)
    return Mesh(channels, np.minimum(numbers, SPRITES - 1))


def _driver() -> VulkanDriver:
    """Lavapipe, in this process, which has to choose it before anything calls Vulkan."""
    icd = inspect_tools([ROUTE])["lavapipe"].paths[0]
    os.environ |= {**mesa.SETTINGS, "VK_DRIVER_FILES": str(icd), "VK_ICD_FILENAMES": str(icd)}
    return VulkanDriver(str(icd), PATIENCE)

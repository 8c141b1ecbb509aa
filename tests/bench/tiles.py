"""The possible gain of tiles in work groups' memory: a blur by 31 texels of a row, on lavapipe.

The kernel reads each texel 31 times. In its hand-written twin, each work group reads its texels
once, and shares them. Burnish does not write tiles: it would, if these numbers called for it.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.drivers import mesa
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.pipeline import Code
from burnish.targets.runner.drivers.readback import layers_of
from burnish.targets.runner.drivers.vulkan import frame
from burnish.targets.runner.drivers.vulkan.device import recording
from burnish.targets.runner.drivers.vulkan.driver import VulkanDriver
from burnish.targets.runner.frames.states import states_job
from burnish.targets.runner.kernels import full_screen_state
from burnish.targets.runner.routes import ROUTES
from burnish.targets.toolchain import Job, Toolchain
from burnish.targets.toolchain.tools import inspect_all

from .table import Row, Section

TWIN = Path(__file__).with_name("twins") / "blur_in_tiles.comp.glsl"
SIZE = 1024
RUNS = 5
WEIGHTS = ", ".join(f"{weight:.9f}" for weight in np.hanning(33)[1:-1] / 16)
KERNEL = f"""kernel Blur {{
    map source : texture2d
    weights : float[31] = [{WEIGHTS}]
    result blurred : image2d<rgba16f>[source.size()] =
        sum i in 0..31 : weights[i] * source.load(texel + ivec2(i - 15, 0))
    work_group of 64 by 1
}}"""


def measure() -> Iterator[Section]:
    """CPU time of one run, of the kernel and of its twin."""
    route, icd = ROUTES["lavapipe:glsl"], str(inspect_all()["lavapipe"].paths[0])
    os.environ |= {**mesa.SETTINGS, "VK_DRIVER_FILES": icd, "VK_ICD_FILENAMES": icd}
    (kernel,) = burnish.compile(KERNEL, route.profile)
    (square,) = burnish.compile(KERNEL.replace("work_group of 64 by 1", ""), route.profile)
    with Toolchain() as toolchain, VulkanDriver(icd, 60.0) as driver:
        own, usual = (_job(each, toolchain) for each in (kernel, square))
        text = TWIN.read_text("utf-8").replace("@WEIGHTS@", WEIGHTS)
        (verdict,) = toolchain.check(
            [Job(route.compiler or "", "comp", text, "main", TWIN.name)], keep_modules=True
        )
        assert verdict.spirv, verdict.report()
        stages = {"compute": Code("main", spirv=verdict.spirv)}
        (pipeline_,) = own.pipelines
        twin = replace(own, pipelines=(replace(pipeline_, stages=stages),))
        first, second = (layers_of(driver.draw_frame(job).texels[0]) for job in (own, twin))
        assert np.abs(first - second).max() < 1e-2, "the twin computes something else"
        plain = milliseconds(driver, own)
        rows: list[Row] = [
            _row("the kernel, in work groups of 64 by 1", plain, plain),
            _row("the kernel, in work groups of 8 by 8", milliseconds(driver, usual), plain),
            _row("by hand, with tiles of 64 by 1", milliseconds(driver, twin), plain),
        ]
    title = f"31 texels of a row, {SIZE} × {SIZE}, lavapipe: CPU time, best of {RUNS}"
    yield Section("tiles", title, rows)


def _row(what: str, taken: float, plain: float) -> Row:
    return {"what": what, "ms": round(taken, 1), "beside the first": round(taken / plain, 2)}


def _job(kernel: CompiledMaterial, toolchain: Toolchain) -> FrameJob:
    route, instance = ROUTES["lavapipe:glsl"], kernel.instance()
    texels = np.random.default_rng(1).integers(0, 256, (SIZE, SIZE, 4)).astype(np.uint8)
    instance.set("source", burnish.Texture.of_array(texels))
    codes = compile_one(route, kernel.files, toolchain)
    bound = pipeline(kernel.reflection, route, codes)
    return states_job(kernel, [full_screen_state(instance)], bound)


def milliseconds(driver: VulkanDriver, job: FrameJob) -> float:
    """The best time of the commands alone, without the transfers before and after them."""
    taken: list[float] = []
    with patch.object(frame, "recording", lambda gpu: _Timed(gpu, taken)):
        for _ in range(RUNS):
            driver.draw_frame(job)
    return 1000 * min(taken)


class _Timed(AbstractContextManager[Any]):
    """Records and runs commands, and keeps how much CPU time all threads took together."""

    def __init__(self, gpu: Any, taken: list[float]) -> None:
        self._commands, self._taken = recording(gpu), taken

    def __enter__(self) -> Any:
        self._start = time.process_time()
        return self._commands.__enter__()

    def __exit__(self, *error: Any) -> None:
        self._commands.__exit__(*error)
        self._taken.append(time.process_time() - self._start)

"""The gain of work groups that reduce a buffer: each invocation reads one element, on lavapipe.

The other way, each invocation would add 64 elements itself, one after the other.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

import numpy as np

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.drivers import mesa
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.vulkan.driver import VulkanDriver
from burnish.targets.runner.frames.states import states_job
from burnish.targets.runner.kernels import elements_state
from burnish.targets.runner.routes import ROUTES
from burnish.targets.toolchain import Toolchain
from burnish.targets.toolchain.tools import inspect_all

from .table import Row, Section
from .tiles import RUNS, milliseconds

SIZE = 1 << 20
KERNELS = """
import std.reductions

/// The library's kernels, each as an invocation alone would compute it.
kernel SerialTotal {
    buffer before : float[]
    first = index * 64
    last  = min(first + 64, before.count)
    result after : float[(before.count + 63) / 64] = sum i in first..last up to 64 : before[i]
}
kernel SerialPrefixSums {
    buffer counts : uint[]
    buffer before_blocks : uint[]
    first = index - index mod 64
    result before : uint[counts.count] = before_blocks[index / 64] + inner
    inner = sum i in first..index up to 64 : counts[i]
}
kernel GroupTotal : Total { }
kernel GroupPrefixSums : PrefixSums { }
"""
PAIRS = (("SerialTotal", "GroupTotal"), ("SerialPrefixSums", "GroupPrefixSums"))


def measure() -> Iterator[Section]:
    """CPU time of one run of each kernel."""
    route, icd = ROUTES["lavapipe:glsl"], str(inspect_all()["lavapipe"].paths[0])
    os.environ |= {**mesa.SETTINGS, "VK_DRIVER_FILES": icd, "VK_ICD_FILENAMES": icd}
    kernels = burnish.compile(KERNELS, route.profile)
    with Toolchain() as toolchain, VulkanDriver(icd, 60.0) as driver:
        rows: list[Row] = []
        for pair in PAIRS:
            serial, grouped = (_job(kernels[name], toolchain) for name in pair)
            first, second = (driver.draw_frame(job).buffers[0] for job in (serial, grouped))
            kind = "<f4" if "Total" in pair[0] else "<u4"
            one, other = np.frombuffer(first, kind), np.frombuffer(second, kind)
            assert np.allclose(one, other, rtol=1e-5), "the two compute something else"
            plain = milliseconds(driver, serial)
            taken = milliseconds(driver, grouped)
            rows += [_row(pair[0], plain, plain), _row(pair[1], taken, plain)]
    title = f"{SIZE} elements, lavapipe: CPU time, best of {RUNS}"
    yield Section("reductions", title, rows)


def _row(what: str, taken: float, plain: float) -> Row:
    return {"kernel": what, "ms": round(taken, 2), "beside the first": round(taken / plain, 2)}


def _job(kernel: CompiledMaterial, toolchain: Toolchain) -> FrameJob:
    route, instance = ROUTES["lavapipe:glsl"], kernel.instance()
    random = np.random.default_rng(1)
    for row in kernel.reflection.buffers:
        if row.type == "float[]":
            instance.set(row.name, random.uniform(0, 1, SIZE).astype(np.float32))
        else:
            instance.set(row.name, random.integers(0, 9, SIZE).astype(np.uint32))
    codes = compile_one(route, kernel.files, toolchain)
    bound = pipeline(kernel.reflection, route, codes)
    return states_job(kernel, [elements_state(instance)], bound)

"""Kernels that a host runs one after the other: reductions, prefix sums, and what they are for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.frames.states import draw_states
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.kernels import elements_state
from burnish.targets.runner.routes import ROUTES

from .kit import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
ROUTE = ROUTES["lavapipe:glsl"]
KERNELS = """
import std.reductions
kernel Whole : Total { }
kernel Lowest : Least { }
kernel Highest : Greatest { }
kernel Blocks : BlockCounts { }
kernel Before : PrefixSums { }
"""
SIZES = (1, 63, 64, 65, 5000, 300_000)
Array = NDArray[Any]


@lru_cache
def compiled(source: str | Path) -> burnish.CompileResult:
    return burnish.compile(source, ROUTE.profile)


@dataclass(frozen=True)
class Kernels:
    """Kernels of one source, which a device runs as often as a test wants."""

    studio: Studio
    source: str | Path

    def run(self, name: str, values: Mapping[str, Any], result: str, kind: str) -> Array:
        """The elements, of a NumPy type ``kind``, that a kernel writes to its buffer ``result``."""
        kernel: CompiledMaterial = compiled(self.source)[name]
        instance = Instance(kernel.reflection)
        for member, value in values.items():
            instance.set(member, value)
        codes = compile_one(ROUTE, kernel.files, self.studio.toolchain)
        bound = pipeline(kernel.reflection, ROUTE, codes)
        states = [elements_state(instance)]
        (outcome,) = draw_states(kernel, states, ROUTE, bound, self.studio.runner)
        return np.frombuffer(outcome.elements[result], kind)

    def reduced(self, name: str, values: Array) -> Array:
        """The one element that is left of some."""
        while len(values) > 1:
            values = self.run(name, {"before": values}, "after", "<f4")
        return values

    def prefix_sums(self, blocks: str, before: str, counts: Array) -> Array:
        """The sum of all counts before each element."""
        above = np.zeros(0, np.uint32)
        if len(counts) > 64:
            in_blocks = self.run(blocks, {"counts": counts}, "blocks", "<u4")
            above = self.prefix_sums(blocks, before, in_blocks)
        given = {"counts": counts, "before_blocks": above}
        return self.run(before, given, "before", "<u4")


def _in_blocks(values: Array) -> np.float32:
    """A sum in the order in which the library adds, in float32: each invocation of a group those 64
    apart, and then the further half of the group to the nearer one."""
    while len(values) > 1:
        padded = np.zeros(-(-len(values) // 4096) * 4096, np.float32)
        padded[: len(values)] = values
        own = np.add.accumulate(padded.reshape(-1, 64, 64), axis=1)[:, -1]
        while own.shape[1] > 1:
            near, far = np.split(own, 2, axis=1)
            own = near + far
        values = own[:, 0]
    return np.float32(values[0])


@pytest.mark.parametrize("size", SIZES)
def test_buffers_are_reduced_in_one_order(studio: Studio, size: int) -> None:
    values = np.random.default_rng(size).uniform(-1, 1, size).astype(np.float32)
    kernels = Kernels(studio, KERNELS)
    assert kernels.reduced("Whole", values)[0] == _in_blocks(values)
    assert kernels.reduced("Lowest", values)[0] == values.min()
    assert kernels.reduced("Highest", values)[0] == values.max()


@pytest.mark.parametrize("size", SIZES)
def test_prefix_sums_count_what_is_before(studio: Studio, size: int) -> None:
    counts = np.random.default_rng(size).integers(0, 9, size).astype(np.uint32)
    found = Kernels(studio, KERNELS).prefix_sums("Blocks", "Before", counts)
    assert found.tolist() == (np.cumsum(counts) - counts).tolist()


def test_compaction_keeps_what_is_alive_in_order(studio: Studio) -> None:
    ages = np.random.default_rng(1).uniform(0, 20, 1000).astype(np.float32)
    kernels = Kernels(studio, EXAMPLES / "compaction.burnish")
    counts = kernels.run("Alive", {"ages": ages, "limit": 10.0}, "counts", "<u4")
    before = kernels.prefix_sums("AliveInBlocks", "AliveBefore", counts)
    kept = kernels.run("Compacted", {"counts": counts, "before": before}, "kept", "<u4")
    alive = np.flatnonzero(ages < 10)
    assert kept[: len(alive)].tolist() == alive.tolist()
    assert not kept[len(alive) :].any()


def test_equalised_pixels_have_all_brightnesses_equally_often(studio: Studio) -> None:
    dark = np.random.default_rng(2).uniform(0, 1, 4000) ** 3
    pixels = np.repeat(dark[:, None], 4, axis=1).astype(np.float32)
    kernels = Kernels(studio, EXAMPLES / "histogram.burnish")
    bins = kernels.run("Histogram", {"pixels": pixels}, "bins", "<u4")
    light = pixels[:, :3] @ np.array([0.2126, 0.7152, 0.0722], np.float32)
    assert bins.sum() == len(pixels)
    assert np.abs(bins - np.bincount((light * 255).astype(int), minlength=256)).sum() < 9
    given = {"pixels": pixels, "bins": bins}
    after = kernels.run("Equalised", given, "after", "<f4").reshape(-1, 4)
    bright = after[light > 0.05, 0]
    quarters = np.histogram(bright, 4, (bright.min(), 1))[0]
    assert quarters.max() < 1.25 * quarters.min()

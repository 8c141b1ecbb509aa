"""Sums, least and greatest elements, and prefix sums, against NumPy's.

The reference computes each kernel as often as a host would run it.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import burnish
from burnish.compiler.reference.kernel import computed
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.reference import texels_of, values_for

from .truth import truth

KERNELS = """
import std.reductions
kernel Whole : Total { }
kernel Lowest : Least { }
kernel Highest : Greatest { }
kernel Blocks : BlockCounts { }
kernel Before : PrefixSums { }
"""
SIZES = (1, 63, 64, 65, 4095, 4096, 4097, 5000)
Array = NDArray[Any]


@lru_cache
def compiled() -> burnish.CompileResult:
    return burnish.compile(KERNELS, (), keep_graphs=True)


def run(name: str, **values: Array) -> Array:
    """The elements that a kernel writes."""
    kernel = compiled()[name]
    instance = Instance(kernel.reflection)
    for member, value in values.items():
        instance.set(member, value)
    lanes = computed(
        kernel.shader, values_for(kernel.shader, instance), texels_of(instance), instance.extent(),
        instance.result_counts(), None, RasterRules(1, 1),
    )  # fmt: skip
    (lane,) = lanes
    return np.asarray(lane.value)


def numbers(count: int) -> Array:
    """Numbers whose sums float32 has exactly."""
    return np.random.default_rng(count).integers(-99, 99, count).astype(np.float32)


def reduced(name: str, values: Array) -> float:
    """The one element that is left."""
    while len(values) > 1:
        values = run(name, before=values.astype(np.float32))
    return float(values[0])


@truth("std.reductions.InBlocks", "std.reductions.Total", "std.reductions.Least",
       "std.reductions.Greatest")  # fmt: skip
@pytest.mark.parametrize("count", SIZES)
def test_one_element_is_left(count: int) -> None:
    values = numbers(count)
    assert len(run("Whole", before=values)) == math.ceil(count / 4096)
    assert reduced("Whole", values) == values.sum()
    assert reduced("Lowest", values) == values.min()
    assert reduced("Highest", values) == values.max()


@truth("std.reductions.Least", "std.reductions.Greatest")
@pytest.mark.parametrize("place", [0, 1, 63, 64, 100, 127, 130, 194, 255])
def test_the_extreme_element_is_found_wherever_it_is(place: int) -> None:
    values = np.zeros(256, np.float32)
    values[place] = -1
    assert reduced("Lowest", values) == -1
    assert reduced("Highest", -values) == 1


@truth("std.reductions.InBlocks", "std.reductions.Least", "std.reductions.Greatest",
       "std.reductions.Total")  # fmt: skip
@pytest.mark.parametrize("place", [0, 63, 64, 4031, 4032, 4095])
def test_each_4096_elements_have_a_result_of_their_own(place: int) -> None:
    """The extreme elements are at the same place of each block, and no other element is near 0."""
    values = np.full(3 * 4096 + 100, 50, np.float32)
    wanted = np.array([20, 10, 30, 50], np.float32)
    values[place : 3 * 4096 : 4096] = wanted[:3]
    assert (run("Lowest", before=values) == wanted).all()
    assert (run("Highest", before=-values) == -wanted).all()
    sums = np.add.reduceat(values, np.arange(4) * 4096)
    assert (run("Whole", before=values) == sums).all()


@truth("std.reductions.BlockCounts")
@pytest.mark.parametrize("count", [1, 64, 65, 100, 256])
def test_each_64_counts_have_a_sum_of_their_own(count: int) -> None:
    counts = np.random.default_rng(count).integers(1, 9, count).astype(np.uint32)
    assert (run("Blocks", counts=counts) == np.add.reduceat(counts, np.arange(0, count, 64))).all()


def prefix_sums(counts: Array) -> Array:
    """The sum of all counts before each element."""
    above = np.zeros(0, np.uint32)
    if len(counts) > 64:
        above = prefix_sums(run("Blocks", counts=counts).astype(np.uint32))
    return run("Before", counts=counts, before_blocks=above)


@truth("std.reductions.BlockCounts", "std.reductions.PrefixSums")
@pytest.mark.parametrize("count", SIZES)
def test_sums_of_what_is_before(count: int) -> None:
    counts = np.random.default_rng(count).integers(0, 9, count).astype(np.uint32)
    found = prefix_sums(counts)
    assert (found == np.concatenate([[0], np.cumsum(counts)[:-1]])).all()

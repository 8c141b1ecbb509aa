"""Bounds against devices that choose at random: never outside, and not needlessly wide.

A device evaluates a graph in float32 with random choices that specifications leave to it
(``device.py``). Whatever it chooses, its values have to lie within the bounds of ``Bounds``, and so
has the exact value. The other half of the tests measures how wide bounds are beside the largest
error seen, and keeps that within a range, so that neither soundness nor tightness drifts.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Graph, Node, reachable
from burnish.compiler.ir.signatures import FIXED
from burnish.compiler.ir.types import FLOAT, Matrix
from burnish.compiler.reference.bounds import (
    Bounded,
    Bounds,
    as_bounded,
    between,
    given,
    remembered,
)
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.evaluate import Evaluator
from burnish.compiler.reference.namespace import Lanes
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.accuracy import Platform
from burnish.stdlib.builtins.facts import SMALLEST_NORMAL
from burnish.stdlib.builtins.overloads import overloads

from .device import HABITS, Device
from .random_graphs import RandomGraph, Values, flat, leaves, usable

PLATFORMS: tuple[Platform, ...] = ("wgsl", "vulkan", "direct3d", "es")


@dataclass(frozen=True)
class Seen:
    """One lane of one node, on one device."""

    node: Node
    bounds: Bounded
    device: Any

    def outside(self) -> Any:
        """True where the device's value, or the exact one, is not within the bounds."""
        low, high = np.asarray(self.bounds.low), np.asarray(self.bounds.high)
        if low.dtype.kind == "b":
            return (low & ~self.device) | (self.device & ~high)
        unknown = np.isnan(low) | np.isnan(high)
        infinite = ~(np.isfinite(low) & np.isfinite(high))
        inside = (low <= self.device) & (self.device <= high)
        inside |= np.isnan(self.device) & infinite
        holds = (low <= self.bounds.value) & (self.bounds.value <= high)
        return ~(unknown | (inside & (holds | infinite)))

    def told(self) -> str:
        """The first element that is outside."""
        lanes = self.bounds.value, self.bounds.low, self.bounds.high, self.device
        outside, *arrays = np.broadcast_arrays(self.outside(), *lanes)
        at = np.unravel_index(outside.argmax(), outside.shape)
        value, low, high, got = (array[at] for array in arrays)
        return f"{self.node}: {got} is not in [{low}, {high}] around {value}"


def _bounds_of(array: Any, error: float, _place: str) -> Bounded:
    """A leaf, with the relative error that it may have."""
    if not error:
        return given(array)
    low, high = array - error * np.abs(array), array + error * np.abs(array)
    low = np.where((low > 0) & (low < SMALLEST_NORMAL), 0.0, low)
    high = np.where((high < 0) & (high > -SMALLEST_NORMAL), 0.0, high)
    found: Bounded = remembered(between(array, low, high))
    return found


def _stored(state: Lanes) -> Any:
    return tuple(map(_stored, state)) if isinstance(state, tuple) else remembered(state)


def evaluated(roots: Sequence[Node], values: Values, errors: Errors, seed: int) -> Iterator[Seen]:
    """All lanes of these nodes, on all devices."""
    limits = Evaluator(leaves(values, _bounds_of), Bounds(errors), stored=_stored)
    known = [(root, [as_bounded(lane) for lane in flat(limits.value(root))]) for root in roots]
    for number, habits in enumerate(HABITS):
        device = Device(errors, habits, seed * len(HABITS) + number)
        evaluator = Evaluator(leaves(values, device.given), device)
        for root, bounds in known:
            for lane, bound in zip(flat(evaluator.value(root)), bounds, strict=True):
                yield Seen(root, bound, device.lane(lane).value)


def _operations(graph: RandomGraph) -> list[Node]:
    """All operations outside of loops, in order, so that the first one is named that is wrong."""
    found = reachable(graph.roots)
    return [node for node in found if node.operands and not node.variables]


def _of_matrices() -> list[Node]:
    """Every builtin of matrices, of all shapes that fit."""
    graph = Graph()
    found = []
    for name in ("add", "sub", "mul", "neg", "transpose", "outer", "hadamard"):
        for each in overloads(BUILTINS[name]):
            types = [FIXED[str(shape)] for shape in (*each.operands, each.result)]
            if any(isinstance(type_, Matrix) for type_ in types):
                operands = tuple(
                    graph.node("parameter", type_, (), Parameter(f"p{i}{type_}", type_, "draw"))
                    for i, type_ in enumerate(types[:-1])
                )
                found.append(graph.node("call", types[-1], operands, name))
    return found


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("platform", PLATFORMS)
def test_no_device_leaves_the_bounds_of_matrices(platform: Platform) -> None:
    for seen in evaluated(_of_matrices(), Values(0), Errors((platform,)), 0):
        assert not seen.outside().any(), seen.told()


def _of_functions() -> list[Node]:
    """Sums of functions that devices compute as sums, whose terms they may combine with others."""
    graph = Graph()
    p, q, r = (graph.node("parameter", FLOAT, (), Parameter(name, FLOAT, "draw")) for name in "pqr")

    def call(name: str, *operands: Node) -> Node:
        return graph.node("call", FLOAT, operands, name)

    one = graph.node("constant", FLOAT, (), 1.0)
    parts = call("mix", p, q, r), call("mix", p, q, one), call("mod", p, q)
    return [call("add", x, y) for x in parts for y in (*parts, call("mul", q, r))]


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("platform", PLATFORMS)
def test_no_device_leaves_the_bounds_of_sums_of_functions(platform: Platform) -> None:
    for seed in range(8):
        for seen in evaluated(_of_functions(), Values(seed), Errors((platform,)), seed):
            assert not seen.outside().any(), f"seed {seed}, {seen.told()}"


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("platform", PLATFORMS)
def test_no_device_leaves_the_bounds(platform: Platform) -> None:
    for seed in range(25):
        nodes = _operations(RandomGraph(seed))
        for seen in evaluated(nodes, Values(seed), Errors((platform,)), seed):
            assert not seen.outside().any(), f"seed {seed}, {seen.told()}"


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", usable())
def test_no_builtin_leaves_its_bounds(name: str) -> None:
    for seed in range(2):
        nodes = _operations(RandomGraph(seed, steps=3, names=(name,)))
        for seen in evaluated(nodes, Values(seed), Errors(("wgsl",)), seed):
            assert not seen.outside().any(), f"seed {seed}, {seen.told()}"


# --- how wide -------------------------------------------------------------------------------------


def _widths(roots: Sequence[Node], values: Values, platform: Platform, seed: int) -> Iterator[Any]:
    """The ratio of each bound to the largest error that is seen, where both are finite."""
    worst: dict[int, tuple[Bounded, Any]] = {}
    for seen in evaluated(roots, values, Errors((platform,)), seed):
        if seen.bounds.kind == "f":
            error = np.abs(seen.device - seen.bounds.value)
            _, before = worst.get(id(seen.bounds), (seen.bounds, 0.0))
            worst[id(seen.bounds)] = seen.bounds, np.fmax(before, error)
    for bounds, error in worst.values():
        radius = np.maximum(bounds.high - bounds.value, bounds.value - bounds.low)
        radius, largest = np.broadcast_arrays(radius, error)
        counts = np.isfinite(radius) & (radius > 0) & (largest > 0)
        yield (radius[counts] / largest[counts]).ravel()


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("platform", PLATFORMS)
def test_bounds_are_close_to_the_largest_error(platform: Platform) -> None:
    graphs = [(seed, RandomGraph(seed)) for seed in range(12)]
    found = [
        width
        for seed, graph in graphs
        for width in _widths(graph.roots, Values(seed), platform, seed)
    ]
    median, nine_tenths = np.percentile(np.concatenate(found), [50, 90])
    assert 1.1 < median < 1.8
    assert 2.0 < nine_tenths < 8.0

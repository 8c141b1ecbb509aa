"""Kernels that feed each other, on devices that choose at random: never outside of the bounds.

A device stores its elements as float32 and integers, and the next kernel reads just these. Whatever
both have chosen, their elements have to lie where the reference says, which handed the bounds of
the first kernel's elements on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.api.entry_points import CompiledMaterial
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.operations import BUFFER
from burnish.compiler.ir.scattering import scattered
from burnish.compiler.ir.shader import Store
from burnish.compiler.ir.stages import STORE
from burnish.compiler.ir.storage import LANE
from burnish.compiler.reference.bounds import exact
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.evaluate import Evaluator
from burnish.compiler.reference.kernel import Lane
from burnish.compiler.reference.namespace import Lanes
from burnish.compiler.reference.scattering import joined
from burnish.compiler.reference.storage_buffers import BufferReader, Contents
from burnish.targets.runner import reference_kernels
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.reference_kernels import elements_by_reference, place_of

from .device import HABITS, Device

COUNT = 64
ERRORS = Errors(("vulkan",))
KERNELS = """
struct Item { place : vec3  number : int  on : bool  ways : float[3] }

kernel First {
    x    = float(index)
    one  = sin(x) * sin(x) + cos(x) * cos(x)
    wave = 3 * sin(0.7 * x)
    result items : Item[64] =
        Item(vec3(wave, exp(wave), x * one), int(x * one), one < 1, [wave * wave, one, x / 3])
}
kernel Second {
    buffer items : Item[]
    own   = items[index]
    other = items[own.number * 7 mod 64]
    value = if own.on then own.place.y else other.ways[0] - other.place.x
    result values : vec2[64] = vec2(value * own.ways[1], sqrt(abs(other.place.z - 20)))

    scatter sums  : int[16] add 1 + own.number mod 3 at int(own.place.z) mod 16
    scatter least : int[8] min index at other.number mod 8 where own.on
    scatter most  : uint[8] max uint(own.place.z) at index mod 8
    scatter bits  : uint[8] or 1u << uint(own.number mod 32) at index mod 8
}
kernel Third {
    buffer values : vec2[]
    buffer sums   : int[]
    buffer most   : uint[]
    own = values[sums[index mod 16] mod 64]
    result last : float[64] = own.x * own.y - float(most[index mod 8]) * values[index].x
}
"""


class _Reader:
    """A buffer whose elements are just what a device has stored."""

    def __init__(self, device: Device, reader: BufferReader) -> None:
        self._device, self._reader = device, reader

    def element(self, position: Any) -> Lanes:
        found = self._reader.element(np.asarray(self._device.lane(position).value))
        wrapped: Lanes = self._wrapped(found)
        return wrapped

    def _wrapped(self, value: Any) -> Any:
        if isinstance(value, tuple):
            return tuple(map(self._wrapped, value))
        return self._device.lane(value)


def _written(
    kernel: CompiledMaterial, device: Device, buffers: Mapping[str, Contents]
) -> list[Lane]:
    """The values that a device writes."""

    def leaves(node: Node) -> Lanes | None:
        if node.op == "input":
            return (device.lane(np.arange(COUNT)),)
        if node.op == "buffer":
            leaf = BUFFER.data(node)
            return (_Reader(device, BufferReader(buffers[leaf.name], leaf, node.type)),)
        return (COUNT,) if node.op == "parameter" else None

    evaluator = Evaluator(leaves, device)

    def of_all(node: Node) -> list[Any]:
        lanes = (device.lane(lane).value for lane in evaluator.value(node))
        return [np.broadcast_to(lane, (COUNT,)) for lane in lanes]

    counts = Instance(kernel.reflection).result_counts()
    found: list[Lane] = []
    for result in kernel.shader.results_of(STORE):
        assert result.store is not None
        found += [_lane(result.store, i, x) for i, x in enumerate(of_all(result.value))]
    for row in scattered(kernel.shader.results):
        parts = (exact(of_all(part)[0]) for part in (row.value, row.place, row.condition))
        value, _, _ = joined(row.store, counts[row.store.buffer.name], *parts)
        found.append(_lane(row.store, 0, value))
    return found


def _lane(store: Store, number: int, value: Any) -> Lane:
    return Lane(store, number, "", value, value, value, np.zeros(len(value), np.bool_))


def _stored(lanes: Sequence[Lane]) -> Iterator[tuple[str, Contents]]:
    """The elements of each buffer as bytes, which is all that a device has."""
    for name in {lane.store.buffer.name for lane in lanes}:
        mine = [lane for lane in lanes if lane.store.buffer.name == name]
        yield name, Contents(reference_kernels._contents(len(mine[0].value), mine).data)


def _check(lane: Lane, known: Contents) -> None:
    """Compare a lane of a device with the bounds."""
    start, kind = place_of(lane)
    assert known.ends is not None
    value, low, high = known.ends.reshape(3, len(lane.value), -1)[:, :, start // LANE]
    got = lane.value.astype(kind)
    outside = ~(np.isnan(low) | np.isnan(high)) & ~((low <= got) & (got <= high))
    assert not outside.any(), f"{lane.store}: {np.flatnonzero(outside)}"
    assert ((low <= value) & (value <= high)).all()


def _known(kernels: Sequence[CompiledMaterial], *, keeps_bounds: bool) -> dict[str, Contents]:
    """The reference's contents of all buffers, with their bounds."""
    known: dict[str, Contents] = {}
    for kernel in kernels:
        instance = Instance(kernel.reflection)
        for row in kernel.reflection.buffers:
            instance.set_bytes(row.name, known[row.name].data)
        held = known if keeps_bounds else {}
        known |= elements_by_reference(kernel.shader, instance, {}, held, None, ERRORS)
    return known


def _check_devices(kernels: Sequence[CompiledMaterial], known: Mapping[str, Contents]) -> None:
    for number, habits in enumerate(HABITS * 3):
        device, stored = Device(ERRORS, habits, number), dict[str, Contents]()
        for kernel in kernels:
            lanes = _written(kernel, device, stored)
            stored |= _stored(lanes)
            for lane in lanes:
                _check(lane, known[lane.store.buffer.name])


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_no_device_leaves_the_bounds_of_kernels_that_feed_each_other() -> None:
    kernels = list(burnish.compile(KERNELS, ("wgsl",)))
    known = _known(kernels, keeps_bounds=True)
    _check_devices(kernels, known)
    for name, contents in known.items():
        assert contents.ends is not None
        assert (contents.ends[2] > contents.ends[1]).any(), name


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_devices_leave_them_if_the_second_kernel_does_not_know_those_of_the_first() -> None:
    kernels = list(burnish.compile(KERNELS, ("wgsl",)))
    with pytest.raises(AssertionError):
        _check_devices(kernels, _known(kernels, keeps_bounds=False))

"""Computes what a kernel writes: every result for all elements at once, with bounds.

It evaluates the same graphs by the same definitions as the pictures. A device's value of each lane
has to lie between two numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ..ir.kernel import invocations
from ..ir.leaves import Resource
from ..ir.node import Node
from ..ir.operations import joins_group
from ..ir.scattering import Scattered, scattered
from ..ir.shader import Result, Shader, Store
from ..ir.stages import COMPUTED, STORE
from .bounds import Bounded, Errors, all_remembered, exact
from .evaluate import Evaluator, LeafValues
from .held_values import HeldValues, as_rounded
from .in_groups import Groups, InGroups, PlainInGroups
from .namespace import Lanes, Namespace
from .picture.sampler import PlainReader, TextureReader
from .picture.scene import RasterRules, Texels
from .picture.texels import Image
from .picture.watch import Found, Watch
from .scattering import joined
from .texture_reads import Reader

Array = NDArray[Any]


@dataclass(frozen=True, slots=True)
class Lane:
    """One lane of what a result writes, for all elements."""

    store: Store
    lane: int
    kind: str
    """``f`` for floats, ``i`` for integers."""
    value: Array
    low: Array
    high: Array
    undecided: Array
    """Where nothing is defined: it hangs on a promise that is broken, or on an operation without a
    guard that has left its domain."""


def computed(
    shader: Shader,
    values: Mapping[str, Any],
    textures: Mapping[str, Texels],
    count: int,
    lengths: Mapping[str, int],
    errors: Errors | None,
    rules: RasterRules,
) -> Sequence[Lane]:
    """The lanes of every part that the kernel writes, in the order of its results.

    ``values`` are those of parameters and buffers by name, ``count`` is how many invocations there
    are, and ``lengths`` says how many elements each buffer has that is written. Without ``errors``,
    nothing is rounded, and both ends of a lane are its value. Raises ``ValueError`` for a shader
    that is no kernel, and where a value is missing.
    """
    if shader.chain != COMPUTED:
        raise ValueError(f"{shader.name} is no kernel.")
    assert shader.work_group is not None
    size = invocations(shader.work_group)
    groups = PlainInGroups(count, size) if errors is None else InGroups(errors, count, size)
    stores, scatters = shader.results_of(STORE), scattered(shader.results)
    joins = [part for row in scatters for part in (row.value, row.place, row.condition)]
    roots = [*(result.value for result in stores), *joins]
    known = Found.of(roots, textures.values(), rules)
    watch = _Watch(known, (count,), rules, groups, rounds=errors is not None)
    leaves = _leaves(values, textures, count, rules, has_bounds=errors is not None)
    # Of plain arrays it is NumPy, which mypy does not see.
    evaluator = Evaluator(leaves, cast("Namespace", groups), watch, stored=all_remembered)
    with np.errstate(all="ignore"):
        found = evaluator.values(roots)
        lanes = {node.id: _of_all(each, count) for node, each in zip(roots, found, strict=True)}
        watch.end(tuple(lane for each in lanes.values() for lane in each))
        undecided = watch.undecided
        return [
            *(lane for each in stores for lane in _stored(each, lanes[each.value.id], undecided)),
            *(_joined(row, lanes, lengths[row.store.buffer.name], undecided) for row in scatters),
        ]


def _leaves(
    values: Mapping[str, Any],
    textures: Mapping[str, Texels],
    count: int,
    rules: RasterRules,
    *,
    has_bounds: bool,
) -> LeafValues:
    """The leaves of a kernel's graph for all invocations."""
    numbers = np.arange(count, dtype=np.int64)
    index = exact(numbers) if has_bounds else numbers
    held = HeldValues(values, as_rounded if has_bounds else None)
    readers: dict[Resource, Reader] = {}

    def value(node: Node) -> Lanes | None:
        if node.op == "input":
            return (index,)
        if isinstance(node.data, Resource):
            if node.data not in readers:
                reader = TextureReader(Image(textures[node.data.name], node.data, rules))
                readers[node.data] = reader if has_bounds else PlainReader(reader)
            return (readers[node.data],)
        return held.value(node)

    return value


def _stored(result: Result, lanes: Sequence[Bounded], undecided: Array) -> Iterator[Lane]:
    """What each invocation writes, or the first one of each work group."""
    store = result.store
    assert store is not None
    for number, lane in enumerate(lanes):
        ends = (lane.value, lane.low, lane.high, undecided)
        arrays = (np.asarray(end)[:: store.of_group or 1] for end in ends)
        yield Lane(store, number, lane.kind, *arrays)


def _joined(
    row: Scattered, lanes: Mapping[int, Sequence[Bounded]], length: int, undecided: Array
) -> Lane:
    """What the elements of a buffer become that is scattered to."""
    parts = (lanes[part.id][0] for part in (row.value, row.place, row.condition))
    ends = joined(row.store, length, *parts)
    # What an invocation scatters of which nothing is defined may go anywhere.
    return Lane(row.store, 0, "i", *ends, np.full(length, undecided.any()))


class _Watch(Watch):
    """Observes all invocations at once, and what their work groups join."""

    def __init__(
        self, found: Found, shape: tuple[int, ...], rules: RasterRules, groups: Groups,
        *, rounds: bool,
    ) -> None:  # fmt: skip
        super().__init__(found, shape, rules, rounds=rounds)
        self._groups = groups

    def __call__(self, node: Node, operands: list[Lanes], value: Lanes) -> Lanes:
        if joins_group(node) and self.undecided.any():
            self.undecided = self._groups.anywhere(self.undecided)
        return super().__call__(node, operands, value)


def _of_all(lanes: Lanes, count: int) -> list[Bounded]:
    """Lanes with a number for each invocation, also where all have the same."""
    bounded = (lane if isinstance(lane, Bounded) else exact(lane) for lane in lanes)
    return [lane.spread((count,)) for lane in bounded]

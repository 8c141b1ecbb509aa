"""Computes what a kernel writes: every result for all elements at once, with bounds.

It evaluates the same graphs by the same definitions as the pictures. A device's value of each lane
has to lie between two numbers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ..ir.kernel import invocations
from ..ir.leaves import Resource
from ..ir.node import Node
from ..ir.operations import joins_group
from ..ir.scattering import scattered
from ..ir.shader import Shader, Store
from ..ir.stages import COMPUTED, STORE
from .bounds import Bounded, Errors, exact
from .evaluate import Evaluator
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
    numbers = np.arange(count, dtype=np.int64)
    index = numbers if errors is None else exact(numbers)
    held = HeldValues(values, None if errors is None else as_rounded)
    readers: dict[Resource, Reader] = {}

    def leaves(node: Node) -> Lanes | None:
        if node.op == "input":
            return (index,)
        if isinstance(node.data, Resource):
            if node.data not in readers:
                image = Image(textures[node.data.name], node.data, rules)
                reader = TextureReader(image)
                readers[node.data] = PlainReader(reader) if errors is None else reader
            return (readers[node.data],)
        return held.value(node)

    assert shader.work_group is not None
    size = invocations(shader.work_group)
    groups = PlainInGroups(count, size) if errors is None else InGroups(errors, count, size)
    stores, scatters = shader.results_of(STORE), scattered(shader.results)
    joins = [part for row in scatters for part in (row.value, row.place, row.condition)]
    roots = [*(result.value for result in stores), *joins]
    known = Found.of(roots, textures.values(), rules)
    watch = _Watch(known, (count,), rules, groups, rounds=errors is not None)
    # Of plain arrays it is NumPy, which mypy does not see.
    evaluator = Evaluator(leaves, cast("Namespace", groups), watch)
    with np.errstate(all="ignore"):
        lanes = evaluator.values(roots)
        values_of = {node.id: _of_all(each, count) for node, each in zip(roots, lanes, strict=True)}
        watch.end(tuple(lane for each in values_of.values() for lane in each))
        found: list[Lane] = []
        for result in stores:
            assert result.store is not None
            for number, whole in enumerate(values_of[result.value.id]):
                each = slice(None, None, result.store.of_group or 1)
                ends = (whole.value, whole.low, whole.high, watch.undecided)
                arrays = (np.asarray(end)[each] for end in ends)
                found.append(Lane(result.store, number, whole.kind, *arrays))
        for row in scatters:
            parts = (values_of[part.id][0] for part in (row.value, row.place, row.condition))
            length = lengths[row.store.buffer.name]
            # What an invocation scatters of which nothing is defined may go anywhere.
            undecided = np.full(length, watch.undecided.any())
            found.append(Lane(row.store, 0, "i", *joined(row.store, length, *parts), undecided))
    return found


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

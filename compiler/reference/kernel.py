"""Computes the results of a kernel, each for many elements at once, with bounds.

So many work groups are computed at once that NumPy is fast, and that a long kernel needs no more
memory than others for the values in between. It evaluates the same graphs by the same definitions
as the pictures. A device's value of each lane has to lie between two numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ..budget import check
from ..ir.kernel import invocations
from ..ir.leaves import Texture
from ..ir.node import Node
from ..ir.operations import joins_group
from ..ir.scattering import Scattered, scattered
from ..ir.shader import Result, Shader, Store
from ..ir.stages import COMPUTED, STORE
from ..ir.types import width
from .bounds import Bounded, Errors, all_remembered, exact
from .bounds.bounded import joined as joined_lanes
from .cost import check_operations
from .evaluate import Evaluator, LeafValues
from .held_values import HeldValues, as_rounded
from .in_groups import Groups, InGroups, PlainInGroups
from .live import at_once
from .namespace import Lanes, Namespace
from .picture.sampler import PlainReader, TextureReader
from .picture.scene import RasterRules, Texels
from .picture.texels import Image
from .picture.watch import Found, Watch
from .scattering import joined
from .texture_reads import Reader

Array = NDArray[Any]

_AT_ONCE = 1 << 15
"""The number of invocations computed at once, or a work group if that has more."""
_OF_A_LANE = 100
"""The bytes that one lane of one element takes until a host has it.

They hold its value and its bounds, as an array of its own and as a part of the buffer.
"""


@dataclass(frozen=True, slots=True)
class Lane:
    """One lane of a written result, for all elements."""

    store: Store
    lane: int
    kind: str
    """``f`` for floats, ``i`` for integers."""
    value: Array
    low: Array
    high: Array
    undecided: Array
    """True where the value is undefined.

    It depends on a promise that is broken, or on an operation without a guard that has left its
    domain.
    """


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
    stores, scatters = shader.results_of(STORE), scattered(shader.results)
    joins = [part for row in scatters for part in (row.value, row.place, row.condition)]
    roots = [*(result.value for result in stores), *joins]
    lanes = sum(width(root.type) for root in roots)
    check_operations(roots, min(count, _AT_ONCE), shader.name)
    check("memory", count * lanes * _OF_A_LANE, f"what `{shader.name}` computes needs")
    parts = _Parts(shader, roots, values, textures, rules, errors)
    with np.errstate(all="ignore"):
        found, undecided = parts.joined(count)
        lanes_of = {root.id: each for root, each in zip(roots, found, strict=True)}
        return [
            *(
                lane
                for each in stores
                for lane in _stored(each, lanes_of[each.value.id], undecided)
            ),
            *(_joined(r, lanes_of, lengths[r.store.buffer.name], undecided) for r in scatters),
        ]


class _Parts:
    """The invocations of a kernel, part by part."""

    def __init__(
        self,
        shader: Shader,
        roots: Sequence[Node],
        values: Mapping[str, Any],
        textures: Mapping[str, Texels],
        rules: RasterRules,
        errors: Errors | None,
    ) -> None:
        assert shader.work_group is not None
        self._size = invocations(shader.work_group)
        self._roots, self._values, self._textures = roots, values, textures
        self._rules, self._errors = rules, errors
        self._known = Found.of(roots, textures.values(), rules)

    def joined(self, count: int) -> tuple[list[list[Bounded]], Array]:
        """The lanes of each root for all invocations, and for which of them nothing is defined."""
        step = max(at_once(self._roots, _AT_ONCE) // self._size, 1) * self._size
        begins = range(0, max(count, 1), step)
        parts = [self._part(begin, min(step, count - begin)) for begin in begins]
        undecided = np.concatenate([undecided for _, undecided in parts])
        of_roots = zip(*(lanes for lanes, _ in parts), strict=True)
        return [list(map(joined_lanes, zip(*lanes, strict=True))) for lanes in of_roots], undecided

    def _part(self, begin: int, count: int) -> tuple[list[list[Bounded]], Array]:
        """The lanes for some invocations, which are whole work groups but for the last one."""
        has_bounds = self._errors is not None
        groups = (
            PlainInGroups(count, self._size) if self._errors is None
            else InGroups(self._errors, count, self._size)
        )  # fmt: skip
        watch = _Watch(self._known, (count,), self._rules, groups, rounds=has_bounds)
        index = np.arange(begin, begin + count, dtype=np.int64)
        leaves = _leaves(self._values, self._textures, index, self._rules, has_bounds=has_bounds)
        # Of plain arrays it is NumPy, which mypy does not see.
        evaluator = Evaluator(leaves, cast("Namespace", groups), watch, stored=all_remembered)
        lanes = [_of_all(each, count) for each in evaluator.values(self._roots)]
        watch.end(tuple(lane for each in lanes for lane in each))
        return lanes, watch.undecided


def _leaves(
    values: Mapping[str, Any],
    textures: Mapping[str, Texels],
    numbers: Array,
    rules: RasterRules,
    *,
    has_bounds: bool,
) -> LeafValues:
    """The leaves of a kernel's graph for the invocations of these numbers."""
    index = exact(numbers) if has_bounds else numbers
    held = HeldValues(values, as_rounded if has_bounds else None)
    readers: dict[Texture, Reader] = {}

    def value(node: Node) -> Lanes | None:
        if node.op == "input":
            return (index,)
        if isinstance(node.data, Texture):
            if node.data not in readers:
                reader = TextureReader(Image(textures[node.data.name], node.data, rules))
                readers[node.data] = reader if has_bounds else PlainReader(reader)
            return (readers[node.data],)
        return held.value(node)

    return value


def _stored(result: Result, lanes: Sequence[Bounded], undecided: Array) -> Iterator[Lane]:
    """Yields the lanes that each invocation writes, or the first one of each work group."""
    store = result.store
    assert store is not None
    for number, lane in enumerate(lanes):
        ends = (lane.value, lane.low, lane.high, undecided)
        arrays = (np.asarray(end)[:: store.of_group or 1] for end in ends)
        yield Lane(store, number, lane.kind, *arrays)


def _joined(
    row: Scattered, lanes: Mapping[int, Sequence[Bounded]], length: int, undecided: Array
) -> Lane:
    """The new elements of a buffer that is scattered to."""
    parts = (lanes[part.id][0] for part in (row.value, row.place, row.condition))
    ends = joined(row.store, length, *parts)
    # An undefined value that an invocation scatters may go anywhere.
    return Lane(row.store, 0, "i", *ends, np.full(length, undecided.any()))


class _Watch(Watch):
    """Observes some invocations at once, and the values that their work groups join."""

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

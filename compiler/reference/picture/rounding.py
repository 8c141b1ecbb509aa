"""An evaluation of one stage, in all the ways in which a device may round it."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import count
from typing import Any

import numpy as np

from ....stdlib.builtins import BUILTINS
from ...ir.leaves import Resource
from ...ir.node import Node
from ...ir.types import scalar_kind
from ..evaluate import Evaluator, Leaves
from ..namespace import Lane, Lanes
from .margins import EXACT, READS, Margins
from .sampler import Reader
from .scene import Floats
from .texels import Image
from .variants import Variants

COMPARES_NEIGHBOURS = frozenset(name for name, row in BUILTINS.items() if row.uniform_control_flow)
"""Builtins that look at the other pixels of a quad."""
_NOT_ROUNDED = (
    EXACT | READS | COMPARES_NEIGHBOURS | {"neg", "abs", "min", "max", "clamp", "saturate"}
)
"""What gives one of its operands, or a number that float32 has, or has bounds of its own."""


class Rounding:
    """Watches an evaluation on quads: under each variant, operations are off by as much.

    ``functions`` are off by more than rounding, and by how much.
    """

    def __init__(
        self,
        shape: tuple[int, int, int],
        ways: Variants,
        functions: Mapping[str, float],
        images: Mapping[Resource, Image],
    ) -> None:
        self.margins = Margins(shape)
        self._ways = ways
        self._functions = functions
        self._operations, self._calls, reads = count(), count(), count()
        self._readers = {
            resource: Reader(image, ways, self.margins, reads) for resource, image in images.items()
        }

    def evaluator(self, leaves: Leaves) -> Evaluator:
        """Of the stage, with ``leaves`` for all but textures."""

        def found(node: Node) -> Lanes | None:
            if isinstance(node.data, Resource):
                return (self._readers[node.data],)
            return leaves(node)

        return Evaluator(found, np, self._observed)

    def _observed(self, node: Node, operands: list[Lanes], value: Lanes) -> Lanes:
        self.margins.watch(node, operands, value)
        if node.data in ("ddx", "ddy"):
            self.margins.spread()
            return _differences(value, self._ways, str(node.data))
        return self._rounded(node, value)

    def _rounded(self, node: Node, value: Lanes) -> Lanes:
        """What an operation gives under every variant: off to one side or the other."""
        ways = self._ways
        if len(ways) == 1 or not _rounds(node, value):
            return value
        relative = ways.sides(next(self._operations)) * ways.rounding
        if node.data in self._functions:
            absolute = ways.sides(next(self._calls)) * ways.slack * self._functions[str(node.data)]
            off = [_off(lane, relative, absolute) for lane in value]
        else:
            off = [self._off_unless_exact(lane, relative) for lane in value]
        for lane, moved in zip(value, off, strict=True):
            self.margins.hand_on(lane, moved)
        return tuple(off)

    def _off_unless_exact(self, lane: Lane, relative: Floats) -> Lane:
        """Numbers that are the same for all pixels stay as they are, too."""
        if not np.ndim(lane):
            return lane
        exact = self.margins.is_exact(lane)
        moved = _off(lane, relative, np.zeros(1))
        return moved if exact is False else np.where(exact, lane, moved)


def nominal(lane: Lane) -> Any:
    """A lane of quads under the exact variant."""
    array = np.asarray(lane)
    return array[0] if array.ndim > _QUADS else array


_QUADS = 3
"""Dimensions of an array of quads."""


def _rounds(node: Node, value: Lanes) -> bool:
    """Whether a value is what rounding has left of an operation's exact result."""
    if node.op not in ("call", "native") or node.data in _NOT_ROUNDED:
        return False
    return scalar_kind(node.type) == "float" and not isinstance(value[0], tuple)


def _off(lane: Lane, relative: Floats, absolute: Floats) -> Lane:
    return lane + (np.abs(lane) * relative[:, None, None, None] + absolute[:, None, None, None])


def _differences(value: Lanes, ways: Variants, name: str) -> Lanes:
    """A derivative under every variant: the pixel's own row or column, or a quad's common one."""
    axis, choice = (-2, ways.row) if name == "ddx" else (-1, ways.column)
    return tuple(
        _in_common(lane, choice, axis) if np.ndim(lane) and lane.shape[axis] == 2 else lane
        for lane in value
    )


def _in_common(lane: Any, choice: Any, axis: int) -> Any:
    choice = choice[:, None, None, None]
    first, second = lane.take([0], axis), lane.take([1], axis)
    return np.where(choice < 0, lane, np.where(choice == 0, first, second))

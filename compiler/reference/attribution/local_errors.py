"""The error that one operation makes by itself, for operands that are exact.

``influences.py`` asks for it, for each operation of a pixel.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....stdlib.builtins import texture
from ...ir.node import Node
from ...ir.operations import CALL, CROSS
from ...ir.types import scalar_kind
from ..bounds import Bounded, Bounds, Errors, exact
from ..namespace import Lane, Lanes
from ..operations import apply
from ..picture.scene import RasterRules

_READS = frozenset(row.name for row in texture.ROWS)
_FILTERED = frozenset(row.name for row in texture.ROWS if row.sampler is not None)
_ONE_STEP = 2.0**-23
"""The error of the depth and of 1 / w, relative to them."""


def flat(value: Any) -> Iterator[Lane]:
    """The lanes of a value, in order: those of a matrix column by column."""
    for part in value:
        if isinstance(part, tuple):
            yield from flat(part)
        else:
            yield part


def undisturbed(lane: Lane) -> Lane:
    """A lane in the first way alone."""
    return lane[:1] if np.ndim(lane) else lane


@dataclass(frozen=True, slots=True)
class LocalErrors:
    """The errors of a platform's operations."""

    errors: Errors
    """Those of functions."""
    rules: RasterRules
    """The device's bits, for interpolation and for filtering."""

    def of(self, node: Node, operands: list[Lanes], value: Lanes) -> list[Any]:
        """For each lane of a value of floats, its absolute error."""
        first = [tuple(map(undisturbed, flat(lanes))) for lanes in operands]
        lanes = [undisturbed(lane) for lane in flat(value)]
        if scalar_kind(node.type) != "float":
            return [0.0] * len(lanes)
        match node.op:
            case "constant":
                return [abs(float(np.float32(lane)) - lane) for lane in lanes]
            case "cross":
                return self._interpolation(node, first[0])
            case "input":
                return [0.0, 0.0, *(_ONE_STEP * np.abs(lane) for lane in lanes[2:])]
            case "call" | "native":
                if CALL.data(node) in _READS:
                    return self._read(node, operands, lanes)
                return self._operation(node, operands, lanes)
            case _:
                return [0.0] * len(lanes)

    def _interpolation(self, cross: Node, corners: tuple[Lane, ...]) -> list[Any]:
        """An interpolated value is inexact relative to the largest of its corners."""
        bits = self.rules.varying_bits
        if bits is None or CROSS.data(cross).mode == "flat":
            return [0.0] * len(corners)
        return [
            2.0**-bits * np.abs(lane).max() if np.ndim(lane) and np.ptp(lane) else 0.0
            for lane in corners
        ]

    def _read(self, node: Node, operands: list[Lanes], lanes: list[Lane]) -> list[Any]:
        """A filter finds its place in steps of a fraction of a texel: a read beside it differs."""
        bits = self.rules.subtexel_bits
        reader, place, *rest = operands
        if bits is None or CALL.data(node) not in _FILTERED or reader[0].image.only is not None:
            return [0.0] * len(lanes)
        sizes = [int(size) for size in reader[0].image.sizes(np.zeros((), dtype=np.int64))]
        if len(sizes) < len(place):  # A cube is read by a direction.
            sizes = [sizes[0]] * len(place)
        exact_place = tuple(map(undisturbed, place))
        others = [tuple(map(undisturbed, lanes)) for lanes in rest]
        errors: list[Any] = [0.0] * len(lanes)
        for axis, size in enumerate(sizes[: len(place)]):
            moved = list(exact_place)
            moved[axis] = moved[axis] + 2.0**-bits / size
            beside = flat(apply(node, [reader, tuple(moved), *others], np))
            errors = [
                error + np.abs(there - here)
                for error, here, there in zip(errors, lanes, beside, strict=True)
            ]
        return errors

    def _operation(self, node: Node, operands: list[Lanes], lanes: list[Lane]) -> list[Any]:
        """Evaluates the operation with bounds, from exact operands."""
        given = [_exact(lanes) for lanes in operands]
        found = flat(apply(node, given, Bounds(self.errors)))
        return [_reach(bounds, lane) for bounds, lane in zip(found, lanes, strict=True)]


def _exact(lanes: Any) -> Any:
    return tuple(
        _exact(lane) if isinstance(lane, tuple) else exact(undisturbed(lane)) for lane in lanes
    )


def _reach(bounds: Any, lane: Lane) -> Any:
    """By how much bounds are away from a value; where they say nothing, by its size."""
    if not isinstance(bounds, Bounded):
        return 0.0
    with np.errstate(invalid="ignore"):
        reach = np.maximum(bounds.high - bounds.value, bounds.value - bounds.low)
    return np.where(np.isfinite(reach), reach, np.abs(lane))

"""The error that one operation makes by itself, for operands that are exact.

``influences.py`` asks for it, for each operation of a pixel.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...ir.node import Node
from ...ir.operations import CROSS, builtin_of
from ...ir.types import scalar_kind
from ..bounds import Bounded, Bounds, Errors, exact
from ..namespace import Lane, Lanes
from ..operations import apply
from ..picture.quads import Barycentric
from ..picture.scene import Derivatives
from ..picture.stage_evaluation import DERIVATIVE_AXES
from .pixel import AttributionReader


def flat(value: Any) -> Iterator[Lane]:
    """The lanes of a value, in order: those of a matrix column by column."""
    for part in value:
        if isinstance(part, tuple):
            yield from flat(part)
        else:
            yield part


@dataclass(frozen=True, slots=True)
class LocalErrors:
    """The errors of a platform's operations."""

    errors: Errors
    """The errors of functions."""
    place: Barycentric
    """Interpolates the values of vertices."""
    derivatives: Derivatives
    """The differences between pixels that the device takes."""

    def of(self, node: Node, operands: list[Lanes], value: Lanes) -> list[Any]:
        """The absolute error of each lane of a value."""
        lanes = list(flat(value))
        if scalar_kind(node.type) == "float":
            match node.op:
                case "constant":
                    return [abs(float(np.float32(lane)) - lane) for lane in lanes]
                case "cross" if CROSS.data(node).mode != "flat":
                    return [_reach(lane) for lane in self.place.perspective(_at_corners(operands))]
                case "input":
                    return [0.0, 0.0, _reach(self.place.depth), _reach(self.place.per_w)]
                case "call" | "native":
                    return self._operation(node, operands)
        return [0.0] * len(lanes)

    def _operation(self, node: Node, operands: list[Lanes]) -> list[Any]:
        """Evaluates the operation with bounds, from exact operands."""
        found = list(flat(apply(node, list(map(_exact, operands)), Bounds(self.errors))))
        errors = [_reach(lane) for lane in found]
        axis = DERIVATIVE_AXES.get(builtin_of(node) or "")
        if axis is None or self.derivatives != "any":
            return errors
        # The device may take another difference than the pixel's own.
        return [
            error + np.max(np.abs(np.diff(lane.value, axis=axis))) if np.ndim(lane) else error
            for lane, error in zip(found, errors, strict=True)
        ]


def _at_corners(operands: list[Lanes]) -> Lanes:
    """The lanes at the three corners in the first way."""
    return tuple(lane[0] if np.ndim(lane) else np.full(3, lane) for lane in operands[0])


def _exact(lanes: Any) -> Any:
    """Lanes in the first way as exact ones."""
    return tuple(
        _exact(lane)
        if isinstance(lane, tuple)
        else lane
        if isinstance(lane, AttributionReader)
        else exact(lane[:1] if np.ndim(lane) else lane)
        for lane in lanes
    )


def _reach(lane: Any) -> Any:
    """The distance of a lane's bounds from its value.

    Where the bounds are infinite, it is the magnitude of the value.
    """
    if not isinstance(lane, Bounded):
        return 0.0
    reach = np.maximum(lane.high - lane.value, lane.value - lane.low)
    return np.where(np.isfinite(reach), reach, np.abs(lane.value))

"""The bounds of the results of overloads on a platform, for the operands of ``samples.py``.

The builtins' definitions are evaluated with bounds, as the reference does for its pictures.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import reduce
from operator import and_
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from burnish.compiler.reference.bounds import Bounded, Bounds, as_bounded, exact, given
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.functions import LaneKind, evaluate
from burnish.stdlib.builtins.accuracy import Platform
from burnish.stdlib.builtins.overloads import Overload, Shape

from .on_devices import floats, integers
from .overloads import first_map
from .samples import SIDE, Floats

Flags = NDArray[np.bool_]

MODERATE = 2.0**20


def results(overload: Overload, platforms: tuple[Platform, ...]) -> list[tuple[Floats, Floats]]:
    """The ends between which each lane of the result is; infinite or NaN where nothing is known."""
    operands = _operands(overload)
    kind = overload.operands[1 if overload.row.name == "choose" else 0].kind
    with np.errstate(all="ignore"):
        found = evaluate(
            overload.row.name, operands, Bounds(Errors(platforms)), cast(LaneKind, kind)
        )
        lanes = [_ends(as_bounded(lane), overload.result.kind) for lane in _flat(found)]
    unknown = ~_within_range(overload)
    return [
        (np.where(unknown, np.nan, low), np.where(unknown, np.nan, high)) for low, high in lanes
    ]


def operands_at(overload: Overload, place: tuple[int, int]) -> str:
    """The operands of one sample, for messages."""
    shown = []
    for operand, shape in zip(_operands(overload), overload.operands, strict=True):
        lanes = [lane.value[place].item() for lane in _flat(operand)]
        shown.append(f"{shape}({', '.join(map(repr, lanes))})")
    return ", ".join(shown)


def _within_range(overload: Overload) -> Flags:
    """True where the steps of a device stay within float32.

    The inverse is expanded into other products than those of its definition, which are too large,
    or too small, for other operands.
    """
    everywhere = np.ones((SIDE, SIDE), np.bool_)
    if overload.row.name not in ("inverse", "determinant"):
        return everywhere
    magnitudes = [np.abs(lane.value) for lane in _flat(_operands(overload)[0])]
    moderate = [(m == 0) | ((m >= 1 / MODERATE) & (m <= MODERATE)) for m in magnitudes]
    return reduce(and_, moderate, everywhere)


def _operands(overload: Overload) -> list[tuple[Any, ...]]:
    return [_operand(first_map(overload, k), shape) for k, shape in enumerate(overload.operands)]


def _operand(first: int, shape: Shape) -> tuple[Any, ...]:
    if shape.columns:
        return tuple(
            tuple(given(floats()[first + column][..., lane]) for lane in range(shape.width))
            for column in range(shape.columns)
        )
    return tuple(_lane(first, lane, shape.kind) for lane in range(shape.width))


def _lane(number: int, lane: int, kind: str) -> Bounded:
    if kind == "float":
        return given(floats()[number][..., lane])
    whole = integers()[number][..., lane]
    if kind == "bool":
        return exact(whole & 1 == 1)
    return exact(whole & 0xFFFFFFFF if kind == "uint" else whole)


def _flat(value: tuple[Any, ...]) -> Iterator[Any]:
    for item in value:
        yield from item if isinstance(item, tuple) else (item,)


def _ends(lane: Bounded, kind: str) -> tuple[Floats, Floats]:
    low, high = (np.broadcast_to(end, (SIDE, SIDE)) for end in (lane.low, lane.high))
    if kind in ("float", "bool"):
        return low.astype(np.float64), high.astype(np.float64)
    # Where rounding may turn out one way or the other, bits that are folded say nothing.
    certain = low == high
    bits = low.astype(np.int64) & 0xFFFFFFFF
    folded = np.where(certain, (bits ^ (bits >> 11)) & 0xFFFFFF, np.nan)
    return folded, folded

"""Keeps single numbers that evaluations of the same graphs have in common.

A frame draws all faces and levels of a cube map with one shader. Each of these draws would compute
anew what is the same for all pixels, such as the directions of the samples that a loop takes.
``frames/by_reference.py`` makes a ``KeptNumbers`` for all draws, and hands it on to the
``Evaluator`` of each stage.

Lanes with bounds are told apart by identity: ``x - x`` is zero for one lane, and not for two that
have equal bounds (``bounds/bounded.py``). So a result is kept for a single place of an evaluation,
and is used again only if the operands there are the very lanes that it was computed from.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from typing import Any

import numpy as np

from ..ir.leaves import Parameter
from ..ir.node import Node
from ..ir.types import Type, numbers
from .bounds import Bounded
from .namespace import Lane, Lanes

MOST_RESULTS = 1 << 16
"""The number of results that are kept: a loop with very many turns has more, of which the first
ones are."""
MOST_LANES = 64
"""The size of the largest parameter that is compared with its value of an earlier draw."""


class KeptNumbers:
    """The numbers that the draws of some frames, with one set of bounds, have in common."""

    def __init__(self) -> None:
        self._results: dict[Hashable, tuple[list[Lanes], Lanes]] = {}
        self._parameters: dict[Hashable, Lanes] = {}

    def value(self, node: Node, place: Hashable, operands: list[Lanes]) -> Lanes | None:
        """The value that was kept of an operation with just these operands."""
        found = self._results.get((node, place))
        if found is None or not _are_same(found[0], operands):
            return None
        return found[1]

    def keep(self, node: Node, place: Hashable, operands: list[Lanes], value: Lanes) -> None:
        """Keep the value of an operation, if it and all operands are single numbers."""
        if not (_are_numbers(value) and all(map(_are_numbers, operands))):
            return
        if len(self._results) < MOST_RESULTS or (node, place) in self._results:
            self._results[node, place] = operands, value

    def parameter(self, parameter: Parameter, type_: Type, value: Lanes) -> Lanes:
        """The lanes of a parameter: those of the draw before, if all numbers are the same."""
        if numbers(type_) > MOST_LANES:
            return value
        before = self._parameters.get((parameter, type_))
        if before is None or _bits(before) != _bits(value):
            self._parameters[parameter, type_] = before = value
        return before


def _are_same(some: Any, others: Any) -> bool:
    """True if values have the same lanes; those without bounds are the same if they are equal."""
    if some is others:
        return True
    if isinstance(some, tuple | list):
        return len(some) == len(others) and all(map(_are_same, some, others))
    return isinstance(some, int) and type(some) is type(others) and some == others


def _are_numbers(value: Any) -> bool:
    if isinstance(value, tuple):
        return all(map(_are_numbers, value))
    if isinstance(value, Bounded):
        return np.ndim(value.value) == 0 and value.ndim == 0
    return isinstance(value, int | float | np.generic)


def _bits(value: Lanes) -> list[tuple[str, bytes]]:
    """Everything by which the numbers of a value may differ."""
    arrays = map(np.asarray, _ends(value))
    return [(array.dtype.str, array.tobytes()) for array in arrays]


def _ends(value: Any) -> Iterator[Lane]:
    if isinstance(value, tuple):
        for part in value:
            yield from _ends(part)
    elif isinstance(value, Bounded):
        yield from (value.value,) if value.is_exact else (value.value, value.low, value.high)
    else:
        yield value

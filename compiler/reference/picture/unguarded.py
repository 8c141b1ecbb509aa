"""Finds where an ``unguarded`` operation leaves its domain: a device may give anything there.

``stage_evaluation.py`` asks while it evaluates the program of the source, whose hardware operations
are those that a person has written as ``unguarded``. In an emitted program most of them are proven
by range analysis, which knows more of their operands than a single picture shows.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ....stdlib.builtins import BUILTINS
from ....stdlib.builtins.facts import SMALLEST_NORMAL, UNKNOWN, Fact, Kind
from ....stdlib.builtins.row import Domain, everywhere, nowhere
from ...ir.node import Node
from ...ir.operations import CALL
from ...ir.types import scalar_kind
from ..namespace import Lanes
from .scene import Bools, Floats


def outside(node: Node, operands: Sequence[Lanes], shape: tuple[int, ...]) -> Bools:
    """True where the operands of a hardware operation are outside of its row's domain.

    The result has the given ``shape``. Operations that no hardware has, or all have everywhere, are
    never outside.
    """
    row = BUILTINS[CALL.data(node)]
    found = np.zeros(shape, dtype=np.bool_)
    if row.domain not in (everywhere, nowhere):
        given = [
            _Operand(scalar_kind(operand.type), lanes, shape)
            for operand, lanes in zip(node.operands, operands, strict=True)
        ]
        _mark(row.domain, given, found.reshape(-1))
    return found


class _Operand:
    """The numbers of one operand at all places."""

    def __init__(self, kind: Kind | None, lanes: Lanes, shape: tuple[int, ...]) -> None:
        self._kind = kind
        """``None`` for a texture or another aggregate, of which no domain asks anything."""
        self._numbers: Floats = np.array([])
        if kind is not None:
            spread: list[Any] = [np.broadcast_to(lane, shape).ravel() for lane in lanes]
            self._numbers = np.stack(spread).astype(np.float64)

    def fact(self, begin: int, end: int) -> Fact:
        """The fact of the operand at these places."""
        if self._kind is None:
            return UNKNOWN
        numbers = self._numbers[:, begin:end]
        return Fact(
            float(numbers.min()),
            float(numbers.max()),
            nonzero=bool((np.abs(numbers) >= SMALLEST_NORMAL).all()),
            length=float(np.sqrt(np.square(numbers).sum(axis=0)).min()),
            kind=self._kind,
        )


def _mark(domain: Domain, operands: Sequence[_Operand], found: Bools) -> None:
    """Mark the places outside of the domain, halving ranges of places until all are alike."""
    pending = [(0, len(found))] if len(found) else []
    while pending:
        begin, end = pending.pop()
        if domain(tuple(operand.fact(begin, end) for operand in operands)):
            continue
        if end - begin == 1:
            found[begin] = True
            continue
        middle = (begin + end) // 2
        pending += [(begin, middle), (middle, end)]

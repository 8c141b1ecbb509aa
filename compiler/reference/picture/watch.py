"""Observes an evaluation, and records where nothing is defined.

That is where a promise is broken, or an operation without a guard leaves its domain.
``stage_evaluation.py`` makes a ``Watch`` for each stage and ``compiler/reference/kernel.py`` one
for each run. Both hand it to the ``Evaluator``, and call ``end`` with the results.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ....stdlib.builtins import BUILTINS
from ...ir.node import Node
from ...ir.operations import BUILTIN_OPS, builtin_of
from ...ir.types import RuntimeArray, scalar_kind
from ..bounds import Bounded
from ..held_values import as_rounded
from ..namespace import Lanes
from ..vectors import inner
from .scene import Bools, RasterRules, Texels
from .unguarded import outside

_PROMISES = frozenset(name for name, row in BUILTINS.items() if row.is_promise)

BROKEN = 1e-5
"""A vector that is promised not to be zero breaks the promise if it is shorter."""


@dataclass(slots=True)
class Found:
    """The findings of all watches over a shader."""

    promised: frozenset[int]
    """The ids of the promises whose values are used in any case."""
    broken: set[int] = field(default_factory=set)
    """The ids of promises that were broken at some vertex, pixel or invocation."""
    left_a_domain: bool = False
    """True if any operation without a guard left its domain, here or in a texture that is read.

    There may be values that are NaN.
    """

    @classmethod
    def of(cls, roots: Sequence[Node], read: Iterable[Texels], rules: RasterRules) -> Found:
        """The findings at the start, for a shader with these results that reads these textures."""
        is_undefined = rules.unguarded_is_nan and any(texels.has_undefined for texels in read)
        return cls(_promised(roots), left_a_domain=is_undefined)


class Watch:
    """Observes one stage, whose lanes are plain arrays or have bounds."""

    def __init__(
        self, found: Found, shape: tuple[int, ...], rules: RasterRules, *, rounds: bool
    ) -> None:
        """``rounds`` says whether constants are as a text has them."""
        self._found, self._rules, self._rounds = found, rules, rounds
        self.undecided: Bools = np.zeros(shape, dtype=np.bool_)
        """True where nothing is defined, of ``shape``."""

    def __call__(self, node: Node, operands: list[Lanes], value: Lanes) -> Lanes:
        """The value with which the evaluation continues."""
        if node.id in self._found.promised:
            self._check(node, value)
        if self._rules.unguarded_is_nan:
            value = self._contained(node, operands, value)
        if node.op == "constant" and self._rounds:
            rounded: Lanes = as_rounded(value)
            return rounded
        return value

    def end(self, lanes: Lanes) -> None:
        """Records where results of the stage depend on an operation outside of its domain."""
        if self._found.left_a_domain:
            self._record_nan(lanes)

    def as_defined(self, value: Lanes) -> Lanes:
        """A result of the stage, with NaN for undefined floats, if that is asked for.

        So whoever reads it finds out.
        """
        if not (self._rules.unguarded_is_nan and self.undecided.any()):
            return value
        return tuple(_nan_where(self.undecided, lane) for lane in value)

    def _contained(self, node: Node, operands: list[Lanes], value: Lanes) -> Lanes:
        """The value, NaN where the operation leaves its domain.

        NaN goes through everything that is computed from it, and is dropped where a choice takes
        the other side. Conditions and whole numbers cannot hold it: they are recorded at once.
        """
        is_float = scalar_kind(node.type) == "float"
        if node.op == "native":
            meant = [tuple(map(_meant, lanes)) for lanes in operands]
            left = outside(node, meant, self.undecided.shape)
            if left.any():
                self._found.left_a_domain = True
                if is_float:
                    return tuple(_nan_where(left, lane) for lane in value)
                self.undecided |= left
        elif node.op == "index" and isinstance(node.operands[0].type, RuntimeArray):
            self._read(operands, is_float=is_float)
        if self._found.left_a_domain and node.op in BUILTIN_OPS and not is_float:
            self._record_nan(tuple(lane for lanes in operands for lane in lanes))
        return value

    def _read(self, operands: list[Lanes], *, is_float: bool) -> None:
        """Records reads of a buffer's elements of which nothing is defined; floats are NaN then."""
        (reader,), (position,) = operands
        left = reader.is_undecided(_meant(position))
        if np.any(left):
            self._found.left_a_domain = True
            if not is_float:
                self.undecided |= left

    def _record_nan(self, lanes: Lanes) -> None:
        for lane in map(_meant, lanes):
            if np.asarray(lane).dtype.kind == "f":
                self.undecided |= np.isnan(lane)

    def _check(self, node: Node, vector: Lanes) -> None:
        """Record where a promise is broken: nothing is defined there."""
        lanes = tuple(map(_meant, vector))
        short = np.sqrt(inner(lanes, lanes)) <= BROKEN
        if np.any(short):
            self._found.broken.add(node.id)
            self.undecided |= short


def _meant(lane: Any) -> Any:
    return lane.value if isinstance(lane, Bounded) else lane


def _nan_where(left: Bools, lane: Any) -> Any:
    if not isinstance(lane, Bounded):
        return np.where(left, np.nan, lane)
    value, low, high = (np.where(left, np.nan, end) for end in (lane.value, lane.low, lane.high))
    return Bounded(value, low, high)


def _promised(roots: Sequence[Node]) -> frozenset[int]:
    """The ids of the promises whose values are used in any case.

    Both sides of a choice are evaluated for all pixels here, and one may be there because a promise
    of the other does not hold.
    """
    seen = set(roots)
    pending = list(seen)
    while pending:
        node = pending.pop()
        used = node.operands[:1] if node.op == "select" else node.operands
        pending += (new := [operand for operand in used if operand not in seen])
        seen.update(new)
    return frozenset(node.id for node in seen if builtin_of(node) in _PROMISES)

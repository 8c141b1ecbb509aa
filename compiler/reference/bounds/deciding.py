"""Bounds by cases: each decision that rounding may tip is tried on both sides.

Where a ``floor`` may tip, ``fract`` of the same number is near 0 on one side and near 1 on the
other, and what is computed from both is often the same on either side: a noise is continuous where
its cells meet. The hull of both outcomes forgets which of them belong together. So the part of the
program with these decisions is evaluated once for each combination of their outcomes, and only the
results are joined. ``StageEvaluator.decided`` does so for pixels whose bounds are wide, and
``bodies.py`` for the bodies of loops and functions by themselves.

An outcome belongs to a number that a device has computed once: all that asks for the floor of that
number gets the same one. Only outcomes are fixed. The number itself keeps its interval.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..namespace import Attempts, Decisions, Lane
from .affine import alone, chosen
from .bounded import Bounded, as_bounded
from .functions import Bounds, Errors
from .loop_ends import LoopEnds
from .nested import flat, rebuilt
from .rounding import Array

MOST = 2
"""The number of decisions of one pixel, in one part of a program, of which all combinations are
tried. Further ones are left open."""


@dataclass(slots=True, eq=False)
class Case:
    """One combination of outcomes: that of each pixel's decisions is a bit of ``number``, the first
    one that the pixel comes to is the lowest."""

    number: Array
    """A single number, or one for each quad."""
    counts: Array = field(default_factory=lambda: np.zeros((), np.int64))
    """The number of decisions of each pixel that are fixed."""
    meant: Array = True
    """True for pixels whose outcomes are those of the program without rounding."""
    known: dict[Hashable, tuple[Array, Array]] = field(default_factory=dict)
    """For each decision the pixels where it is fixed, and its outcome."""

    def outcome(self, key: Hashable, tips: Array, meant: Array) -> tuple[Array, Array]:
        """Where a decision is fixed, and its outcome there; ``meant`` is that without rounding."""
        if key not in self.known:
            fixed = tips & (self.counts < MOST)
            upper = (self.number >> np.minimum(self.counts, MOST)) & 1 == 1
            self.counts = self.counts + fixed
            self.meant = self.meant & (~fixed | (upper == meant))
            self.known[key] = fixed, upper
        return self.known[key]

    @property
    def most(self) -> int:
        """The largest number of decisions of any pixel."""
        return int(self.counts.max())


class Deciding(Bounds, Decisions):
    """Bounds of one case after the other."""

    def __init__(self, errors: Errors, is_open: Callable[[Any], bool]) -> None:
        """Decisions of nodes that are ``is_open`` are left open."""
        super().__init__(errors)
        self._is_open = is_open
        self._cases: dict[int, Case] = {}
        """The case in each frame, by the frame's identity."""
        self._case: Case | None = None
        """The case of the operation that is computed; ``None`` if its decisions are left open."""

    def begin(self, frame: object, case: Case) -> None:
        """Take a case for what is computed in a frame."""
        self._cases[id(frame)] = case

    def at(self, node: Any, frame: object) -> None:
        """Take the case of an operation, whose value is kept in a frame."""
        self._case = None if self._is_open(node) else self._cases[id(frame)]

    def endings(self) -> LoopEnds:
        """The endings of a loop: whether it goes on is a decision, too."""
        return _DecidedEnds(self)

    def goes_on(self, before: Any, condition: Any) -> Any:
        """The condition of a loop, which holds or not."""
        if not isinstance(condition, Bounded) or condition.is_exact:
            return condition
        tips = as_bounded(before).high & condition.high & ~condition.low
        return self._fixed(condition._number, condition, tips, condition.value)

    def attempts(self) -> _Attempts:
        """The attempts at one body."""
        return _Attempts(self._cases)

    # --- decisions --------------------------------------------------------------------------------

    def where(self, condition: Any, x: Any, y: Any, /) -> Any:
        """The choice, with a condition that holds or not."""
        if isinstance(condition, Bounded) and not condition.is_exact:
            tips = condition.high & ~condition.low
            condition = self._fixed(condition._number, condition, tips, condition.value)
        return super().where(condition, x, y)

    def floor(self, x: Any, /) -> Bounded:
        return self._step("floor", x, super().floor)

    def ceil(self, x: Any, /) -> Bounded:
        return self._step("ceil", x, super().ceil)

    def rint(self, x: Any, /) -> Bounded:
        return self._step("rint", x, super().rint)

    def trunc(self, x: Any, /) -> Bounded:
        return self._step("trunc", x, super().trunc)

    def int64(self, x: Any, /) -> Bounded:
        return self._step("int64", x, super().int64)

    def fract(self, x: Any, /) -> Bounded:
        """The part above the floor that the case has, which is not that of the value."""
        found = super().fract(x)
        value = np.clip(found.value, found.low, found.high)
        form = found.form and found.form.widened(np.abs(value - found.value))
        return Bounded(value, found.low, found.high, form).made_as(found)

    def remainder(self, x: Any, y: Any, /) -> Bounded:
        """The remainder for the floor of the quotient that the case has."""
        x, y = as_bounded(x), as_bounded(y)
        if x.is_exact and y.is_exact:
            return super().remainder(x, y)
        return self._remainder(x, y)

    def _step(self, name: str, lane: Any, function: Callable[[Any], Bounded]) -> Bounded:
        """A function whose results are whole numbers, of which one of two is taken."""
        x = as_bounded(lane)
        found = function(x)
        if found.is_exact:
            return found
        tips = found.high - found.low == 1
        return self._fixed((name, x._number), found, tips, found.value == found.high)

    def _fixed(self, key: Hashable, found: Bounded, tips: Array, meant: Array) -> Bounded:
        """A lane that has one of its ends where it may tip."""
        if self._case is None or not tips.any():
            return found
        fixed, upper = self._case.outcome(key, tips, meant)
        outcome = np.where(upper, found.high, found.low)
        value, low, high = (
            np.where(fixed, outcome, end) for end in (found.value, found.low, found.high)
        )
        return Bounded(value, low, high)


class _DecidedEnds(LoopEnds):
    """The endings of a loop in one case."""

    def __init__(self, decisions: Deciding) -> None:
        super().__init__()
        self._decisions = decisions

    def decided(self, before: Lane, condition: Lane) -> Lane:
        return self._decisions.goes_on(before, condition)


class _Attempts(Attempts):
    """The cases of one body, one after the other."""

    def __init__(self, cases: dict[int, Case]) -> None:
        self._cases = cases
        self._case = Case(0)
        self._most = 0
        self._found: list[tuple[Case, list[Any]]] = []

    def begin(self, frame: object) -> None:
        self._frame = frame
        self._cases[id(frame)] = self._case

    def end(self, value: Any) -> Any:
        del self._cases[id(self._frame)]
        self._found.append((self._case, list(flat(value))))
        self._most = max(self._most, self._case.most)
        number = self._case.number + 1
        if number < 2**self._most:
            self._case = Case(number)
            return None
        if len(self._found) == 1:
            return value
        cases = [case for case, _ in self._found]
        columns = zip(*(lanes for _, lanes in self._found), strict=True)
        joined = iter([_joined(cases, list(column)) for column in columns])
        return rebuilt(value, joined)


def _joined(cases: list[Case], lanes: list[Bounded]) -> Bounded:
    """A lane that is one of several, by which of the cases is true."""
    value, low, high = lanes[0].value, lanes[0].low, lanes[0].high
    for case, lane in zip(cases[1:], lanes[1:], strict=True):
        value = np.where(case.meant, lane.value, value)
        low, high = np.minimum(low, lane.low), np.maximum(high, lane.high)
    if all(lane.form is None for lane in lanes) or lanes[0].kind != "f":
        return Bounded(value, low, high)
    certain = np.logical_not(sum(case.counts for case in cases))
    farther = Bounded(value, low, high).radius
    form = chosen(certain, np.zeros_like(certain), lanes[0].any_form, alone(farther), farther)
    return Bounded(value, low, high, form)

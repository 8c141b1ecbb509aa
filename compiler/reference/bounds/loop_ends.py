"""Loops of which rounding may decide in what turn they end.

A state that is the hull of those of a device that has ended and of one that goes on would be as
wide as a whole turn, and grow in each further one. So the states of the loop are those of devices
that go on, and what a device has that may have ended is kept here until the loop is over.
``bodies.py`` asks for it.
"""

from __future__ import annotations

import numpy as np

from ..namespace import Endings, Lane, Lanes
from .affine import alone, chosen
from .bounded import Bounded, as_bounded, exact
from .nested import flat, rebuilt
from .rounding import Array


class LoopEnds(Endings):
    """The states with which a loop may have ended although it may also have gone on."""

    def __init__(self) -> None:
        self._ended: Array | None = None
        """True for elements that have such states; ``None`` as long as there are none."""
        self._meant: Array = False
        """True where the program itself ends with such a state."""
        self._states: list[Bounded] = []

    def decided(self, _before: Lane, condition: Lane) -> Lane:
        return condition

    def goes_on(self, before: Lane, condition: Lane, states: list[Lanes]) -> Lane:
        """The condition by which a state goes on: exact, and true where it may."""
        before, condition = as_bounded(before), as_bounded(condition)
        open_ = before.high & condition.high & ~condition.low
        if open_.any():
            self._note(open_, open_ & before.value & ~condition.value, states)
        return exact(before.high & condition.high)

    def of(self, states: list[Lanes]) -> list[Lanes]:
        """The states behind the loop, from those of devices that have gone on."""
        if self._ended is None:
            return states
        ended = iter(self._states)
        return [
            rebuilt(state, iter([self._either(lane, next(ended)) for lane in flat(state)]))
            for state in states
        ]

    def _note(self, open_: Array, meant: Array, states: list[Lanes]) -> None:
        lanes = [lane for state in states for lane in flat(state)]
        if self._ended is None:
            self._ended, self._meant, self._states = open_, meant, lanes
            return
        known = self._ended
        self._states = [
            _noted(open_, known, meant, *pair) for pair in zip(self._states, lanes, strict=True)
        ]
        self._ended, self._meant = known | open_, self._meant | meant

    def _either(self, lane: Bounded, ended: Bounded) -> Bounded:
        """The lane of a device that has gone on, or that has ended before."""
        here = self._ended
        assert here is not None
        value = np.where(self._meant, ended.value, lane.value)
        low = np.where(here, np.minimum(ended.low, lane.low), lane.low)
        high = np.where(here, np.maximum(ended.high, lane.high), lane.high)
        if lane.form is None:
            return Bounded(value, low, high)
        farther = Bounded(value, low, high).radius
        form = chosen(~here, np.zeros_like(here), lane.form, alone(farther), farther)
        return Bounded(value, low, high, form)


def _noted(open_: Array, known: Array, meant: Array, before: Bounded, lane: Bounded) -> Bounded:
    """The states with which a loop may have ended, with those of one more turn."""
    return Bounded(
        np.where(meant, lane.value, before.value),
        np.where(open_, np.where(known, np.minimum(before.low, lane.low), lane.low), before.low),
        np.where(open_, np.where(known, np.maximum(before.high, lane.high), lane.high),
                 before.high),
    )  # fmt: skip

"""The stencil values of a canvas: the stencil test, and the changes of the values.

``canvas.py`` asks for each layer of fragments. Where rounding may tip a change of a value, the
value is not known any more, and neither are the fragments that it lets through. Sources: Vulkan,
"Stencil Test"; OpenGL 4.6, 17.3.3.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...ir.render_state import STENCIL_MOST, StencilOperation, StencilSide, StencilState
from .comparing import compared
from .scene import Bools, Ints

_VALUES = STENCIL_MOST + 1

_FORGET: frozenset[StencilOperation] = frozenset(("zero", "replace"))
"""The operations after which the value before does not matter, if all bits are written."""


def operated(operation: StencilOperation, there: Ints, reference: int) -> Ints:
    """The new values after an operation."""
    match operation:
        case "keep":
            return there
        case "zero":
            return np.zeros_like(there)
        case "replace":
            return np.full_like(there, reference)
        case "invert":
            return STENCIL_MOST - there
        case "increment_clamp":
            return np.minimum(there + 1, STENCIL_MOST)
        case "decrement_clamp":
            return np.maximum(there - 1, 0)
        case "increment_wrap":
            return (there + 1) % _VALUES
        case "decrement_wrap":
            return (there - 1) % _VALUES


@dataclass(frozen=True, slots=True)
class Outcomes:
    """The possible outcomes of a condition: where it holds, and where a device may differ."""

    holds: Bools
    open: Bools

    @property
    def may_hold(self) -> Bools:
        """True where it may hold on some device."""
        return self.holds | self.open

    @property
    def may_fail(self) -> Bools:
        """True where it may fail on some device."""
        return ~self.holds | self.open

    def both(self, other: Outcomes) -> Outcomes:
        """The outcomes of this condition and another one together."""
        holds = self.holds & other.holds
        may_hold = self.may_hold & other.may_hold
        return Outcomes(holds, may_hold & (self.may_fail | other.may_fail))


@dataclass(frozen=True, slots=True)
class StencilTest:
    """The test of some fragments."""

    state: StencilState
    front: Bools
    """(fragments,): whether the front of their face is seen."""

    def part(self, members: Ints) -> StencilTest:
        """The test of some of the fragments."""
        return StencilTest(self.state, self.front[members])

    def sides(self) -> tuple[tuple[StencilSide, Bools], ...]:
        """Either side, and which fragments have it."""
        return (self.state.front, self.front), (self.state.back, ~self.front)


class Stencil:
    """The value of each pixel."""

    def __init__(self, pixels: int) -> None:
        self.values: Ints = np.zeros(pixels, np.int64)
        self.unsure: Bools = np.zeros(pixels, np.bool_)
        """True where a device may have another value."""

    def tested(self, test: StencilTest, at: Ints) -> Outcomes:
        """The fragments that the values let through, at these pixels."""
        state, there = test.state, self.values[at]
        if not state.tests:
            return Outcomes(np.ones(len(at), np.bool_), np.zeros(len(at), np.bool_))
        passes = np.zeros(len(at), np.bool_)
        hangs_on_value = np.zeros(len(at), np.bool_)
        mask = state.read_mask
        for side, of_side in test.sides():
            found = compared(side.compare, np.asarray(state.reference & mask), there & mask)
            passes = np.where(of_side, found, passes)
            hangs_on_value |= of_side & (side.compare not in ("never", "always"))
        return Outcomes(passes, hangs_on_value & self.unsure[at])

    def change(
        self, test: StencilTest, at: Ints, there: Outcomes, passes: Outcomes, nearer: Outcomes
    ) -> None:
        """Changes the values, for at most one fragment at each pixel.

        ``there`` says whether there is a fragment, which is not so if it is discarded; ``passes``
        is the outcome of the stencil test, and ``nearer`` that of the depth test.
        """
        state, before = test.state, self.values[at]
        if not state.writes:
            return
        after, differs = before.copy(), np.zeros(len(at), np.bool_)
        forgets = ~there.may_fail if state.write_mask == STENCIL_MOST else np.zeros_like(differs)
        both = passes.both(nearer)
        failed, hidden = Outcomes(~passes.holds, passes.open), _behind(passes, nearer)
        cases: list[tuple[Callable[[StencilSide], StencilOperation], Outcomes]] = [
            (lambda side: side.fail_op, failed),
            (lambda side: side.depth_fail_op, hidden),
            (lambda side: side.pass_op, both),
        ]
        possible = []
        for side, of_side in test.sides():
            for operation_of, case in cases:
                operation = operation_of(side)
                changed = operated(operation, before, state.reference)
                changed = (changed & state.write_mask) | (before & ~state.write_mask)
                happens = of_side & there.holds & case.holds
                after = np.where(happens, changed, after)
                forgets &= ~(of_side & case.may_hold) | (operation in _FORGET)
                possible.append((of_side & there.may_hold & case.may_hold, changed))
        for may_happen, changed in possible:
            differs |= may_happen & (changed != after)
        differs |= there.may_fail & (before != after)
        self.values[at] = after
        self.unsure[at] = differs | (self.unsure[at] & ~forgets)


def _behind(passes: Outcomes, nearer: Outcomes) -> Outcomes:
    """The outcomes of "only the depth test fails"."""
    return passes.both(Outcomes(~nearer.holds, nearer.open))

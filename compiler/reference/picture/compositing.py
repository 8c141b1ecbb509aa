"""Blending: the content of a target after a colour is drawn over another, with its bounds.

``canvas.py`` calls it for every fragment that is drawn to a target which is blended. The formulas
are those of Vulkan ("Blending"), OpenGL 4.6 (17.3.6) and WebGPU ("Blend State"). The source, the
destination and the constant have been clamped to the range of the format before, as all of these
want it of formats in fixed point. Each product and each sum is rounded as a device may round it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...ir.blending import Blend, BlendEquation, Factor, Operation
from ..bounds import Bounded, exact
from ..namespace import Lanes
from .scene import Floats

ALPHA = 3
"""The lane that has an equation of its own."""


@dataclass(frozen=True, slots=True)
class Sides:
    """The operands of blending, lane by lane."""

    source: Lanes
    """The colour that is drawn."""
    destination: Lanes
    """The colour in the target."""
    constant: Lanes
    """The constant that the host sets for the whole pass."""


def composed(
    blend: Blend, source: Floats, destination: Floats, constant: Sequence[float]
) -> Floats:
    """The contents of a target after colours (3, …, 4) are drawn over others.

    They are the values, and the bounds of those of a device.
    """
    fixed = tuple(exact(np.float64(lane)) for lane in constant)
    sides = Sides(_lanes(source), _lanes(destination), fixed)
    equations = [blend.color] * ALPHA + [blend.alpha]
    made = [_joined(equation, sides, lane) for lane, equation in enumerate(equations)]
    shape = source.shape[1:-1]
    spread = [lane.spread(shape) for lane in made]
    return np.stack([np.stack([x.value, x.low, x.high]) for x in spread], axis=-1)


def _lanes(colours: Floats) -> Lanes:
    return tuple(Bounded(*np.moveaxis(colours, -1, 0)[i]) for i in range(ALPHA + 1))


def _joined(equation: BlendEquation, sides: Sides, lane: int) -> Bounded:
    drawn, there = sides.source[lane], sides.destination[lane]
    if equation.operation in CHOICES:
        choice = CHOICES[equation.operation]
        return Bounded(
            choice(drawn.value, there.value), choice(drawn.low, there.low),
            choice(drawn.high, there.high),
        )  # fmt: skip
    first = _weighted(drawn, equation.source, sides, lane)
    second = _weighted(there, equation.destination, sides, lane)
    if equation.operation == "reverse_subtract":
        first, second = second, first
    if second is None:
        return exact(np.float64(0.0)) if first is None else first
    if equation.operation != "add":
        second = -second
    return second if first is None else first + second


def _weighted(of: Bounded, factor: Factor, sides: Sides, lane: int) -> Bounded | None:
    """A side times its factor; ``None`` where it has no part in the sum."""
    if factor == "zero":
        return None
    return of if factor == "one" else of * FACTORS[factor](sides, lane)


def _saturated(sides: Sides, lane: int) -> Bounded:
    """The smaller of the source's alpha and 1 minus the destination's; for alpha itself, 1."""
    if lane == ALPHA:
        return exact(np.float64(1.0))
    drawn, left = sides.source[ALPHA], 1.0 - sides.destination[ALPHA]
    least = np.minimum
    return Bounded(
        least(drawn.value, left.value), least(drawn.low, left.low), least(drawn.high, left.high)
    )


FACTORS: Mapping[Factor, Callable[[Sides, int], Bounded]] = {
    "src": lambda sides, lane: sides.source[lane],
    "one_minus_src": lambda sides, lane: 1.0 - sides.source[lane],
    "src_alpha": lambda sides, _: sides.source[ALPHA],
    "one_minus_src_alpha": lambda sides, _: 1.0 - sides.source[ALPHA],
    "dst": lambda sides, lane: sides.destination[lane],
    "one_minus_dst": lambda sides, lane: 1.0 - sides.destination[lane],
    "dst_alpha": lambda sides, _: sides.destination[ALPHA],
    "one_minus_dst_alpha": lambda sides, _: 1.0 - sides.destination[ALPHA],
    "src_alpha_saturated": _saturated,
    "constant": lambda sides, lane: sides.constant[lane],
    "one_minus_constant": lambda sides, lane: 1.0 - sides.constant[lane],
}
"""The value of each factor in a lane; those that are not here are numbers."""

CHOICES: Mapping[Operation, Callable[[Floats, Floats], Floats]] = {
    "min": np.minimum,
    "max": np.maximum,
}
"""The operations that keep one of the two as it is."""

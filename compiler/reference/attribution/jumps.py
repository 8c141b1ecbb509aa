"""The operations whose results jump: the distance of their operands to a jump, and its other side.

``influences.py`` looks at each of them. A jump that rounding may tip has no small error: the pixel
is one or the other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...ir.node import Node
from ...ir.operations import builtin_of
from ...ir.types import scalar_kind
from ..namespace import Lane, Lanes


@dataclass(frozen=True, eq=False, slots=True)
class JumpRule:
    """A rule for the jumps of one builtin, lane by lane."""

    coordinate: Callable[..., Lane]
    """A function of the operands' lanes that moves steadily and is special where it jumps."""
    at_whole: bool
    """True if it jumps at whole numbers, and not at zero."""
    beyond: Callable[[Lane, float, list[Lane]], Lane]
    """The result on the other side: from the result, the side (1 or -1) and the operands' lanes."""
    words: str
    """The property of the operands where it jumps, in words."""


def _difference(x: Lane, y: Lane) -> Lane:
    return x - y


def _itself(x: Lane) -> Lane:
    return x


_ONE_OFF: Callable[[Lane, float, list[Lane]], Lane] = lambda value, side, _: value - int(side)  # noqa: E731
_COMPARISON = JumpRule(
    _difference, False, lambda value, _side, _lanes: np.logical_not(value), "equality"
)
_WHOLE = JumpRule(_itself, True, _ONE_OFF, "a whole number")

RULES: Mapping[str, JumpRule] = {
    **dict.fromkeys(("lt", "le", "gt", "ge", "eq", "ne"), _COMPARISON),
    "step": JumpRule(_difference, False, lambda value, _side, _lanes: 1.0 - value, "its edge"),
    "sign": JumpRule(_itself, False, lambda value, _side, _lanes: -value, "zero"),
    **dict.fromkeys(("floor", "ceil", "trunc", "to_int", "to_uint"), _WHOLE),
    "fract": JumpRule(_itself, True, lambda value, side, _: value + side, "a whole number"),
    "round": JumpRule(
        lambda x: x + 0.5, True, _ONE_OFF, "the middle between two whole numbers"
    ),
    "mod": JumpRule(
        lambda x, y: x / y,
        True,
        lambda value, side, lanes: value + side * lanes[1],
        "a multiple of its divisor",
    ),
}  # fmt: skip
"""The builtins on floats that jump."""


@dataclass(eq=False, slots=True)
class Jump:
    """One lane of an operation that jumps, in one pixel."""

    lane: int
    words: str
    repeats: bool
    """True if it jumps at every whole number."""
    distance: float
    """The distance of the operands from the jump; of a mod, in divisors."""
    side: float
    """1 above the jump, -1 below it."""
    error: float = 0.0
    """The error that the distance may have."""
    effect: Any = None
    """(lanes of the picture,): by how much the picture changes if it tips."""

    @property
    def may_tip(self) -> bool:
        """True if rounding may put the operands on the other side."""
        return 0 < self.error >= self.distance


def rule_of(node: Node) -> JumpRule | None:
    """The rule for the jumps of an operation, or ``None``; operations on integers are exact."""
    rule = RULES.get(builtin_of(node) or "")
    if rule is None or scalar_kind(node.operands[0].type) != "float":
        return None
    return rule


def coordinates(rule: JumpRule, operands: list[Lanes]) -> list[Lane]:
    """The coordinate of each lane."""
    return [rule.coordinate(*lanes) for lanes in by_lane(operands)]


def by_lane(operands: list[Lanes]) -> list[list[Lane]]:
    """The operands' lanes for each lane of the result; a single lane goes with every other."""
    width = max(map(len, operands))
    wide = [lanes * width if len(lanes) == 1 else lanes for lanes in operands]
    return [list(lanes) for lanes in zip(*wide, strict=True)]


def jump_at(rule: JumpRule, lane: int, coordinate: float) -> Jump:
    """The jump that is closest to a coordinate."""
    offset = coordinate - np.rint(coordinate) if rule.at_whole else coordinate
    return Jump(lane, rule.words, rule.at_whole, abs(float(offset)), 1.0 if offset >= 0 else -1.0)

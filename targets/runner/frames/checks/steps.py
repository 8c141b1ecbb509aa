"""Checks the steps that compute a value: of a plan's values, and of all that reflections derive."""

from __future__ import annotations

from collections.abc import Sequence

from .....compiler.ir.host import KNOWN_TO_HOST
from .rows import Row, fail

MOST_TERMS = 1 << 16
"""Of a sum that a host computes."""


def check_steps(plan: Row, where: str, steps: Sequence[Row]) -> None:
    """Raise ``PlanError`` for a step that is no known operation on what stands before it."""
    for number, step in enumerate(steps):
        if step["op"] not in KNOWN_TO_HOST:
            fail(plan, where, f"there is no operation `{step['op']}`")
        if step.get("bound", 0) > MOST_TERMS:
            fail(plan, where, f"step {number} has {step['bound']} terms")
        if not all(0 <= each < number for each in step["args"]):
            args = step["args"]
            told = args if len(args) <= MOST_SAID else f"{len(args)} steps"
            fail(plan, where, f"step {number} is computed of {told}, which do not stand before it")


MOST_SAID = 10
"""How many arguments of a step are listed."""

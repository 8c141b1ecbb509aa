"""Checks the steps that compute a value: those of a plan, and those of reflections."""

from __future__ import annotations

from collections.abc import Sequence

from .....compiler.documents.steps import CallStep, FoldStep, StepRow
from .....compiler.reference.functions import OF_NUMBERS
from .rows import PlanError

_FUNCTIONS = OF_NUMBERS | {"texture_size"}
MOST_TERMS = 1 << 16
"""The most terms of a sum that a host computes."""


MOST_SAID = 10
"""The most arguments of a step that a message lists."""


def check_steps(where: str, steps: Sequence[StepRow]) -> None:
    """Raise ``PlanError`` for a step that is no known operation on steps before it."""
    for number, step in enumerate(steps):
        if isinstance(step, CallStep) and step.function not in _FUNCTIONS:
            raise PlanError(f"{where}: there is no function `{step.function}`")
        if isinstance(step, FoldStep) and step.bound > MOST_TERMS:
            raise PlanError(f"{where}: step {number} has {step.bound} terms")
        if not all(0 <= each < number for each in step.args):
            args = step.args
            told = list(args) if len(args) <= MOST_SAID else f"{len(args)} steps"
            raise PlanError(
                f"{where}: step {number} is computed of {told}, which do not stand before it"
            )

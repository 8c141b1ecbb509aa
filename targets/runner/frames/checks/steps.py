"""Checks the steps that compute a value: of a plan's values, and of all that reflections derive."""

from __future__ import annotations

from collections.abc import Sequence

from .....compiler.documents.steps import CallStep, FoldStep, StepRow
from .....compiler.reference.functions import OF_NUMBERS
from .rows import PlanError

_FUNCTIONS = OF_NUMBERS | {"texture_size"}
MOST_TERMS = 1 << 16
"""Of a sum that a host computes."""


MOST_SAID = 10
"""How many arguments of a step are listed."""


def check_steps(where: str, steps: Sequence[StepRow]) -> None:
    """Raise ``PlanError`` for a step that is no known operation on what stands before it."""
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

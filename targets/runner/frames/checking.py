"""Checks a plan before it is executed: ``FrameHost`` and the tests call it.

A plan may come from a file, from somebody else, or from a faulty compiler. One that contradicts
itself, or its shaders, must not draw another picture without a word.
"""

from __future__ import annotations

from collections.abc import Sequence

from ....compiler.documents.plan import FramePlan
from ....compiler.documents.reflection import Reflection
from .checks.names import check_names
from .checks.needs import check_needs
from .checks.order import check_order
from .checks.repeats import check_repeats
from .checks.rows import PlanError
from .checks.shaders import check_shaders

__all__ = ("PlanError", "check_plan")


def check_plan(plan: FramePlan, reflections: Sequence[Reflection] | None = None) -> None:
    """Raise ``PlanError`` for a plan that cannot be meant.

    The plan follows its schema. ``reflections`` are those of its shaders, in order; without them
    only the plan itself is checked.
    """
    check_names(plan)
    check_order(plan)
    check_needs(plan)
    check_repeats(plan, reflections)
    if reflections is not None:
        check_shaders(plan, reflections)

"""Rows for values that the invocations of a kernel compute together, one work group at a time."""

from __future__ import annotations

from ...support.frozen import changed
from .accuracy import PLATFORMS, Accuracy, Inherited, promised, silent
from .facts import Fact
from .row import Builtin, OfGroup

_TOGETHER = "Of all elements that are computed by the same work group: "


def _joined_by(expression: str) -> Accuracy:
    """No language has these functions: the texts join by an operation that it has."""
    bound = Inherited(expression)
    return promised(bound, silent(bound, f"the text computes `{expression}`", *PLATFORMS))


def _one_of(facts: tuple[Fact, ...], _same: bool) -> Fact:
    """Each lane is that lane of some invocation; but together they need not be anyone's vector."""
    return changed(facts[0], unit=False, length=0.0)


ROWS = (
    Builtin(
        name="group_sum",
        signatures=("N -> N",),
        doc=f"{_TOGETHER}the sum of `x`. Numbers are added in pairs, always in the same order: of "
        "64 of them each of the first 32 with the one that stands 32 further on, then each of the "
        "first 16 with the one 16 further on, and so on.",
        accuracy=_joined_by("x + y"),
        cost=64,
        uniform_control_flow=True,
        of_group=OfGroup("all", "add"),
    ),
    Builtin(
        name="group_min",
        signatures=("N -> N",),
        meaning="limits",
        doc=f"{_TOGETHER}the least `x`, lane by lane.",
        range=_one_of,
        accuracy=_joined_by("min(x, y)"),
        cost=64,
        uniform_control_flow=True,
        of_group=OfGroup("all", "min"),
    ),
    Builtin(
        name="group_max",
        signatures=("N -> N",),
        meaning="limits",
        doc=f"{_TOGETHER}the greatest `x`, lane by lane.",
        range=_one_of,
        accuracy=_joined_by("max(x, y)"),
        cost=64,
        uniform_control_flow=True,
        of_group=OfGroup("all", "max"),
    ),
    Builtin(
        name="group_inclusive_sum",
        signatures=("N -> N",),
        doc="The sum of `x` of all elements of the same work group up to this one, including it. "
        "To what an element has, first that of the element before is added, then that of the one 2 "
        "before, 4 before, and so on.",
        accuracy=_joined_by("x + y"),
        cost=64,
        uniform_control_flow=True,
        of_group=OfGroup("through", "add"),
    ),
    Builtin(
        name="group_exclusive_sum",
        signatures=("N -> N",),
        doc="The sum of `x` of all elements of the same work group that come before this one; 0 at "
        "the first. It is the `group_inclusive_sum` of the element before.",
        accuracy=_joined_by("x + y"),
        cost=64,
        uniform_control_flow=True,
        of_group=OfGroup("before", "add"),
    ),
)

"""The work group of a kernel: the size that it names, or the usual one.

``kernels.py`` calls ``work_group_of`` when it knows how many dimensions the results have.
"""

from __future__ import annotations

from ...diagnostics import rules
from ...ir.kernel import MOST_INVOCATIONS, USUAL, WorkGroup, invocations
from ...ir.types import INT
from ...syntax import ast
from ..declarations.fitting import typed
from ..inheritance.records import Record
from ..state.context import Context
from ..state.scope import Scope


def work_group_of(ctx: Context, record: Record, dimensions: int) -> WorkGroup:
    """The size of a kernel's work groups; the usual one after reporting an error in it."""
    usual = USUAL[dimensions]
    found = next(iter(record.every(ast.WorkGroup)), None)
    if found is None:
        return usual
    member, owner, _level = found
    if len(member.sides) > dimensions:
        ctx.report.add(
            rules.WORK_GROUP_SIDES, member.span, sides=len(member.sides), dimensions=dimensions
        )
        return usual
    scope = Scope(owner.module)
    values = [
        ctx.constants.integer(typed(ctx, side, scope, INT, "int"), side.span)
        for side in member.sides
    ]
    sides = [value for value in values if value is not None]
    if len(sides) < len(values):
        return usual
    x, y, z = (*sides, 1, 1)[:3]
    group = (x, y, z)
    if min(group) < 1 or invocations(group) > MOST_INVOCATIONS:
        ctx.report.add(
            rules.WORK_GROUP_SIZE, member.span, size=" by ".join(map(str, sides)),
            most=MOST_INVOCATIONS,
        )  # fmt: skip
        return usual
    return group

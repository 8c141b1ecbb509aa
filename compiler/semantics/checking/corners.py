"""``corner[k]`` in an expansion: which vertex of the primitive is meant."""

from __future__ import annotations

from ...diagnostics import rules
from ...diagnostics.source import Span
from ...ir import build
from ...ir.node import Node
from ...ir.types import INT
from ..declarations.fitting import fit
from ..state.context import Context
from ..state.scope import FAILURE, Corner, Corners, Failure, Value


def numbered(ctx: Context, corners: Corners, number: Node | Failure, span: Span) -> Value:
    """One of a primitive's corners; a number that is not known yet counts as the nearest one."""
    position = fit(ctx, number, INT, "int", span)
    if isinstance(position, Failure):
        return FAILURE
    last = corners.slots.corners - 1
    known = ctx.constants.known_integer(position)
    if known is None:
        inner = ctx.crossings.checked_at_vertex(position, span)
        if isinstance(inner, Failure):
            return FAILURE
        ends = (build.constant(ctx.tree, INT, end) for end in (0, last))
        nearest = ctx.tree.node("call", INT, (inner, *ends), "clamp")
        return Corner(corners.slots, corners.instance, nearest)
    if not 0 <= known <= last:
        ctx.report.add(rules.NO_SUCH_CORNER, span, index=known, last=last)
        return FAILURE
    return Corner(corners.slots, corners.instance, build.constant(ctx.tree, INT, known))

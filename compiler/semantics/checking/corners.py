"""``corner[k]`` or ``end[k]``: which vertex of the primitive is meant."""

from __future__ import annotations

from ...diagnostics import rules
from ...diagnostics.source import Span
from ...ir import build
from ...ir.node import Node
from ...ir.types import INT, Array
from ..declarations.fitting import fit
from ..state.context import Context
from ..state.scope import FAILURE, Corner, Corners, Failure, Value


def numbered(ctx: Context, corners: Corners, number: Node | Failure, span: Span) -> Value:
    """One of a primitive's corners; a number that is not known yet counts as the nearest one."""
    position = fit(ctx, number, INT, "int", span)
    if isinstance(position, Failure):
        return FAILURE
    last = len(corners.numbers) - 1
    known = ctx.constants.known_integer(position)
    if known is None:
        fact = ctx.ranges.of(position)
        if fact.lo > last or fact.hi < 0:
            end = f"{fact.lo:.0f} or above" if fact.lo > last else f"{fact.hi:.0f} or below"
            ctx.report.add(rules.NO_SUCH_CORNER, span, what=corners.word, index=end, last=last)
            return FAILURE
        inner = ctx.crossings.checked_at_vertex(position, span)
        if isinstance(inner, Failure):
            return FAILURE
        ends = (build.constant(ctx.tree, INT, end) for end in (0, last))
        nearest = ctx.tree.node("call", INT, (inner, *ends), "clamp")
        return Corner(corners.instance, _vertex(ctx, corners, nearest), corners.crossing)
    if not 0 <= known <= last:
        ctx.report.add(rules.NO_SUCH_CORNER, span, what=corners.word, index=known, last=last)
        return FAILURE
    vertex = build.constant(ctx.tree, INT, corners.numbers[known])
    return Corner(corners.instance, vertex, corners.crossing)


def _vertex(ctx: Context, corners: Corners, number: Node) -> Node:
    """The number that a corner has among the primitive's vertices."""
    if corners.numbers == tuple(range(len(corners.numbers))):
        return number
    vertices = tuple(build.constant(ctx.tree, INT, vertex) for vertex in corners.numbers)
    whole = ctx.tree.node("array", Array(INT, len(vertices)), vertices)
    return build.index(ctx.tree, whole, number)

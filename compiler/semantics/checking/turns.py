"""The trip count of a loop: its number of iterations.

That may be known at run time only. The largest possible number is known when compiling: from the
ranges of the values that its bounds are computed from, or because it is written there. ``loops``
asks for this before a loop's body is checked.
"""

from __future__ import annotations

from collections.abc import Sequence

from ....support.frozen import frozen
from ...diagnostics import rules
from ...diagnostics.source import Span
from ...ir import build
from ...ir.node import Formal, Node
from ...ir.types import INT
from ...syntax import ast
from ..declarations.fitting import fit
from ..state.context import Context
from ..state.scope import FAILURE, Failure

LONGEST = 4096
"""Turns of a loop, at most."""


@frozen
class Turns:
    """The trip count of a loop."""

    count: Node
    bound: int
    formal: Formal
    index: Node
    """The value of the loop's variable: the start of its range and the turn's number together."""

    @property
    def known(self) -> bool:
        """True if the loop always has ``bound`` iterations."""
        return self.count.op == "constant"


def bounds_of(turns: ast.Turns) -> tuple[ast.Expression, ...]:
    """The expressions in the bounds of a loop, in the order in which they are evaluated."""
    ends = (turns.start, turns.end)
    return ends if turns.most is None else (*ends, turns.most)


def turns_of(
    ctx: Context, written: ast.Turns, values: Sequence[Node], span: Span
) -> Turns | Failure:
    """The trip count of a loop, by the values of its ``bounds_of``."""
    bounds = [
        fit(ctx, value, INT, "int", bound.span)
        for value, bound in zip(values, bounds_of(written), strict=True)
    ]
    first, end = bounds[:2]
    most: int | None = LONGEST
    if written.most is not None:
        limit = bounds[2]
        if isinstance(limit, Node) and ctx.is_left_to_a_use(limit):
            most = 1
        else:
            most = ctx.constants.integer(limit, written.most.span)
    if isinstance(first, Failure) or isinstance(end, Failure) or most is None:
        return FAILURE
    found = _count(ctx, first, end, most, written, span)
    if found is None:
        return FAILURE
    count, bound = found
    formal = Formal(written.variable.text or "turn")
    ctx.ranges.note_index(formal, bound)
    turn = ctx.tree.node("formal", INT, (), formal)
    index = turn
    if ctx.constants.known_integer(first) == 0:
        ctx.ends[formal] = end
    else:
        index = ctx.tree.node("call", INT, (turn, first), "add")
    return Turns(count, bound, formal, index)


def _count(
    ctx: Context, first: Node, end: Node, most: int, written: ast.Turns, span: Span
) -> tuple[Node, int] | None:
    """The trip count of a loop, and its largest value; reported where nothing says that."""
    ctx.progress.unproven += bool(first.variables or end.variables)
    known = [ctx.constants.known_integer(node) for node in (first, end)]
    if known[0] is not None and known[1] is not None:
        turns = max(known[1] - known[0], 0)
        turns = turns if written.most is None else max(min(turns, most), 0)
        found = min(turns, LONGEST)
        count = build.constant(ctx.tree, INT, found)
        if turns > LONGEST:
            error = ctx.report.finding(rules.FOLD_TOO_LONG, span, count=turns, most=LONGEST)
            ctx.deferred.add(count, error, first, end)
        return count, found
    if written.most is not None and most > LONGEST:
        ctx.report.add(rules.FOLD_TOO_LONG, written.most.span, count=most, most=LONGEST)
        return None
    facts = ctx.ranges.of(first), ctx.ranges.of(end)
    bound = min(facts[1].hi - facts[0].lo, most if written.most is not None else float("inf"))
    if bound > LONGEST and (ctx.is_left_to_a_use(first) or ctx.is_left_to_a_use(end)):
        bound = 1
    if bound > LONGEST:
        way = "write `up to 16` behind the bounds"
        if not written.variable.text:
            way = "write `for i in 0..n up to 16`"
        hint = f"give the parameter a range, `in 0..16`, or {way}"
        ctx.report.add(rules.UNBOUNDED_LOOP, written.end.span, hint=hint)
        return None
    count = end
    if known[0] != 0:
        count = ctx.tree.node("call", INT, (end, first), "sub")
    return count, max(int(bound), 0)

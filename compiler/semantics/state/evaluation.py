"""Evaluates expressions by the rules that the context holds, without recursion over the program.

Expressions nest as deeply as a text is long, so a loop with a list of what is left to do evaluates
the operands of an expression before it runs its rule. Equations chain without limit, too: the value
of one needs that of the next. Such a value is a ``Demand``. While few of them wait for each other,
the rule that needs one waits for it on Python's stack. Beyond that ``settle`` raises ``Unsettled``:
the loop puts the demand in front of what is left to do, and afterwards runs the rule once more,
which then finds the value. So a rule may run several times: it gets the nodes once more that it
made before, and must leave nothing behind that a second run would stumble over.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import TypeAlias

from ....support.frozen import EMPTY, frozen
from ...diagnostics import rules
from ...diagnostics.source import Span
from ...ir.node import Node
from ...syntax import ast
from ..types.typenames import Declared
from .context import Context, OpenRule, Rule
from .scope import FAILURE, Continuation, Failure, Members, Scope, Undecided, Value

DEEPEST = 16
"""The number of demands that may wait for each other on Python's stack.

Each takes about ten frames.
"""


@frozen
class Demand:
    """A value that is computed once and then kept: a slot's, a constant's, that of a call."""

    key: Hashable
    """To meet the same key again while the value is computed is a cycle."""
    name: str
    """The name of the value in messages about a cycle."""
    span: Span
    """The span that asks for it."""
    expression: ast.Expression
    scope: Scope
    finish: Callable[[Value], None]
    """Keeps the value where it belongs; whoever asked looks there.

    This is ``ctx.applied`` or an instance's ``values``, for example.
    """


class Unsettled(Exception):  # noqa: N818
    """A rule needs a value that has to be computed first, by the loop that runs the rule."""

    def __init__(self, demand: Demand) -> None:
        self.demand = demand
        super().__init__(demand.name)


@frozen
class _EndDemand:
    """A demand, to be finished with the value that its expression will have."""

    demand: Demand


@frozen
class _Continued:
    """An expression whose further parts have been evaluated, and where their values start."""

    written: ast.Expression
    further: Continuation
    start: int


_Work: TypeAlias = "tuple[ast.Expression, Scope, int] | _EndDemand | _Continued | _Retry"
"""A task that is left to do.

An expression comes with the place of its first operand's value, or with ``_NEW`` as long as its
operands have not been evaluated.
"""
_NEW = -1


@frozen
class _Retry:
    """Work that was left for a demand, and the nodes that were made until then."""

    work: _Work
    made: Mapping[Hashable, Node]


def evaluate(ctx: Context, expression: ast.Expression, scope: Scope) -> Value:
    """The value of an expression; nodes are noted to stand where the expression does."""
    return _run(ctx, [(expression, scope, _NEW)])


def node_of(
    ctx: Context, expression: ast.Expression, scope: Scope, wanted: Declared | None = None
) -> Node | Failure:
    """The value of an expression where only a plain value will do."""
    return plain(ctx, evaluate(ctx, expression, scope), expression, wanted)


def plain(
    ctx: Context, value: Value, expression: ast.Expression, wanted: Declared | None = None
) -> Node | Failure:
    """An expression's value if it is a plain one; a record or ``light`` is reported.

    ``wanted`` is the type that is written where the value is for, if one is.
    """
    if isinstance(value, Undecided) and wanted is not None:
        value = value.decided(wanted)
    if isinstance(value, Node | Failure):
        return value
    if isinstance(value, Undecided):
        value.report()
        return FAILURE
    hint = value.example if isinstance(value, Members) else ""
    ctx.report.add(rules.NOT_A_VALUE, expression.span, hint=hint)
    return FAILURE


def _value(
    ctx: Context,
    rule: Rule | OpenRule,
    written: ast.Expression,
    operands: Sequence[Value],
    scope: Scope,
) -> Value | Continuation:
    """The value of an expression, given those of its operands."""
    if isinstance(rule, OpenRule):
        return rule.value(ctx, written, operands, scope)
    nodes = _nodes(operands)
    if nodes is None:
        return _wrong(ctx, operands, rule.operands(written, scope))
    return rule.value(ctx, written, nodes, scope)


def _value_after(
    ctx: Context, further: Continuation, values: Sequence[Value]
) -> Value | Continuation:
    """The value of a loop or a choice, given those of its further parts."""
    nodes = _nodes(values)
    return _wrong(ctx, values, further.expressions) if nodes is None else further.then(nodes)


def _nodes(values: Sequence[Value]) -> list[Node] | None:
    """The values as nodes, if all of them are."""
    nodes = [value for value in values if isinstance(value, Node)]
    return nodes if len(nodes) == len(values) else None


def _wrong(ctx: Context, values: Sequence[Value], written: Sequence[ast.Expression]) -> Failure:
    """The value of an expression with a wrong operand, about which nothing else is said."""
    for value, expression in zip(values, written, strict=True):
        plain(ctx, value, expression)
    return FAILURE


def settle(ctx: Context, demand: Demand) -> None:
    """Compute a demand's value and have it kept."""
    progress = ctx.progress
    if progress.depth >= DEEPEST:
        raise Unsettled(demand)
    progress.depth += 1
    again, ctx.tree.again = ctx.tree.again, EMPTY
    try:
        _run(ctx, _begun(ctx, demand))
    finally:
        progress.depth -= 1
        ctx.tree.again = again


def _begun(ctx: Context, demand: Demand) -> list[_Work]:
    ctx.progress.active[demand.key] = (demand.name, demand.span)
    return [_EndDemand(demand), (demand.expression, demand.scope, _NEW)]


def _run(ctx: Context, work: list[_Work]) -> Value:
    """Do all work; the value is that of the last expression."""
    table, note, tree = ctx.rules, ctx.places.note, ctx.tree
    values: list[Value] = []
    while True:
        top, first = work.pop(), len(tree)
        try:
            if isinstance(top, tuple):
                written, scope, start = top
                rule = table[type(written)]
                if start == _NEW:
                    start = len(values)
                    operands = rule.operands(written, scope)
                    if operands:
                        work.append((written, scope, start))
                        work += [(operand, scope, _NEW) for operand in reversed(operands)]
                        continue
                found = _value(ctx, rule, written, values[start:], scope)
            elif isinstance(top, _Continued):
                written, start = top.written, top.start
                found = _value_after(ctx, top.further, values[start:])
            elif isinstance(top, _Retry):
                tree.again = top.made
                work.append(top.work)
                continue
            else:
                top.demand.finish(values[-1])
                del ctx.progress.active[top.demand.key]
                if not work:
                    return values[-1]
                values.pop()
                continue
        except Unsettled as unsettled:
            work.append(_Retry(top, {**tree.again, **tree.made_since(first)}))
            work += _begun(ctx, unsettled.demand)
            tree.again = EMPTY
            continue
        tree.again = EMPTY
        del values[start:]
        if isinstance(found, Continuation):
            work.append(_Continued(written, found, start))
            work += [(e, found.scope, _NEW) for e in reversed(found.expressions)]
            continue
        values.append(found)
        if isinstance(found, Node):
            note(found, written.span)
        if not work:
            return found

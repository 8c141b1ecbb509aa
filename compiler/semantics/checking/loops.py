"""Bounded loops: folds over a range of numbers, and states taken from turn to turn.

``turns`` says how often a loop turns.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from ....support.frozen import frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.fixes import Hint, fix_it
from ...ir import build
from ...ir.binding import Moved, close, substitute
from ...ir.node import (
    Folding,
    FoldOperator,
    Formal,
    Graph,
    Iterating,
    Node,
)
from ...ir.types import BOOL, INT, Opaque, Scalar, TextureType, Type, Vector, width
from ...syntax import ast
from ...syntax.quoting import spanned
from ..declarations import enumerations
from ..declarations.fitting import fit
from ..state.context import Context
from ..state.scope import FAILURE, Continuation, Failure, Scope, Value
from ..types.coercion import coerce
from ..types.meaning_rules import is_enum
from .loop_contents import changing, loops_within, may_stand, too_deep
from .turns import Turns, bounds_of, turns_of

LARGEST_STATE = 64
"""Numbers, vectors and matrices in the state of a loop."""
OPERATORS: Mapping[ast.FoldWord, FoldOperator] = {
    "sum": "add", "product": "mul", "min": "min", "max": "max", "all": "and", "any": "or",
}  # fmt: skip
"""Folds of numbers; ``each`` is none."""


def folded(
    graph: Graph,
    operator: FoldOperator,
    bound: int,
    body: Node,
    formal: Formal,
    moved: Moved,
    count: Node | None = None,
    start: Node | None = None,
) -> Node:
    """``body`` over ``0 <= formal < count`` taken together; ``bound`` is the most turns."""
    turns = count or build.constant(graph, INT, bound)
    begin = start or _of_nothing(graph, operator, body.type)
    closed = close(graph, body, (formal,), moved)
    return graph.node("fold", body.type, (turns, begin, closed), Folding(operator, bound))


def _of_nothing(graph: Graph, operator: FoldOperator, type_: Type) -> Node:
    assert isinstance(type_, Scalar | Vector)
    lane = build.constant(graph, Scalar(type_.kind), build.neutral(operator, type_.kind))
    return build.splat(graph, lane, width(type_))


# --- folds ---------------------------------------------------------------------------------------


def bounds_of_fold(e: ast.Fold, _scope: Scope) -> tuple[ast.Expression, ...]:
    """The operands of a fold, which are evaluated outside of the loop."""
    return bounds_of(e.turns) if e.initial is None else (*bounds_of(e.turns), e.initial)


def fold(ctx: Context, e: ast.Fold, operands: Sequence[Node], scope: Scope) -> Value | Continuation:
    """``sum i in a..b from x : e`` and its like."""
    if e.operator not in OPERATORS:
        ctx.report.add(rules.FRAMES_ONLY, e.span, what=f"`{e.operator}`")
        return FAILURE
    if too_deep(ctx, e, scope.loops):
        return FAILURE
    outside = list(operands)
    initial = None if e.initial is None else outside.pop()
    turns = turns_of(ctx, e.turns, outside, e.span)
    if isinstance(turns, Failure):
        return FAILURE
    inner = scope.inside_loop({e.turns.variable.text: turns.index})
    return Continuation((e.body,), inner, partial(_folded, ctx, e, turns, initial))


def no_operands(_e: ast.FoldOver, _scope: Scope) -> tuple[ast.Expression, ...]:
    """The operands of a fold over no range: none."""
    return ()


def fold_over(ctx: Context, e: ast.FoldOver, _operands: Sequence[Node], _scope: Scope) -> Failure:
    """``sum lamp in rig : e`` has a meaning in frames only."""
    ctx.report.add(
        rules.FRAMES_ONLY, e.span, what=f"`{e.operator} … in` something that is no range",
        hint=_counted(e) if e.operator in OPERATORS else "",
    )  # fmt: skip
    return FAILURE


def _counted(e: ast.FoldOver) -> Hint:
    """The hint how to write a fold over something else as one over a range."""
    over = e.over
    if isinstance(over, ast.Reference):
        return "a fold counts numbers, `sum i in a..b : e`; a `term … per light` sums over lights"
    if isinstance(over, ast.Call) and len(over.arguments) == 1:  # `range(4)`, as elsewhere
        over = over.arguments[0]
    written = f"0..{over.span.text}"
    said = f"a fold goes over a range: `{e.operator} {e.variable.text} in 0..{spanned(over.span)}`"
    return fix_it(said, (e.over.span, written))


def _folded(
    ctx: Context, e: ast.Fold, turns: Turns, initial: Node | None, values: Sequence[Node]
) -> Value:
    """The fold over a body whose value is known."""
    if too_deep(ctx, e, loops_within(values, {turns.formal})):
        return FAILURE
    operator = OPERATORS[e.operator]
    body = _term(ctx, e, operator, values[0])
    if isinstance(body, Failure):
        return FAILURE
    if initial is not None:
        assert e.initial is not None
        fitted: Node | Failure | None = coerce(ctx.tree, initial, body.type)
        if fitted is None and (adapted := coerce(ctx.tree, body, initial.type)) is not None:
            body, fitted = adapted, initial
        fitted = fitted or fit(ctx, initial, body.type, str(body.type), e.initial.span)
        if isinstance(fitted, Failure):
            return FAILURE
        initial = fitted
    if not may_stand(ctx, turns, (body,), {turns.formal}, e.span, waits=False):
        return FAILURE
    result = _combined(ctx, e, operator, turns, body, initial)
    if isinstance(result, Node):
        ctx.deferred.unread(result, (turns.count,))
    return result


def _term(ctx: Context, e: ast.Fold, operator: FoldOperator, body: Node) -> Node | Failure:
    """A term as one that the fold can take."""
    if operator in ("and", "or"):
        return fit(ctx, body, BOOL, "bool", e.body.span)
    is_number = isinstance(body.type, Scalar | Vector) and body.type.kind != "bool"
    if not is_number or is_enum(ctx.meanings.of(body)):
        shown = enumerations.shown_type(ctx, body)
        ctx.report.add(rules.WRONG_TYPE, e.body.span, expected="a number", found=shown)
        return FAILURE
    return body


def _combined(
    ctx: Context,
    e: ast.Fold,
    operator: FoldOperator,
    turns: Turns,
    body: Node,
    initial: Node | None,
) -> Node | Failure:
    if initial is None and operator in ("min", "max"):
        if not turns.known:
            ctx.report.add(rules.NO_INITIAL, e.span, word=e.operator)
            return FAILURE
        if turns.bound == 0:
            return _of_no_terms(ctx, e, operator, turns, body)
    if any(node.op == "cross" for node in changing((body,), {turns.formal})):
        return _written_out(ctx, operator, turns, body, initial)
    result = folded(
        ctx.tree, operator, turns.bound, body, turns.formal, ctx.follow, turns.count, initial
    )
    ctx.notes.variables.setdefault(result.id, (e.turns.variable.text,))
    return result


def _of_no_terms(
    ctx: Context, e: ast.Fold, operator: FoldOperator, turns: Turns, body: Node
) -> Node:
    """``min`` or ``max`` of no terms and no initial value: an error, if a program comes to it.

    A term stands in for the value, so that expressions that need it can be checked.
    """
    term = _at(ctx, body, turns.formal, 0)
    value = ctx.tree.node("call", body.type, (term, term), operator)
    found = ctx.report.finding(rules.NO_INITIAL, e.span, word=e.operator)
    ctx.deferred.add(value, found, turns.count)
    return value


def _written_out(
    ctx: Context, operator: FoldOperator, turns: Turns, body: Node, initial: Node | None
) -> Node:
    """A fold without a loop: the terms of all turns, joined by the operator."""
    terms = [_at(ctx, body, turns.formal, turn) for turn in range(turns.bound)]
    if initial is not None or not terms:
        terms.insert(0, initial or _of_nothing(ctx.tree, operator, body.type))
    total = terms[0]
    for term in terms[1:]:
        total = ctx.tree.node("call", body.type, (total, term), operator)
    return total


def _at(ctx: Context, body: Node, formal: Formal, turn: int) -> Node:
    number = build.constant(ctx.tree, INT, turn)
    return substitute(ctx.tree, body, {formal: number}, ctx.follow)


# --- states --------------------------------------------------------------------------------------


def bounds_of_iterate(e: ast.Iterate, _scope: Scope) -> tuple[ast.Expression, ...]:
    """The operands of an ``iterate``, which are evaluated outside of the loop."""
    return (e.initial, *bounds_of(e.turns))


@frozen
class _States:
    """The states of a loop: their whole, and each as a variable with its initial value."""

    initial: Node
    starts: tuple[Node, ...]
    formals: tuple[Formal, ...]
    variables: tuple[Node, ...]


def iterate(
    ctx: Context, e: ast.Iterate, operands: Sequence[Node], scope: Scope
) -> Value | Continuation:
    """``iterate x from e up to n while c : next``: a structure is several states."""
    if too_deep(ctx, e, scope.loops):
        return FAILURE
    initial, *bounds = operands
    turns = turns_of(ctx, e.turns, bounds, e.span)
    if isinstance(turns, Failure):
        return FAILURE
    states = _states(ctx, e, initial)
    if isinstance(states, Failure):
        return FAILURE
    whole = build.assembled(ctx.tree, initial.type, iter(states.variables))
    inner = scope.inside_loop({e.turns.variable.text: turns.index, e.state.text: whole})
    written = (e.body,) if e.condition is None else (e.condition, e.body)
    return Continuation(written, inner, partial(_iterated, ctx, e, turns, states))


def _states(ctx: Context, e: ast.Iterate, initial: Node) -> _States | Failure:
    """Variables for the states that a loop begins with."""
    if isinstance(initial.type, Opaque):
        what = "texture" if isinstance(initial.type, TextureType) else "buffer"
        ctx.report.add(
            rules.WRONG_TYPE, e.initial.span, expected="a value", found=initial.type,
            hint=f"a {what} cannot change from one iteration to the next",
        )  # fmt: skip
        return FAILURE
    starts = tuple(build.flattened(ctx.tree, initial))
    if len(starts) > LARGEST_STATE:
        ctx.report.add(rules.STATE_TOO_LARGE, e.initial.span, count=len(starts), most=LARGEST_STATE)
        return FAILURE
    names = tuple(name for name, _ in build.named_parts(e.state.text, initial.type))
    formals = tuple(map(Formal, names))
    variables = tuple(
        _as_member(ctx, ctx.tree.node("formal", start.type, (), formal), start)
        for start, formal in zip(starts, formals, strict=True)
    )
    return _States(initial, starts, formals, variables)


def _as_member(ctx: Context, value: Node, start: Node) -> Node:
    """A state's value: a member of an enumeration, if the state begins with one.

    Other meanings are lost, since a step may change what a number means.
    """
    meaning = ctx.meanings.of(start)
    return ctx.meanings.ascribed(value, meaning) if is_enum(meaning) else value


def _iterated(
    ctx: Context, e: ast.Iterate, turns: Turns, states: _States, values: Sequence[Node]
) -> Value:
    """The last state of a loop of which condition and body are known."""
    formals = {turns.formal, *states.formals}
    if too_deep(ctx, e, loops_within(values, formals)):
        return FAILURE
    going: Node | Failure = build.constant(ctx.tree, BOOL, True)
    if e.condition is not None:
        going = fit(ctx, values[0], BOOL, "bool", e.condition.span)
    body = _following(ctx, e, values[-1], states.initial)
    if isinstance(going, Failure) or isinstance(body, Failure):
        return FAILURE
    nexts = tuple(build.flattened(ctx.tree, body))
    waits = e.condition is not None
    if not may_stand(ctx, turns, (going, *nexts), formals, e.span, waits=waits, states=True):
        return FAILURE
    rows = list(zip(states.formals, states.variables, states.starts, nexts, strict=True))
    last = zip(_looped(ctx, turns, rows, going), states.starts, strict=True)
    ends = (_as_member(ctx, value, start) for value, start in last)
    return build.assembled(ctx.tree, states.initial.type, ends)


def _following(ctx: Context, e: ast.Iterate, body: Node, initial: Node) -> Node | Failure:
    """The value of the state after an iteration, of the state's type."""
    fitted = coerce(ctx.tree, body, initial.type)
    meanings = [ctx.meanings.of(each) for each in (initial, body)]
    is_member = any(map(is_enum, meanings))
    if fitted is None or (is_member and meanings[0] != meanings[1]):
        before, after = (enumerations.shown_type(ctx, each) for each in (initial, body))
        ctx.report.add(
            rules.STATE_CHANGES, e.body.span, name=e.state.text, before=before, after=after,
            labels=[Label(e.initial.span, f"this is `{before}`")],
        )  # fmt: skip
        return FAILURE
    return fitted


def _looped(
    ctx: Context,
    turns: Turns,
    states: list[tuple[Formal, Node, Node, Node]],
    going: Node,
) -> list[Node]:
    """The last states of a loop; a state that no iteration changes is no part of it."""
    graph, moved = ctx.tree, ctx.follow
    fixed = {f: start for f, variable, start, following in states if following is variable}
    kept = [state for state in states if state[0] not in fixed]
    if not kept:
        return [start for _, _, start, _ in states]
    formals = (turns.formal, *(formal for formal, *_ in kept))

    def closed(body: Node) -> Node:
        return close(graph, substitute(graph, body, fixed, moved), formals, moved)

    loop = build.iterate(
        graph,
        Iterating(turns.bound, len(kept)),
        turns.count,
        tuple(start for _, _, start, _ in kept),
        closed(going),
        tuple(closed(following) for _, _, _, following in kept),
    )
    ctx.notes.variables.setdefault(loop.id, tuple(formal.name for formal in formals))
    last = {formal: build.state(graph, loop, k) for k, (formal, *_) in enumerate(kept)}
    return [fixed.get(formal) or last[formal] for formal, *_ in states]

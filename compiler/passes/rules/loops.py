"""Simplification rules for loops that never run, change nothing, or are better unrolled."""

from __future__ import annotations

from collections.abc import Iterable

from ...ir import build
from ...ir.node import Folding, Formal, Iterating, Node
from ...ir.operations import FORMAL, LOOPS, joins_group, with_role
from ...ir.types import INT, Type, scalar_kind
from ...reference.evaluate import evaluate
from ..cost import cost, cost_of
from .builder import Builder, uniform_lane
from .constants import constant_of
from .rule import Rule
from .terms import Several, Variable, computed, condition
from .vocabulary import c, d, fold, iterate, loop

UNROLLED = 2
"""The number of iterations up to which loops are unrolled.

They may not come to more operations than ``LARGEST_UNROLLED``.
"""
LARGEST_UNROLLED = 1024
"""The largest number of operations of an unrolled loop.

Loops in loops double with each level that is unrolled, so this has to end somewhere: the levels
further out stay loops.
"""
MOST_UNROLLED = 4
"""Loops of up to so many turns are written out if they come to no more than ``UNROLLED_COST``."""
UNROLLED_COST = 12
LONGEST_FIXED = 4096
"""Loops of constants are computed when compiling if they come to no more operations."""

_COMPUTED = with_role("constant", "join", "part", "choice") | {"call"}
"""The operations that the reference computes for constants."""


def _turns(count: Node, loop: Folding | Iterating) -> int | None:
    """The trip count of a loop, where it is known; no count may be above the loop's bound."""
    if loop.bound == 0:
        return 0
    if count.op != "constant" or not isinstance(count.data, int):
        return None
    return max(min(count.data, loop.bound), 0)


@condition("{} or the bound of {} is 0")
def _never_turns(_builder: Builder, _type: Type, count: Node, loop: Folding | Iterating) -> bool:
    return _turns(count, loop) == 0


def _is_closed(count: Node, loop: Folding | Iterating, parts: Iterable[Node]) -> bool:
    """True if a loop computes with constants and its own variables, and not for too long."""
    turns, variables = _turns(count, loop), loop.variables
    if turns is None or count.op != "constant":
        return False
    seen: set[int] = set()
    pending = list(parts)
    while pending:
        node = pending.pop()
        if node.id in seen:
            continue
        seen.add(node.id)
        own = node.op == "formal" and FORMAL.data(node) in variables
        computed = node.op in _COMPUTED and not joins_group(node)
        if not (own or computed) or len(seen) * turns > LONGEST_FIXED:
            return False
        pending += node.operands
    return True


# --- folds ---------------------------------------------------------------------------------------


@condition("{} is neutral in {}")
def _is_neutral(_builder: Builder, _type: Type, term: Node, loop: Folding) -> bool:
    return _is_neutral_for(loop, term)


def _is_neutral_for(loop: Folding, operand: Node) -> bool:
    kind = scalar_kind(operand.type)
    assert kind is not None
    return uniform_lane(operand) == build.neutral(loop.operator, kind)


@condition("{} is small, and of variables only that of {} is in {}")
def _fold_is_closed(_builder: Builder, _type: Type, count: Node, loop: Folding, term: Node) -> bool:
    return _is_closed(count, loop, (term,))


@computed
def _folded(
    builder: Builder, type_: Type, count: Node, start: Node, term: Node, loop: Folding
) -> Node:
    """The constant result of a fold."""
    folded = builder.graph.node("fold", type_, (count, start, term), loop)
    return constant_of(builder, type_, evaluate(folded))


@condition("{} is very small, or small in {}, with few operations in {}")
def _fold_is_short(_builder: Builder, _type: Type, count: Node, loop: Folding, term: Node) -> bool:
    return _is_short(_turns(count, loop), (term,), frozenset(loop.variables))


@computed
def _written_out(
    builder: Builder, type_: Type, count: Node, start: Node, term: Node, loop: Folding
) -> Node:
    """The terms of all turns, one after the other."""
    (variable,) = loop.variables
    result, is_first = start, _is_neutral_for(loop, start)
    for i in range(_turns(count, loop) or 0):
        here = builder.substituted(term, {variable: build.constant(builder.graph, INT, i)})
        result = here if is_first else builder.call(loop.operator, type_, result, here)
        is_first = False
    return result


# --- loops over states ---------------------------------------------------------------------------

Parts = tuple[Node, ...]
"""The parts of a loop over states: initial states, loop condition, and next states."""


def _starts(loop: Iterating, parts: Parts) -> Parts:
    return parts[: loop.states]


def _going(loop: Iterating, parts: Parts) -> Node:
    return parts[loop.states]


def _nexts(loop: Iterating, parts: Parts) -> Parts:
    return parts[loop.states + 1 :]


def _states(builder: Builder, type_: Type, states: Parts) -> Node:
    return states[0] if len(states) == 1 else builder.graph.node("struct", type_, states)


@computed
def _start(builder: Builder, type_: Type, parts: Parts, loop: Iterating) -> Node:
    """The states that a loop starts with."""
    return _states(builder, type_, _starts(loop, parts))


@condition("among {}, {} has a condition that never holds")
def _stops_at_once(_builder: Builder, _type: Type, parts: Parts, loop: Iterating) -> bool:
    return uniform_lane(_going(loop, parts)) is False


@condition("among {}, {} has one state, which stays as it is")
def _changes_nothing(_builder: Builder, _type: Type, parts: Parts, loop: Iterating) -> bool:
    (_turn, *states), nexts = loop.variables, _nexts(loop, parts)
    return len(states) == 1 and nexts[0].data is states[0]


@condition("{} is small, and of variables only those of {} are in {}")
def _loop_is_closed(
    _builder: Builder, _type: Type, count: Node, loop: Iterating, parts: Parts
) -> bool:
    return _is_closed(count, loop, parts)


@computed
def _last(builder: Builder, type_: Type, count: Node, parts: Parts, loop: Iterating) -> Node:
    """The states that a loop of constants comes to."""
    node = builder.graph.node("iterate", type_, (count, *parts), loop)
    values, starts = evaluate(node), _starts(loop, parts)
    if len(starts) == 1:
        return constant_of(builder, type_, values)
    pairs = zip(starts, values, strict=True)
    states = tuple(constant_of(builder, start.type, value) for start, value in pairs)
    return _states(builder, type_, states)


@condition("{} is very small, or small in {}, with few operations and no early end in {}")
def _loop_is_short(
    _builder: Builder, _type: Type, count: Node, loop: Iterating, parts: Parts
) -> bool:
    never_stops = uniform_lane(_going(loop, parts)) is True
    formals = frozenset(loop.variables)
    return never_stops and _is_short(_turns(count, loop), _nexts(loop, parts), formals)


@computed
def _turned(builder: Builder, type_: Type, count: Node, parts: Parts, loop: Iterating) -> Node:
    """The states after all turns, one after the other."""
    states = _starts(loop, parts)
    for i in range(_turns(count, loop) or 0):
        given = (build.constant(builder.graph, INT, i), *states)
        here = dict(zip(loop.variables, given, strict=True))
        states = tuple(builder.substituted(each, here) for each in _nexts(loop, parts))
    return _states(builder, type_, states)


def _is_short(turns: int | None, bodies: Iterable[Node], formals: frozenset[Formal]) -> bool:
    """True if a loop is so short, in iterations or in operations, that it is better unrolled.

    A loop in it is not copied. Only operations that change from iteration to iteration count, and
    the search ends as soon as there are too many.
    """
    if turns is None or turns > MOST_UNROLLED:
        return False
    most = UNROLLED_COST if turns > UNROLLED else LARGEST_UNROLLED
    spent, seen = 0, set()
    pending = list(bodies)
    while pending:
        node = pending.pop()
        if node.id in seen or node.variables.isdisjoint(formals):
            continue
        seen.add(node.id)
        if node.op in LOOPS:
            return False
        spent += (cost(node, UNROLLED_COST) if node.op == "apply" else cost_of(node)) * turns
        if turns > 1 and spent > most:
            return False
        pending += node.operands
    return True


_COUNT, _START, _TERM = Variable("n"), Variable("start"), Variable("term")
_PARTS = Several("parts")

LOOP_RULES = (
    Rule("fold of nothing", fold[loop](_COUNT, _START, _TERM), _START,
         "A fold that never turns is what it starts with.", where=_never_turns(_COUNT, loop)),
    Rule("fold of neutral terms", fold[loop](_COUNT, _START, _TERM), _START,
         "Terms that change nothing leave what a fold starts with.",
         where=_is_neutral(_TERM, loop)),
    Rule("fold of constants", fold[loop](c, d, _TERM), _folded(c, d, _TERM, loop),
         "A fold of constants is computed when compiling, if it is short.",
         where=_fold_is_closed(c, loop, _TERM)),
    Rule("fold written out", fold[loop](_COUNT, _START, _TERM),
         _written_out(_COUNT, _START, _TERM, loop),
         "A fold of few turns, or of few operations, is written out.",
         where=_fold_is_short(_COUNT, loop, _TERM)),
    Rule("loop of no turns", iterate[loop](_COUNT, _PARTS), _start(_PARTS, loop),
         "A loop that never turns leaves its states as they are.",
         where=_never_turns(_COUNT, loop)),
    Rule("loop that stops at once", iterate[loop](_COUNT, _PARTS), _start(_PARTS, loop),
         "A loop that does not go on leaves its states as they are.",
         where=_stops_at_once(_PARTS, loop)),
    Rule("loop that changes nothing", iterate[loop](_COUNT, _PARTS), _start(_PARTS, loop),
         "A state that stays as it is, is what it starts with.",
         where=_changes_nothing(_PARTS, loop)),
    Rule("loop of constants", iterate[loop](_COUNT, _PARTS), _last(_COUNT, _PARTS, loop),
         "A loop of constants is computed when compiling, if it is short.",
         where=_loop_is_closed(_COUNT, loop, _PARTS)),
    Rule("loop written out", iterate[loop](_COUNT, _PARTS), _turned(_COUNT, _PARTS, loop),
         "A loop of few turns, or of few operations, that never stops early is written out.",
         where=_loop_is_short(_COUNT, loop, _PARTS)),
)  # fmt: skip

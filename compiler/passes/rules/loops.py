"""Simplification rules for loops that never run, change nothing, or are better unrolled."""

from __future__ import annotations

from collections.abc import Iterable

from ...ir import build
from ...ir.node import Folding, Formal, Iterating, Node
from ...ir.operations import FORMAL, LOOPS, joins_group, with_role
from ...ir.types import INT, scalar_kind
from ...reference.evaluate import evaluate
from ..cost import cost, cost_of
from .constants import constant_of
from .rule import ANY, CONSTANT, Builder, Rule, Site, uniform_lane

UNROLLED = 2
"""Loops of at most so many turns are written out, if they come to no more operations than
``LARGEST_UNROLLED``."""
LARGEST_UNROLLED = 1024
"""Loops in loops double with each level that is written out, so this has to end somewhere: the
levels further out stay loops."""
MOST_UNROLLED = 4
"""Loops of up to so many turns are written out if they come to no more than ``UNROLLED_COST``."""
UNROLLED_COST = 12
LONGEST_FIXED = 4096
"""Loops of constants are computed when compiling if they come to no more operations."""

_COMPUTED = with_role("constant", "join", "part", "choice") | {"call"}
"""What the reference computes for constants."""


def _folding(at: Site) -> Folding:
    assert isinstance(at.data, Folding)
    return at.data


def _iterating(at: Site) -> Iterating:
    assert isinstance(at.data, Iterating)
    return at.data


def _turns(at: Site) -> int | None:
    """How often a loop turns, where that is known; no count may be above its bound."""
    assert isinstance(at.data, Folding | Iterating)
    count, bound = at.operands[0], at.data.bound
    if bound == 0:
        return 0
    if count.op != "constant" or not isinstance(count.data, int):
        return None
    return max(min(count.data, bound), 0)


def _never_turns(_b: Builder, at: Site) -> bool:
    return _turns(at) == 0


# --- folds ---------------------------------------------------------------------------------------


def _adds_nothing(_b: Builder, at: Site) -> bool:
    return _is_neutral(at, at.operands[2])


def _is_neutral(at: Site, operand: Node) -> bool:
    kind = scalar_kind(at.type)
    assert kind is not None
    return uniform_lane(operand) == build.neutral(_folding(at).operator, kind)


def _is_fixed(_b: Builder, at: Site) -> bool:
    """Whether a loop computes with constants and its own variables, and not for too long."""
    assert isinstance(at.data, Folding | Iterating)
    turns, variables = _turns(at), at.data.variables
    if turns is None or at.operands[0].op != "constant":
        return False
    seen: set[int] = set()
    pending = list(at.operands[1:])
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


def _evaluated(b: Builder, at: Site) -> Node:
    loop = b.graph.node("fold", at.type, at.operands, at.data)
    return constant_of(b, at.type, evaluate(loop))


def _fold_is_short(_b: Builder, at: Site) -> bool:
    return _is_short(_turns(at), at.operands[2:], frozenset(_folding(at).variables))


def _fold_unrolled(b: Builder, at: Site) -> Node:
    (index,) = _folding(at).variables
    _count, result, body = at.operands
    is_first = _is_neutral(at, result)
    for i in range(_turns(at) or 0):
        term = b.substituted(body, {index: build.constant(b.graph, INT, i)})
        result = term if is_first else b.call(_folding(at).operator, at.type, result, term)
        is_first = False
    return result


# --- loops over states ---------------------------------------------------------------------------


def _starts(at: Site) -> tuple[Node, ...]:
    return at.operands[1 : 1 + _iterating(at).states]


def _going(at: Site) -> Node:
    return at.operands[1 + _iterating(at).states]


def _nexts(at: Site) -> tuple[Node, ...]:
    return at.operands[2 + _iterating(at).states :]


def _unchanged(b: Builder, at: Site) -> Node:
    return _states(b, at, _starts(at))


def _states(b: Builder, at: Site, states: tuple[Node, ...]) -> Node:
    return states[0] if len(states) == 1 else b.graph.node("struct", at.type, states)


def _evaluated_states(b: Builder, at: Site) -> Node:
    loop = b.graph.node("iterate", at.type, at.operands, at.data)
    values, starts = evaluate(loop), _starts(at)
    if len(starts) == 1:
        return constant_of(b, at.type, values)
    pairs = zip(starts, values, strict=True)
    return _states(b, at, tuple(constant_of(b, start.type, value) for start, value in pairs))


def _stops_at_once(_b: Builder, at: Site) -> bool:
    return uniform_lane(_going(at)) is False


def _changes_nothing(_b: Builder, at: Site) -> bool:
    (_turn, *states), nexts = _iterating(at).variables, _nexts(at)
    return len(states) == 1 and nexts[0].data is states[0]


def _loop_is_short(_b: Builder, at: Site) -> bool:
    never_stops = uniform_lane(_going(at)) is True
    return never_stops and _is_short(_turns(at), _nexts(at), frozenset(_iterating(at).variables))


def _loop_unrolled(b: Builder, at: Site) -> Node:
    states = _starts(at)
    for i in range(_turns(at) or 0):
        given = (build.constant(b.graph, INT, i), *states)
        here = dict(zip(_iterating(at).variables, given, strict=True))
        states = tuple(b.substituted(following, here) for following in _nexts(at))
    return _states(b, at, states)


def _is_short(turns: int | None, bodies: Iterable[Node], formals: frozenset[Formal]) -> bool:
    """Whether a loop is so short, in turns or in operations, that it is better written out.

    A loop in it is not copied. Only what changes from turn to turn counts, and is looked at only
    so far as to know that it is too much.
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


LOOP_RULES = (
    Rule("fold of nothing", "A fold that never turns is what it starts with.",
         (".fold",), (ANY, ANY, ANY), lambda _b, at: at.operands[1], _never_turns),
    Rule("fold of neutral terms", "Terms that change nothing leave what a fold starts with.",
         (".fold",), (ANY, ANY, ANY), lambda _b, at: at.operands[1], _adds_nothing),
    Rule("fold of constants", "A fold of constants is computed when compiling, if it is short.",
         (".fold",), (CONSTANT, CONSTANT, ANY), _evaluated, _is_fixed),
    Rule("fold written out", "A fold of few turns, or of few operations, is written out.",
         (".fold",), (ANY, ANY, ANY), _fold_unrolled, _fold_is_short),
    Rule("loop of no turns", "A loop that never turns leaves its states as they are.",
         (".iterate",), ANY, _unchanged, _never_turns),
    Rule("loop that stops at once", "A loop that does not go on leaves its states as they are.",
         (".iterate",), ANY, _unchanged, _stops_at_once),
    Rule("loop that changes nothing", "A state that stays as it is, is what it starts with.",
         (".iterate",), ANY, _unchanged, _changes_nothing),
    Rule("loop of constants", "A loop of constants is computed when compiling, if it is short.",
         (".iterate",), ANY, _evaluated_states, _is_fixed),
    Rule("loop written out", "A loop of few turns, or of few operations, that never stops early "
         "is written out.",
         (".iterate",), ANY, _loop_unrolled, _loop_is_short),
)  # fmt: skip

"""Bounded loops: folds over a range of numbers, and states taken from turn to turn.

How often a loop turns may be known at run time only; how often it turns at most is known when
compiling, from the ranges of what its bounds are computed from, or because it is written there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from ....frozen import frozen
from ....stdlib.builtins import BUILTINS
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir import build
from ...ir.binding import Moved, close, substitute
from ...ir.node import Folding, FoldOperator, Formal, Graph, Iterating, Node, reachable
from ...ir.types import BOOL, INT, Scalar, Texture, Type, Vector, width
from ...syntax import ast
from ...trampoline import Step
from ..state.scope import FAILURE, Failure, Scope, Value
from ..types.coercion import coerce

if TYPE_CHECKING:
    from ..state.context import Lowering

LONGEST = 4096
"""Turns of a loop, at most."""
LARGEST_STATE = 64
"""Numbers, vectors and matrices in the state of a loop."""
CROSSING_TURNS = 16
"""A fold whose terms cross from the vertices one by one is written out, up to so many."""

OPERATORS: Mapping[ast.FoldWord, FoldOperator] = {
    "sum": "add", "product": "mul", "min": "min", "max": "max", "all": "and", "any": "or",
}  # fmt: skip
_OF_NOTHING: Mapping[FoldOperator, float | bool] = {"add": 0, "mul": 1, "and": True, "or": False}
"""What a fold without terms and without a value to begin with is."""
_VARYING = frozenset({"cross", "attribute", "input", "resource"})


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
    neutral = _OF_NOTHING[operator]
    lane = build.constant(
        graph, Scalar(type_.kind), float(neutral) if type_.kind == "float" else neutral
    )
    return build.splat(graph, lane, width(type_))


# --- turns ---------------------------------------------------------------------------------------


@frozen
class _Turns:
    """How often a loop turns."""

    count: Node
    bound: int
    first: Node
    formal: Formal
    index: Node
    """``first`` and the turn's number together."""

    @property
    def known(self) -> bool:
        """Whether it turns ``bound`` times, no less."""
        return self.count.op == "constant"


def _turns(low: Lowering, written: ast.Turns, scope: Scope, span: Span) -> Step[_Turns | Failure]:
    ends = []
    for end in (written.start, written.end):
        node = yield low.typed(end, scope, INT, "int")
        ends.append(node)
    most: int | None = LONGEST
    if written.most is not None:
        limit = yield low.typed(written.most, scope, INT, "int")
        if isinstance(limit, Node) and low.is_left_to_a_use(limit):
            most = 1
        else:
            most = low.constants.integer(limit, written.most.span)
    first, end = ends
    if isinstance(first, Failure) or isinstance(end, Failure) or most is None:
        return FAILURE
    found = _count(low, first, end, most, written, span)
    if found is None:
        return FAILURE
    count, bound = found
    formal = Formal(written.variable.text or "turn")
    low.ranges.note_index(formal, bound)
    turn = low.graph.node("formal", INT, (), formal)
    index = turn
    if low.constants.known_integer(first) != 0:
        index = low.graph.node("call", INT, (turn, first), "add")
    return _Turns(count, bound, first, formal, index)


def _count(
    low: Lowering, first: Node, end: Node, most: int, written: ast.Turns, span: Span
) -> tuple[Node, int] | None:
    """How often a loop turns, and at most; reported where nothing says that."""
    known = [low.constants.known_integer(node) for node in (first, end)]
    if known[0] is not None and known[1] is not None:
        turns = max(known[1] - known[0], 0)
        turns = turns if written.most is None else max(min(turns, most), 0)
        if turns > LONGEST:
            low.report.add(rules.FOLD_TOO_LONG, span, count=turns, most=LONGEST)
            return None
        return build.constant(low.graph, INT, turns), turns
    if written.most is not None and most > LONGEST:
        low.report.add(rules.FOLD_TOO_LONG, written.most.span, count=most, most=LONGEST)
        return None
    facts = low.ranges.of(first), low.ranges.of(end)
    bound = min(facts[1].hi - facts[0].lo, most if written.most is not None else float("inf"))
    if bound > LONGEST and (low.is_left_to_a_use(first) or low.is_left_to_a_use(end)):
        bound = 1
    if bound > LONGEST:
        way = "write `up to 16` behind the bounds"
        if not written.variable.text:
            way = "write `for i in 0..n up to 16`"
        hint = f"give the parameter a range, `in 0..16`, or {way}"
        low.report.add(rules.UNBOUNDED_LOOP, written.end.span, hint=hint)
        return None
    count = end
    if known[0] != 0:
        count = low.graph.node("call", INT, (end, first), "sub")
    return count, max(int(bound), 0)


# --- folds ---------------------------------------------------------------------------------------


def fold(low: Lowering, e: ast.Fold, scope: Scope) -> Step[Value]:
    """``sum i in a..b from x : e`` and its like."""
    operator = OPERATORS[e.operator]
    turns = yield _turns(low, e.turns, scope, e.span)
    initial = None
    if e.initial is not None:
        initial = yield low.node(e.initial, scope)
    if isinstance(turns, Failure) or isinstance(initial, Failure):
        return FAILURE
    inner = scope.binding({e.turns.variable.text: turns.index})
    body = yield low.node(e.body, inner)
    body = _term(low, e, operator, body)
    if isinstance(body, Failure):
        return FAILURE
    if initial is not None:
        fitted = coerce(low.graph, initial, body.type)
        if fitted is None and (adapted := coerce(low.graph, body, initial.type)) is not None:
            body, fitted = adapted, initial
        assert e.initial is not None
        initial = fitted or low.fit(initial, body.type, str(body.type), e.initial.span)
        if isinstance(initial, Failure):
            return FAILURE
    if not _allowed(low, turns, (body,), {turns.formal}, e.span, waits=False):
        return FAILURE
    return _combined(low, e, operator, turns, body, initial)


def _term(
    low: Lowering, e: ast.Fold, operator: FoldOperator, body: Node | Failure
) -> Node | Failure:
    """A term as one that the fold can take."""
    if isinstance(body, Failure):
        return FAILURE
    if operator in ("and", "or"):
        return low.fit(body, BOOL, "bool", e.body.span)
    if not isinstance(body.type, Scalar | Vector) or body.type.kind == "bool":
        low.report.add(rules.WRONG_TYPE, e.body.span, expected="a number", found=body.type)
        return FAILURE
    return body


def _combined(
    low: Lowering,
    e: ast.Fold,
    operator: FoldOperator,
    turns: _Turns,
    body: Node,
    initial: Node | None,
) -> Node | Failure:
    crosses = any(node.op == "cross" for node in changing((body,), {turns.formal}))
    if initial is None and operator in ("min", "max"):
        if not turns.known or turns.bound == 0:
            low.report.add(rules.NO_INITIAL, e.span, word=e.operator)
            return FAILURE
        return _written_out(low, operator, turns, body, None) if crosses else _from_first(
            low, operator, turns, body
        )  # fmt: skip
    if crosses:
        return _written_out(low, operator, turns, body, initial)
    result = folded(
        low.graph, operator, turns.bound, body, turns.formal, low.notes.follow, turns.count, initial
    )
    low.notes.variables.setdefault(result.id, (e.turns.variable.text,))
    return result


def _from_first(low: Lowering, operator: FoldOperator, turns: _Turns, body: Node) -> Node:
    """A fold that begins with its first term."""
    first = _at(low, body, turns.formal, 0)
    turn = low.graph.node("formal", INT, (), turns.formal)
    one = build.constant(low.graph, INT, 1)
    later = low.graph.node("call", INT, (turn, one), "add")
    rest = substitute(low.graph, body, {turns.formal: later}, low.notes.follow)
    return folded(
        low.graph, operator, turns.bound - 1, rest, turns.formal, low.notes.follow, start=first
    )


def _written_out(
    low: Lowering, operator: FoldOperator, turns: _Turns, body: Node, initial: Node | None
) -> Node:
    """A fold turn by turn."""
    terms = [_at(low, body, turns.formal, turn) for turn in range(turns.bound)]
    if operator not in ("min", "max") or initial is not None:
        terms.insert(0, initial or _of_nothing(low.graph, operator, body.type))
    total = terms[0]
    for term in terms[1:]:
        total = low.graph.node("call", body.type, (total, term), operator)
    return total


def _at(low: Lowering, body: Node, formal: Formal, turn: int) -> Node:
    number = build.constant(low.graph, INT, turn)
    return substitute(low.graph, body, {formal: number}, low.notes.follow)


# --- states --------------------------------------------------------------------------------------


def iterate(low: Lowering, e: ast.Iterate, scope: Scope) -> Step[Value]:
    """``iterate x from e up to n while c : next``: a structure is several states."""
    initial = yield low.node(e.initial, scope)
    turns = yield _turns(low, e.turns, scope, e.span)
    if isinstance(initial, Failure) or isinstance(turns, Failure):
        return FAILURE
    if isinstance(initial.type, Texture):
        low.report.add(
            rules.WRONG_TYPE, e.initial.span, expected="a value", found=initial.type,
            hint="a texture cannot change from turn to turn",
        )  # fmt: skip
        return FAILURE
    starts = tuple(build.flattened(low.graph, initial))
    if len(starts) > LARGEST_STATE:
        low.report.add(rules.STATE_TOO_LARGE, e.initial.span, count=len(starts), most=LARGEST_STATE)
        return FAILURE
    names = tuple(name for name, _ in build.named_parts(e.state.text, initial.type))
    formals = tuple(map(Formal, names))
    variables = [
        low.graph.node("formal", start.type, (), formal)
        for start, formal in zip(starts, formals, strict=True)
    ]
    whole = build.assembled(low.graph, initial.type, iter(variables))
    inner = scope.binding({e.turns.variable.text: turns.index, e.state.text: whole})
    going: Node | Failure = build.constant(low.graph, BOOL, True)
    if e.condition is not None:
        going = yield low.typed(e.condition, inner, BOOL, "bool")
    body = yield low.node(e.body, inner)
    body = _following(low, e, body, initial)
    if isinstance(going, Failure) or isinstance(body, Failure):
        return FAILURE
    nexts = tuple(build.flattened(low.graph, body))
    waits = e.condition is not None
    if not _allowed(
        low, turns, (going, *nexts), {turns.formal, *formals}, e.span, waits=waits, states=True
    ):
        return FAILURE
    states = list(zip(formals, variables, starts, nexts, strict=True))
    return build.assembled(low.graph, initial.type, iter(_looped(low, turns, states, going)))


def _following(
    low: Lowering, e: ast.Iterate, body: Node | Failure, initial: Node
) -> Node | Failure:
    """What a turn makes of the state, as a state."""
    if isinstance(body, Failure):
        return FAILURE
    fitted = coerce(low.graph, body, initial.type)
    if fitted is None:
        low.report.add(
            rules.STATE_CHANGES, e.body.span, name=e.state.text, before=initial.type,
            after=body.type, labels=[Label(e.initial.span, f"this is `{initial.type}`")],
        )  # fmt: skip
        return FAILURE
    return fitted


def _looped(
    low: Lowering,
    turns: _Turns,
    states: list[tuple[Formal, Node, Node, Node]],
    going: Node,
) -> list[Node]:
    """The last states of a loop; what no turn changes is no part of it."""
    graph, moved = low.graph, low.notes.follow
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
    low.notes.variables.setdefault(loop.id, tuple(formal.name for formal in formals))
    last = {formal: build.state(graph, loop, k) for k, (formal, *_) in enumerate(kept)}
    return [fixed.get(formal) or last[formal] for formal, *_ in states]


# --- what may stand in a loop --------------------------------------------------------------------


def changing(bodies: Iterable[Node], formals: set[Formal]) -> Iterator[Node]:
    """What a loop over ``formals`` computes anew in every turn, inner loops included."""
    seen: set[int] = set()
    pending = list(bodies)
    while pending:
        node = pending.pop()
        if node.id not in seen and (node.free or not node.variables.isdisjoint(formals)):
            seen.add(node.id)
            yield node
            pending += node.operands


def _allowed(
    low: Lowering,
    turns: _Turns,
    bodies: tuple[Node, ...],
    formals: set[Formal],
    span: Span,
    *,
    waits: bool,
    states: bool = False,
) -> bool:
    """Whether everything in a loop has a meaning there; ``waits``: pixels may stop apart."""
    inside = list(changing(bodies, formals))
    crossing = next((node for node in inside if node.op == "cross"), None)
    if crossing is not None and (states or not turns.known or turns.bound > CROSSING_TURNS):
        low.report.add(rules.CROSSING_IN_LOOP, low.notes.spans.get(crossing.id, span))
        return False
    read = next((node for node in inside if _compares_neighbours(node)), None)
    if read is None or not (waits or _varies(turns.count)):
        return True
    what = "a texture read" if read.data == "sample" else f"`{read.data}`"
    labels = [Label(span, "pixels leave this loop at different turns")]
    low.report.add(rules.READ_IN_LOOP, low.notes.spans.get(read.id, span), what=what, labels=labels)
    return False


def _compares_neighbours(node: Node) -> bool:
    return node.op in ("call", "native") and BUILTINS[str(node.data)].uniform_control_flow


def _varies(count: Node) -> bool:
    """Whether pixels may turn differently often."""
    return any(node.op in _VARYING for node in reachable((count,)))

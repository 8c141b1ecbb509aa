"""Exact simplification: every rule keeps the value, over the whole domain.

``Simplifier.make`` is a smart constructor; passes build through it, so that what one rule uncovers
the next one sees. Rules stand in tables by operation and by builtin.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from math import isfinite

from ...stdlib.builtins import BUILTINS
from ..diagnostics.source import Span
from ..ir import build
from ..ir.binding import substitute
from ..ir.node import Folding, Formal, Graph, Iterating, Node, Op
from ..ir.operations import LOOPS, SWIZZLE, builtin_of
from ..ir.ranges import Ranges
from ..ir.refinements import OPPOSITES
from ..ir.rewrite import rewrite
from ..ir.shader import Notes
from ..ir.types import INT, Scalar, Type, Vector, scalar_kind, width
from ..reference.evaluate import evaluate
from ..reference.namespace import Lanes
from ..reference.operations import apply, constant_lanes
from .arithmetic import BUILTIN_RULES, DECIDED, uniform_lane
from .bits import BIT_RULES
from .cost import cost, cost_of
from .path_conditions import PathRefinement
from .remarks import Outcome, Remark

LARGEST_FLOAT = 3.4028234663852886e38
UNROLLED = 2
"""Loops of at most so many turns are written out."""
MOST_UNROLLED = 4
"""Up to so many, if they come to no more than this many operations:"""
UNROLLED_COST = 12
LONGEST_FIXED = 4096
"""Loops of constants are computed when compiling if they come to no more operations."""
_COMPUTED = frozenset(
    {"constant", "call", "vector", "splat", "matrix", "swizzle", "index", "array", "select"}
)
NEUTRAL: Mapping[str, float | bool] = {"add": 0, "mul": 1, "and": True, "or": False}
"""What changes nothing, term by term."""

OpRule = Callable[["Simplifier", Type, tuple[Node, ...], Hashable], Node | None]


class Simplifier:
    """Builds nodes in their simplest form."""

    def __init__(self, graph: Graph, ranges: Ranges, notes: Notes) -> None:
        self.graph = graph
        self.ranges = ranges
        self.notes = notes
        self.at: Span | None = None
        """The source of what is being built."""
        self.expanding = 0
        """How many expansions deep."""
        self.remarks: dict[Hashable, Remark] = {}

    def remark(
        self,
        builtin: str,
        operands: tuple[Node, ...],
        outcome: Outcome,
        conditions: tuple[PathRefinement, ...] = (),
    ) -> None:
        """Remember what became of a builtin that stands in somebody's text."""
        if not self.expanding:
            key = builtin, operands, outcome
            if key not in self.remarks:
                self.remarks[key] = Remark(builtin, operands, self.at, outcome, conditions)

    def rule(self, _graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node:
        """For ``rewrite``: the same operation in its simplest form."""
        self.at = self.notes.spans.get(node.id, self.at)
        return self.make(node.op, node.type, operands, node.data) if operands else node

    def make(
        self, op: Op, type_: Type, operands: tuple[Node, ...] = (), data: Hashable = None
    ) -> Node:
        """The simplest node with the value of this operation."""
        rule = _RULES.get(op)
        simpler = rule(self, type_, operands, data) if rule is not None else None
        return simpler if simpler is not None else self.graph.node(op, type_, operands, data)

    def call(self, name: str, type_: Type, *operands: Node) -> Node:
        """A builtin of Burnish's meaning."""
        return self.make("call", type_, operands, name)

    def constant(self, type_: Type, value: float | int | bool) -> Node:
        """A constant with one value in every lane."""
        lane = float(value) if scalar_kind(type_) == "float" else value
        lanes = width(type_)
        return build.constant(self.graph, type_, lane if lanes == 1 else (lane,) * lanes)


# --- builtins ------------------------------------------------------------------------------------


def _builtin(op: Op) -> OpRule:
    def rule(s: Simplifier, type_: Type, operands: tuple[Node, ...], data: Hashable) -> Node | None:
        name = str(data)
        folded = _folded(s, type_, operands, name)
        if folded is not None:
            return folded
        special = BUILTIN_RULES.get(name) or BIT_RULES.get(name)
        simpler = special(s, op, type_, operands) if special is not None else None
        if simpler is not None and name in DECIDED and simpler.data != "saturate":
            s.remark(name, operands, "dropped")
        return simpler

    return rule


def _folded(s: Simplifier, type_: Type, operands: tuple[Node, ...], name: str) -> Node | None:
    """The value of a builtin of constants, where float32 can hold it."""
    for operand in operands:
        if operand.op != "constant":
            return None
    if BUILTINS[name].uniform_control_flow or not isinstance(type_, Scalar | Vector):
        return None
    lanes = apply(
        s.graph.node("call", type_, operands, name),
        [constant_lanes(operand.type, operand.data) for operand in operands],
    )
    return _representable(s, type_, lanes)


def _representable(s: Simplifier, type_: Type, lanes: Lanes) -> Node | None:
    """A constant, where float32 can hold it."""
    if any(isinstance(v, float) and not (isfinite(v) and abs(v) <= LARGEST_FLOAT) for v in lanes):
        return None
    return build.constant(s.graph, type_, lanes[0] if isinstance(type_, Scalar) else tuple(lanes))


# --- structure -----------------------------------------------------------------------------------


def _swizzle(s: Simplifier, type_: Type, operands: tuple[Node, ...], data: Hashable) -> Node | None:
    (source,) = operands
    assert isinstance(data, tuple)
    lanes: tuple[int, ...] = data
    match source.op:
        case "constant":
            values = constant_lanes(source.type, source.data)
            picked = tuple(values[lane] for lane in lanes)
            return build.constant(s.graph, type_, picked[0] if len(picked) == 1 else picked)
        case "swizzle":
            inner = SWIZZLE.data(source)
            return s.make("swizzle", type_, source.operands, tuple(inner[lane] for lane in lanes))
        case "splat":
            return build.splat(s.graph, source.operands[0], len(lanes))
        case "vector":
            return _picked(s, type_, source, lanes)
        case _:
            whole = lanes == tuple(range(width(source.type)))
            return source if whole else None


def _picked(s: Simplifier, type_: Type, source: Node, lanes: tuple[int, ...]) -> Node | None:
    """Lanes of a joined vector, where they all come from one of its parts."""
    first = 0
    for part in source.operands:
        last = first + width(part.type)
        if all(first <= lane < last for lane in lanes):
            inside = tuple(lane - first for lane in lanes)
            if isinstance(part.type, Scalar):
                return build.splat(s.graph, part, len(lanes))
            return s.make("swizzle", type_, (part,), inside)
        first = last
    return None


def _vector(s: Simplifier, type_: Type, operands: tuple[Node, ...], _data: Hashable) -> Node | None:
    if all(operand.op == "constant" for operand in operands):
        lanes = tuple(
            lane for operand in operands for lane in constant_lanes(operand.type, operand.data)
        )
        return build.constant(s.graph, type_, lanes)
    if len(set(operands)) == 1 and isinstance(operands[0].type, Scalar):
        return s.make("splat", type_, operands[:1])
    return _rejoined(s, type_, operands)


def _rejoined(s: Simplifier, type_: Type, operands: tuple[Node, ...]) -> Node | None:
    """Lanes of one vector, taken apart and joined again."""
    sources = {operand.operands[0] if operand.op == "swizzle" else operand for operand in operands}
    if len(sources) != 1 or not isinstance((source := sources.pop()).type, Vector):
        return None
    lanes: tuple[int, ...] = ()
    for operand in operands:
        whole = operand.op != "swizzle"
        lanes += tuple(range(width(operand.type))) if whole else SWIZZLE.data(operand)
    return s.make("swizzle", type_, (source,), lanes)


def _splat(s: Simplifier, type_: Type, operands: tuple[Node, ...], _data: Hashable) -> Node | None:
    (lane,) = operands
    if lane.op != "constant":
        return None
    return build.constant(s.graph, type_, (lane.data,) * width(type_))  # type: ignore[arg-type]


def _index(s: Simplifier, type_: Type, operands: tuple[Node, ...], _data: Hashable) -> Node | None:
    source, position = operands
    if source.op == "array" and len(set(source.operands)) == 1:
        return source.operands[0]
    if position.op != "constant":
        return None
    assert isinstance(position.data, int)
    if isinstance(source.type, Vector):
        return s.make("swizzle", type_, (source,), (position.data,))
    return source.operands[position.data] if source.op in ("matrix", "array") else None


def _member(s: Simplifier, _type: Type, operands: tuple[Node, ...], data: Hashable) -> Node:
    return build.member(s.graph, operands[0], str(data))


def _select(s: Simplifier, type_: Type, operands: tuple[Node, ...], data: Hashable) -> Node | None:
    condition, then, otherwise = operands
    if condition.op == "constant":
        return then if condition.data else otherwise
    if then is otherwise:
        return then
    if builtin_of(condition) == "not":
        return s.make("select", type_, (condition.operands[0], otherwise, then), data)
    if then.op == "constant" != otherwise.op and _is_comparison(condition):
        # The side that computes something comes first: it is the one that a branch may skip.
        opposite = s.make(condition.op, condition.type, (condition,), "not")
        return s.make("select", type_, (opposite, otherwise, then), data)
    if (then.data, otherwise.data) == (True, False) and then.op == otherwise.op == "constant":
        return condition if isinstance(type_, Scalar) and type_.kind == "bool" else None
    return None


def _is_comparison(node: Node) -> bool:
    return builtin_of(node) in OPPOSITES


def _cross(_s: Simplifier, _type: Type, operands: tuple[Node, ...], _data: Hashable) -> Node | None:
    return operands[0] if operands[0].op == "constant" else None


def _fold(s: Simplifier, type_: Type, operands: tuple[Node, ...], data: Hashable) -> Node | None:
    """Folds that do nothing, or so little that it is written out."""
    count, start, body = operands
    assert isinstance(data, Folding)
    turns = _turns(count, data.bound)
    if turns == 0 or _is_neutral(body, data.operator):
        return start
    if turns is None:
        return None
    if start.op == "constant" and _is_fixed(turns, (body,), {data.index}):
        return _evaluated(s, s.graph.node("fold", type_, operands, data))
    if not _worth_unrolling(turns, (body,), {data.index}):
        return None
    result = start
    for i in range(turns):
        turn = substitute_through(s, body, {data.index: build.constant(s.graph, INT, i)})
        result = s.call(data.operator, type_, result, turn)
    return result


def _is_neutral(body: Node, operator: str) -> bool:
    """Whether no turn changes anything; of the least and the greatest no constant says so."""
    return operator in NEUTRAL and uniform_lane(body) == NEUTRAL[operator]


def _iterate(s: Simplifier, type_: Type, operands: tuple[Node, ...], data: Hashable) -> Node | None:
    """Loops that never turn, or that turn a few times without asking whether to stop."""
    assert isinstance(data, Iterating)
    formals = data.variables
    count, states = operands[0], operands[1 : 1 + data.states]
    going, nexts = operands[1 + data.states], operands[2 + data.states :]
    turns = _turns(count, data.bound)
    stops_at_once = going.op == "constant" and going.data is False
    if turns == 0 or stops_at_once or (data.states == 1 and nexts[0].data is formals[1]):
        return _states(s, type_, states)
    if turns is None or going.op != "constant":
        return None
    if not _worth_unrolling(turns, nexts, set(formals)):
        return None
    for i in range(turns):
        given = (build.constant(s.graph, INT, i), *states)
        here = dict(zip(formals, given, strict=True))
        states = tuple(substitute_through(s, following, here) for following in nexts)
    return _states(s, type_, states)


def _states(s: Simplifier, type_: Type, states: tuple[Node, ...]) -> Node:
    return states[0] if len(states) == 1 else s.graph.node("struct", type_, states)


def _turns(count: Node, bound: int) -> int | None:
    """How often a loop turns, where that is known; no count may be above its bound."""
    if bound == 0:
        return 0
    if count.op != "constant" or not isinstance(count.data, int):
        return None
    return max(min(count.data, bound), 0)


def _is_fixed(turns: int, bodies: Iterable[Node], formals: set[Formal]) -> bool:
    """Whether a loop computes with constants and its own variables, and not for too long."""
    seen: set[int] = set()
    pending = list(bodies)
    while pending:
        node = pending.pop()
        if node.id in seen:
            continue
        seen.add(node.id)
        own = node.op == "formal" and node.data in formals
        if not (own or node.op in _COMPUTED) or len(seen) * turns > LONGEST_FIXED:
            return False
        pending += node.operands
    return True


def _evaluated(s: Simplifier, loop: Node) -> Node | None:
    """The value of a loop of constants, where float32 can hold it."""
    return _representable(s, loop.type, evaluate(loop))


def _worth_unrolling(turns: int, bodies: Iterable[Node], formals: set[Formal]) -> bool:
    """Whether a loop is so short, in turns or in operations, that it is better written out.

    A loop in it is not copied. Only what changes from turn to turn counts, and is looked at only
    so far as to know that it is too much.
    """
    if turns > MOST_UNROLLED:
        return False
    spent, seen = 0, set()
    pending = list(bodies)
    while pending:
        node = pending.pop()
        if node.id in seen or node.variables.isdisjoint(formals):
            continue
        seen.add(node.id)
        if node.op in LOOPS:
            return False
        spent += (cost(node) if node.op == "apply" else cost_of(node)) * turns
        if turns > UNROLLED and spent > UNROLLED_COST:
            return False
        pending += node.operands
    return True


def substitute_through(s: Simplifier, body: Node, replacements: Mapping[Formal, Node]) -> Node:
    """``body`` with formals replaced, each node that changes built anew in its simplest form."""
    replaced = substitute(s.graph, body, replacements, s.notes.follow)
    if replaced is body:
        return body
    (simplified,) = rewrite(s.graph, (replaced,), s.rule, s.notes.follow)
    return simplified


_RULES: Mapping[str, OpRule] = {
    "call": _builtin("call"),
    "native": _builtin("native"),
    "swizzle": _swizzle,
    "vector": _vector,
    "splat": _splat,
    "index": _index,
    "select": _select,
    "cross": _cross,
    "member": _member,
    "fold": _fold,
    "iterate": _iterate,
}

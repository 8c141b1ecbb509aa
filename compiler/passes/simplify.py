"""Exact simplification: every rule keeps the value, over the whole domain.

``Simplifier.make`` is a smart constructor; passes build through it, so that what one rule uncovers
the next one sees. Rules stand in tables by operation and by builtin.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from math import isfinite

from ...stdlib.builtins import BUILTINS
from ..diagnostics.source import Span
from ..ir import build
from ..ir.binding import substitute
from ..ir.node import Folding, Formal, Graph, Node, Op
from ..ir.types import INT, Scalar, Type, Vector, scalar_kind, width
from ..reference.operations import apply, constant_lanes
from ..semantics.shader import Notes
from .arithmetic import BUILTIN_RULES, DECIDED, uniform_lane
from .conditions import OPPOSITES
from .judgement import Judgement, Outcome
from .paths import Told
from .ranges import Ranges
from .rewrite import rewrite

LARGEST_FLOAT = 3.4028234663852886e38
UNROLLED = 2
"""Folds of at most so many turns are written out."""

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
        self.judgements: dict[Hashable, Judgement] = {}

    def judge(
        self,
        builtin: str,
        operands: tuple[Node, ...],
        outcome: Outcome,
        told: tuple[Told, ...] = (),
    ) -> None:
        """Remember what became of a builtin that stands in somebody's text."""
        if not self.expanding:
            key = builtin, operands, outcome
            if key not in self.judgements:
                self.judgements[key] = Judgement(builtin, operands, self.at, outcome, told)

    def rule(self, _graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node:
        """For ``rewrite``: the same operation in its simplest form."""
        self.at = self.notes.spans.get(node.id, self.at)
        return self.make(node.op, node.type, operands, node.data)

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
        special = BUILTIN_RULES.get(name)
        simpler = special(s, op, type_, operands) if special is not None else None
        if simpler is not None and name in DECIDED and simpler.data != "saturate":
            s.judge(name, operands, "dropped")
        return simpler

    return rule


def _folded(s: Simplifier, type_: Type, operands: tuple[Node, ...], name: str) -> Node | None:
    """The value of a builtin of constants, where float32 can hold it."""
    if not operands or any(operand.op != "constant" for operand in operands):
        return None
    if BUILTINS[name].uniform_control_flow or not isinstance(type_, Scalar | Vector):
        return None
    lanes = apply(
        s.graph.node("call", type_, operands, name),
        [constant_lanes(operand.type, operand.data) for operand in operands],
    )
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
            assert isinstance(source.data, tuple)
            inner = source.data
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
        own = operand.data if operand.op == "swizzle" else tuple(range(width(operand.type)))
        assert isinstance(own, tuple)
        lanes += own
    return s.make("swizzle", type_, (source,), lanes)


def _splat(s: Simplifier, type_: Type, operands: tuple[Node, ...], _data: Hashable) -> Node | None:
    (lane,) = operands
    if lane.op != "constant":
        return None
    return build.constant(s.graph, type_, (lane.data,) * width(type_))  # type: ignore[arg-type]


def _index(s: Simplifier, type_: Type, operands: tuple[Node, ...], _data: Hashable) -> Node | None:
    source, position = operands
    if position.op != "constant":
        return None
    assert isinstance(position.data, int)
    if isinstance(source.type, Vector):
        return s.make("swizzle", type_, (source,), (position.data,))
    return source.operands[position.data] if source.op == "matrix" else None


def _select(s: Simplifier, type_: Type, operands: tuple[Node, ...], data: Hashable) -> Node | None:
    condition, then, otherwise = operands
    if condition.op == "constant":
        return then if condition.data else otherwise
    if then is otherwise:
        return then
    if condition.op in ("call", "native") and condition.data == "not":
        return s.make("select", type_, (condition.operands[0], otherwise, then), data)
    if then.op == "constant" != otherwise.op and _is_comparison(condition):
        # The side that computes something comes first: it is the one that a branch may skip.
        opposite = s.make(condition.op, condition.type, (condition,), "not")
        return s.make("select", type_, (opposite, otherwise, then), data)
    if (then.data, otherwise.data) == (True, False) and then.op == otherwise.op == "constant":
        return condition if isinstance(type_, Scalar) and type_.kind == "bool" else None
    return None


def _is_comparison(node: Node) -> bool:
    return node.op in ("call", "native") and node.data in OPPOSITES


def _interpolate(
    _s: Simplifier, _type: Type, operands: tuple[Node, ...], _data: Hashable
) -> Node | None:
    return operands[0] if operands[0].op == "constant" else None


def _fold(s: Simplifier, type_: Type, operands: tuple[Node, ...], data: Hashable) -> Node | None:
    """Folds that do nothing, or so little that it is written out."""
    count, start, body = operands
    assert isinstance(data, Folding)
    neutral = 0 if data.operator == "add" else 1
    if data.bound == 0 or uniform_lane(body) == neutral:
        return start
    if count.op != "constant" or data.bound > UNROLLED or data.index is None:
        return None
    result = start
    for i in range(data.bound):
        turn = substitute_through(s, body, {data.index: build.constant(s.graph, INT, i)})
        result = s.call(data.operator, type_, result, turn)
    return result


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
    "interpolate": _interpolate,
    "fold": _fold,
}

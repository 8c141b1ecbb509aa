"""Range analysis: what is known of every value, from declared ranges and the builtins' rules."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.facts import UNIT, UNKNOWN, Fact, Kind
from .leaves import Parameter
from .meaning import Meaning
from .node import Folding, Formal, Iterating, Node, reachable
from .types import Array, Matrix, Struct, scalar_kind


class Ranges:
    """Facts of nodes, worked out on demand and kept; for graphs whose binders are open.

    Semantics asks while binders are still closed: then nothing is known of their variables.
    """

    def __init__(self, roots: Iterable[Node]) -> None:
        self._facts: dict[int, Fact] = {}
        self._sources: dict[Formal, list[Node]] = {}
        """The arguments that a formal stands for, over all applies."""
        self._indices: dict[Formal, int] = {}
        """How far the index of a fold runs."""
        self.note_binders(roots)

    def note_binders(self, roots: Iterable[Node]) -> None:
        """Learn what the formals under ``roots`` stand for."""
        for node in reachable(roots):
            if node.op == "apply":
                assert isinstance(node.data, tuple)
                for formal, argument in zip(node.data, node.operands[1:], strict=True):
                    self._sources.setdefault(formal, []).append(argument)
            elif node.op == "fold":
                assert isinstance(node.data, Folding) and node.data.index is not None
                self.note_index(node.data.index, node.data.bound)
            elif node.op == "iterate":
                assert isinstance(node.data, Iterating) and node.data.formals is not None
                self.note_index(node.data.formals[0], node.data.bound)

    def note_index(self, formal: Formal, bound: int) -> None:
        """``formal`` counts the turns of a loop, of which there are at most ``bound``."""
        self._indices[formal] = bound

    def of(self, node: Node) -> Fact:
        """What is known of ``node``."""
        known = self._facts.get(node.id)
        if known is not None:
            return known
        pending = [node]
        while pending:
            top = pending[-1]
            if top.id in self._facts:
                pending.pop()
                continue
            missing = [need for need in self._needs(top) if need.id not in self._facts]
            if missing:
                pending.extend(missing)
                continue
            pending.pop()
            self._facts[top.id] = self._derive(top).as_kind(_kind(top))
        return self._facts[node.id]

    def assume(self, node: Node, fact: Fact) -> None:
        """Take over what is known of a node's value otherwise than through its operands."""
        known = self._facts.get(node.id)
        self._facts[node.id] = fact if known is None else known.meet(fact)

    def _needs(self, node: Node) -> tuple[Node, ...] | list[Node]:
        if node.op == "formal":
            assert isinstance(node.data, Formal)
            return self._sources.get(node.data, [])
        return node.operands

    def _derive(self, node: Node) -> Fact:
        rule = _RULES.get(node.op)
        if rule is not None:
            return rule(node, [self._facts[operand.id] for operand in node.operands])
        if node.op == "formal":
            return self._formal(node)
        return UNKNOWN

    def _formal(self, node: Node) -> Fact:
        assert isinstance(node.data, Formal)
        if node.data in self._indices:
            return Fact(0.0, float(max(self._indices[node.data] - 1, 0)))
        return _union([self._facts[source.id] for source in self._sources.get(node.data, [])])


def _kind(node: Node) -> Kind:
    type_ = node.type
    while isinstance(type_, Array):
        type_ = type_.element
    return "matrix" if isinstance(type_, Matrix) else scalar_kind(type_) or "float"


def _union(facts: list[Fact]) -> Fact:
    if not facts:
        return UNKNOWN
    result = facts[0]
    for fact in facts[1:]:
        result = result.union(fact)
    return result


def _constant(node: Node, _operands: list[Fact]) -> Fact:
    if isinstance(node.type, Matrix):
        return UNKNOWN
    lanes = node.data if isinstance(node.data, tuple) else (node.data,)
    numbers = [float(lane) for lane in lanes]
    return Fact(min(numbers), max(numbers), nonzero=all(abs(n) >= 2.0**-126 for n in numbers))


def _parameter(node: Node, _operands: list[Fact]) -> Fact:
    assert isinstance(node.data, Parameter)
    return node.data.fact


def _call(node: Node, operands: list[Fact]) -> Fact:
    same = len(node.operands) > 1 and len({operand.id for operand in node.operands}) == 1
    return BUILTINS[str(node.data)].range(tuple(operands), same)


def _joined(_node: Node, operands: list[Fact]) -> Fact:
    joined = _union(operands)
    return Fact(joined.lo, joined.hi, joined.excludes_zero, kind=joined.kind)


def _elements(_node: Node, operands: list[Fact]) -> Fact:
    """What holds of each element."""
    return _union(operands)


def _lanes(_node: Node, operands: list[Fact]) -> Fact:
    (whole,) = operands
    return Fact(whole.lo, whole.hi, whole.nonzero, kind=whole.kind)


def _index(node: Node, operands: list[Fact]) -> Fact:
    whole = operands[0]
    if isinstance(node.operands[0].type, Matrix):
        return UNKNOWN
    if isinstance(node.operands[0].type, Array):
        return whole
    return Fact(whole.lo, whole.hi, whole.nonzero, kind=whole.kind)


def _member(node: Node, _operands: list[Fact]) -> Fact:
    """A member of a light of many: its parameter carries a fact for each member."""
    source = node.operands[0]
    while source.op in ("index", "as"):
        source = source.operands[0]
    if isinstance(source.data, Parameter) and isinstance(node.operands[0].type, Struct):
        return dict(source.data.member_facts).get(str(node.data), UNKNOWN)
    return UNKNOWN


def _ascribed(node: Node, operands: list[Fact]) -> Fact:
    """Only what has unit length is ever called a direction."""
    contract = isinstance(node.data, Meaning) and node.data.kind == "direction"
    return operands[0].meet(UNIT) if contract else operands[0]


def _select(_node: Node, operands: list[Fact]) -> Fact:
    return operands[1].union(operands[2])


def _interpolate(node: Node, operands: list[Fact]) -> Fact:
    """A mean of three vertices' values stays between them, but is no longer of unit length.

    Rounding may take it a little past either end.
    """
    (at_vertex,) = operands
    if node.data == "flat":
        return at_vertex
    slack = 1e-5 * max(abs(at_vertex.lo), abs(at_vertex.hi))
    if slack == float("inf"):
        return UNKNOWN
    return Fact(at_vertex.lo - slack if at_vertex.lo else 0.0, at_vertex.hi + slack)


def _fold(node: Node, operands: list[Fact]) -> Fact:
    assert isinstance(node.data, Folding)
    _count, start, body = operands
    if node.data.operator == "min":
        return Fact(min(start.lo, body.lo), start.hi)
    if node.data.operator == "max":
        return Fact(start.lo, max(start.hi, body.hi))
    if node.data.operator in ("and", "or"):
        return UNKNOWN
    if node.data.operator == "add":
        lo = start.lo + min(0.0, body.lo * node.data.bound) if node.data.bound else start.lo
        hi = start.hi + max(0.0, body.hi * node.data.bound) if node.data.bound else start.hi
        return Fact(lo, hi)
    return Fact(0.0) if start.lo >= 0 and body.lo >= 0 else UNKNOWN


def _iterate(node: Node, operands: list[Fact]) -> Fact:
    """A state is what it was at the start, or what a turn has made of it."""
    assert isinstance(node.data, Iterating)
    return operands[1].union(operands[-1]) if node.data.states == 1 else UNKNOWN


def _apply(_node: Node, operands: list[Fact]) -> Fact:
    return operands[0]


_RULES: Mapping[str, Callable[[Node, list[Fact]], Fact]] = {
    "constant": _constant,
    "parameter": _parameter,
    "call": _call,
    "native": _call,
    "as": _ascribed,
    "vector": _joined,
    "splat": _lanes,
    "swizzle": _lanes,
    "index": _index,
    "member": _member,
    "select": _select,
    "interpolate": _interpolate,
    "fold": _fold,
    "iterate": _iterate,
    "array": _elements,
    "apply": _apply,
}

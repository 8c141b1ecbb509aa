"""Range analysis: derives facts about every value from declared ranges and the builtins' rules.

Semantics, most passes and ``legalise`` ask a ``Ranges`` for the fact of a node. Every rule has a
name (``rulebook.py``). The analysis keeps facts, but not how it found them: ``proofs.py`` derives
that again for the few facts that a person wants to have explained.
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Iterable, Mapping, MutableMapping, Sequence

from ...frozen import frozen
from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.facts import UNIT, UNKNOWN, Fact, Kind
from ...stdlib.builtins.intervals import outward
from . import rulebook
from .invariants import invariants, parts_of
from .leaves import Parameter
from .node import Formal, Node, formals_of, reachable
from .operations import (
    ASCRIBE,
    CALL,
    CONSTANT,
    CROSS,
    FOLD,
    FORMAL,
    ITERATE,
    MEMBER,
    PARAMETER,
)
from .refinements import refinements
from .types import Array, Matrix, Struct, scalar_kind


class Ranges:
    """Facts of nodes, worked out on demand and kept; for graphs whose binders are open.

    Semantics asks while binders are still closed: then nothing is known of their variables.

    Rules in ``without`` are not applied: tests take each away to see what it is good for.
    """

    def __init__(self, roots: Iterable[Node], without: frozenset[str] = frozenset()) -> None:
        self.without = without
        self._facts: MutableMapping[Node, Fact] = {}
        self._sources: dict[Formal, list[Node]] = {}
        """The arguments that a formal stands for, over all applies."""
        self._indices: dict[Formal, int] = {}
        """How far the index of a fold runs."""
        self._states: dict[Formal, Node] = {}
        """The loop that a state belongs to."""
        self._leaves: dict[Formal, Node] = {}
        """The leaf that a variable is in the graph."""
        self._needed: dict[int, Sequence[Node]] = {}
        """What has to be known before the states of a loop, by its id."""
        self._found: dict[tuple[int, tuple[Fact, ...]], Sequence[Fact]] = {}
        """What holds of a loop's states, by its id and what they start with."""
        self._assuming = False
        """Whether facts of states are given: nothing is worked out of those of other loops."""
        self.note_binders(roots)

    def note_binders(self, roots: Iterable[Node]) -> None:
        """Learn what the formals under ``roots`` stand for."""
        for node in reachable(roots):
            if node.op == "apply":
                for formal, argument in zip(formals_of(node), node.operands[1:], strict=True):
                    self._sources.setdefault(formal, []).append(argument)
            elif node.op == "fold":
                self.note_index(FOLD.data(node).index, FOLD.data(node).bound)
            elif node.op == "iterate":
                turn, *states = formals_of(node)
                self.note_index(turn, ITERATE.data(node).bound)
                self._states.update(dict.fromkeys(states, node))
            elif node.op == "formal":
                self._leaves[FORMAL.data(node)] = node

    def note_index(self, formal: Formal, bound: int) -> None:
        """``formal`` counts the turns of a loop, of which there are at most ``bound``."""
        self._indices[formal] = bound

    def of(self, node: Node) -> Fact:
        """What is known of ``node``."""
        facts = self._facts
        known = facts.get(node)
        if known is not None:
            return known
        pending = [node]
        begun: set[Node] = set()
        while pending:
            top = pending[-1]
            if top in facts:
                pending.pop()
                continue
            needs = self.needs(top)
            # What a function gets may have been computed by the same function, before a loop and
            # in its turns: of a value that needs itself nothing is known on the way round.
            for need in needs:
                if need not in facts and need not in begun:
                    pending.append(need)
            begun.add(top)
            if pending[-1] is top:
                pending.pop()
                facts[top] = self.derived(top, tuple(map(self.so_far, needs)))
        return facts[node]

    def so_far(self, node: Node) -> Fact:
        """What is known of a value while another is derived that needs it, maybe in a circle."""
        known = self._facts.get(node)
        return UNKNOWN.as_kind(_kind(node)) if known is None else known

    def assuming(self, facts: Mapping[Node, Fact]) -> Ranges:
        """The same knowledge with more taken for granted; what follows from that is not kept."""
        other = Ranges((), self.without)
        other._facts = ChainMap(dict(facts), self._facts)
        other._sources, other._indices = self._sources, self._indices
        other._states, other._leaves = self._states, self._leaves
        other._assuming = True
        return other

    def needs(self, node: Node) -> Sequence[Node]:
        """The values from whose facts that of ``node`` is derived."""
        if node.op == "formal":
            formal = FORMAL.data(node)
            if formal in self._states:
                return () if self._assuming else self._needs_of_state(self._states[formal])
            return self._sources.get(formal, ())
        if node.op == "member" and node.operands[0].op == "iterate":
            return _start_and_next(node.operands[0], MEMBER.data(node))
        return node.operands

    def _needs_of_state(self, loop: Node) -> Sequence[Node]:
        """What the states start with, and what is the same in every turn."""
        if loop.id not in self._needed:
            own, states = frozenset(formals_of(loop)), ITERATE.data(loop).states
            around = frozenset((*self._states, *self._indices)) - own
            fixed = parts_of(loop.operands[-states:], around)
            self._needed[loop.id] = (*loop.operands[1 : 1 + states], *fixed)
        return self._needed[loop.id]

    def derived(self, node: Node, known: Sequence[Fact]) -> Fact:
        """What follows for ``node`` when so much is known of what it needs."""
        rule = self._rule(node)
        fact = UNKNOWN
        if rule is not None and not (self.without and rule.name(node) in self.without):
            fact = rule.derive(self, node, known)
        return fact.as_kind(_kind(node))

    def assume(self, node: Node, fact: Fact) -> None:
        """Add what is known of a node's value otherwise than through its operands."""
        self._facts[node] = self.of(node).meet(fact)

    def reason(self, node: Node) -> str | None:
        """The name of the rule that gives the fact of ``node``."""
        rule = self._rule(node)
        if node.op == "select" and self.of(node) != self.of(node.operands[1]).union(
            self.of(node.operands[2])
        ):
            return rulebook.OWN_CONDITION
        return None if rule is None else rule.name(node)

    def _rule(self, node: Node) -> _Rule | None:
        if node.op == "formal":
            formal = FORMAL.data(node)
            if formal in self._indices:
                return _FOLD_INDEX
            if formal in self._states:
                return None if self._assuming else _IN_TURN
        return _RULES.get(node.op)

    def in_turns(self, state: Formal, starts: Sequence[Fact]) -> Fact:
        """What holds of a loop's state in every turn, if the states start with so much."""
        loop = self._states[state]
        data = ITERATE.data(loop)
        states, nexts = data.variables[1:], loop.operands[-data.states :]
        starts = starts[: len(states)]

        def turn(facts: Sequence[Fact]) -> Sequence[Fact]:
            given = {
                self._leaves[formal]: fact
                for formal, fact in zip(states, facts, strict=True)
                if formal in self._leaves
            }
            inside = self.assuming(given)
            return [inside.of(following) for following in nexts]

        key = loop.id, tuple(starts)
        if key not in self._found:
            self._found[key] = invariants(starts, turn, data.bound)
        return self._found[key][states.index(state)]

    def bound_of(self, index: Formal) -> int:
        """How many values a fold's index takes at most."""
        return self._indices[index]


@frozen
class _Rule:
    """How the fact of an operation follows from those of what it needs."""

    name: Callable[[Node], str]
    derive: Callable[[Ranges, Node, Sequence[Fact]], Fact]


def _kind(node: Node) -> Kind:
    type_ = node.type
    while isinstance(type_, Array):
        type_ = type_.element
    return "matrix" if isinstance(type_, Matrix) else scalar_kind(type_) or "float"


def _union(facts: Sequence[Fact]) -> Fact:
    if not facts:
        return UNKNOWN
    result = facts[0]
    for fact in facts[1:]:
        result = result.union(fact)
    return result


def _constant(_ranges: Ranges, node: Node, _known: Sequence[Fact]) -> Fact:
    if isinstance(node.type, Matrix):
        return UNKNOWN
    data = CONSTANT.data(node)
    lanes = data if isinstance(data, tuple) else (data,)
    numbers = [float(lane) for lane in lanes if not isinstance(lane, tuple)]
    return Fact(min(numbers), max(numbers), nonzero=all(abs(n) >= 2.0**-126 for n in numbers))


def _parameter(_ranges: Ranges, node: Node, _known: Sequence[Fact]) -> Fact:
    return PARAMETER.data(node).fact


def _contract(node: Node) -> str:
    return rulebook.UNIT if PARAMETER.data(node).fact.unit else rulebook.DECLARED


def _call(ranges: Ranges, node: Node, known: Sequence[Fact]) -> Fact:
    same = len(node.operands) > 1 and len({operand.id for operand in node.operands}) == 1
    same = same and rulebook.SAME not in ranges.without
    return BUILTINS[CALL.data(node)].range(tuple(known), same)


def _joined(_ranges: Ranges, _node: Node, known: Sequence[Fact]) -> Fact:
    """A vector is as long as its longest part, at least."""
    joined = _union(known)
    longest = max(max(part.length, part.least) for part in known)
    return Fact(joined.lo, joined.hi, joined.excludes_zero, length=longest, kind=joined.kind)


def _elements(_ranges: Ranges, _node: Node, known: Sequence[Fact]) -> Fact:
    """What holds of each element."""
    return _union(known)


def _filled(_ranges: Ranges, _node: Node, known: Sequence[Fact]) -> Fact:
    (lane,) = known
    return Fact(lane.lo, lane.hi, lane.nonzero, length=lane.least, kind=lane.kind)


def _lanes(_ranges: Ranges, _node: Node, known: Sequence[Fact]) -> Fact:
    (whole,) = known
    return Fact(whole.lo, whole.hi, whole.nonzero, kind=whole.kind)


def _index(_ranges: Ranges, node: Node, known: Sequence[Fact]) -> Fact:
    whole = known[0]
    if isinstance(node.operands[0].type, Matrix):
        return UNKNOWN
    if isinstance(node.operands[0].type, Array):
        return whole
    return Fact(whole.lo, whole.hi, whole.nonzero, kind=whole.kind)


def _member(_ranges: Ranges, node: Node, known: Sequence[Fact]) -> Fact:
    """A member of a light of many, whose parameter carries a fact for each, or a loop's state."""
    source = node.operands[0]
    if source.op == "iterate":
        return _union(known)
    while source.op in ("index", "as"):
        source = source.operands[0]
    if isinstance(source.data, Parameter) and isinstance(node.operands[0].type, Struct):
        return dict(source.data.member_facts).get(MEMBER.data(node), UNKNOWN)
    return UNKNOWN


def _member_name(node: Node) -> str:
    return rulebook.STATE if node.operands[0].op == "iterate" else rulebook.MEMBER


def _ascribed(_ranges: Ranges, node: Node, known: Sequence[Fact]) -> Fact:
    """Only what has unit length is ever called a direction."""
    meaning = ASCRIBE.data(node)
    contract = meaning is not None and meaning.kind == "direction"
    return known[0].meet(UNIT) if contract else known[0]


def _select(ranges: Ranges, node: Node, known: Sequence[Fact]) -> Fact:
    """One of the sides, of which its own condition may tell something.

    ``if x < 0.01 then 0.01 else x`` is at least 0.01.
    """
    condition, then, otherwise = node.operands
    sides = [known[1], known[2]]
    if rulebook.OWN_CONDITION not in ranges.without:
        for i, (side, holds) in enumerate(((then, True), (otherwise, False))):
            if side.op != "constant":
                for told in refinements(ranges.so_far, condition, holds, ranges.without):
                    if told.about is side:
                        sides[i] = sides[i].meet(told.fact)
    return sides[0].union(sides[1])


def _cross(_ranges: Ranges, node: Node, known: Sequence[Fact]) -> Fact:
    """A mean of three vertices' values stays between them, but is no longer of unit length.

    Rounding may take it a little past either end.
    """
    (at_vertex,) = known
    if CROSS.data(node).mode == "flat":
        return at_vertex
    slack = 1e-5 * max(abs(at_vertex.lo), abs(at_vertex.hi))
    if slack == float("inf"):
        return Fact(0.0) if at_vertex.lo >= 0 else UNKNOWN
    return Fact(at_vertex.lo - slack if at_vertex.lo else 0.0, at_vertex.hi + slack)


def _fold(_ranges: Ranges, node: Node, known: Sequence[Fact]) -> Fact:
    data = FOLD.data(node)
    _count, start, body = known
    if data.operator == "min":
        return Fact(min(start.lo, body.lo), start.hi)
    if data.operator == "max":
        return Fact(start.lo, max(start.hi, body.hi))
    if data.operator in ("and", "or"):
        return UNKNOWN
    if data.operator == "add":
        lo = start.lo + min(0.0, body.lo * data.bound) if data.bound else start.lo
        hi = start.hi + max(0.0, body.hi * data.bound) if data.bound else start.hi
        # Each turn rounds once more.
        return outward(lo, hi, float(data.bound))
    return Fact(0.0) if start.lo >= 0 and body.lo >= 0 else UNKNOWN


def _fold_name(node: Node) -> str:
    return _FOLDS.get(FOLD.data(node).operator, rulebook.EXTREME)


_FOLDS = {"add": rulebook.SUM, "mul": rulebook.PRODUCT}


def _iterate(_ranges: Ranges, node: Node, known: Sequence[Fact]) -> Fact:
    """A state is what it was at the start, or what a turn has made of it."""
    return known[1].union(known[-1]) if ITERATE.data(node).states == 1 else UNKNOWN


def _start_and_next(loop: Node, name: str) -> tuple[Node, Node]:
    """What one of a loop's states is at first, and what a turn makes of it."""
    assert isinstance(loop.type, Struct)
    position = [member for member, _ in loop.type.members].index(name)
    return loop.operands[1 + position], loop.operands[position - ITERATE.data(loop).states]


def _in_turn(ranges: Ranges, node: Node, known: Sequence[Fact]) -> Fact:
    return ranges.in_turns(FORMAL.data(node), known)


def _fold_index(ranges: Ranges, node: Node, _known: Sequence[Fact]) -> Fact:
    return Fact(0.0, float(max(ranges.bound_of(FORMAL.data(node)) - 1, 0)))


def _any_argument(_ranges: Ranges, _node: Node, known: Sequence[Fact]) -> Fact:
    return _union(known)


def _apply(_ranges: Ranges, _node: Node, known: Sequence[Fact]) -> Fact:
    return known[0]


def _named(name: str, derive: Callable[[Ranges, Node, Sequence[Fact]], Fact]) -> _Rule:
    return _Rule(lambda _node: name, derive)


_FOLD_INDEX = _named(rulebook.INDEX, _fold_index)
_IN_TURN = _named(rulebook.IN_TURN, _in_turn)
_BUILTIN = _Rule(CALL.data, _call)
_RULES: Mapping[str, _Rule] = {
    "constant": _named(rulebook.CONSTANT, _constant),
    "parameter": _Rule(_contract, _parameter),
    "as": _named(rulebook.UNIT, _ascribed),
    "call": _BUILTIN,
    "native": _BUILTIN,
    "vector": _named(rulebook.JOINED, _joined),
    "splat": _named(rulebook.FILLED, _filled),
    "swizzle": _named(rulebook.PICKED, _lanes),
    "index": _named(rulebook.ELEMENT, _index),
    "member": _Rule(_member_name, _member),
    "select": _named(rulebook.EITHER, _select),
    "cross": _named(rulebook.INTERPOLATED, _cross),
    "fold": _Rule(_fold_name, _fold),
    "iterate": _named(rulebook.STATE, _iterate),
    "array": _named(rulebook.ELEMENTS, _elements),
    "formal": _named(rulebook.ARGUMENT, _any_argument),
    "apply": _named(rulebook.BODY, _apply),
    "called": _named(rulebook.BODY, _apply),
}

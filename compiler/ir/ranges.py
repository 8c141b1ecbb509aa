"""Range analysis: derives facts about every value from declared ranges and the builtins' rules.

Semantics, most passes and ``legalise`` ask a ``Ranges`` for the fact of a node. The rules are in
``range_rules.py``. The analysis keeps facts, but not how it found them: ``proofs.py`` derives that
again for the few facts that a person wants to have explained.
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Iterable, Mapping, MutableMapping, Sequence
from functools import lru_cache

from ...stdlib.builtins.facts import UNKNOWN, Fact, Kind
from . import rulebook
from .build import in_body
from .invariants import invariants, parts_of
from .node import Formal, Node, Op, formals_of, reachable
from .operations import FOLD, FORMAL, ITERATE, MEMBER
from .range_rules import FOLD_INDEX, IN_TURN, RULES, RangeRule
from .types import Array, Matrix, RuntimeArray, Struct, Type, scalar_kind

_NEEDING: frozenset[Op] = frozenset({"formal", "member"})
"""Operations whose facts are derived from those of other values than their operands."""


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
        """The number of values that the index of a fold takes."""
        self._states: dict[Formal, Node] = {}
        """The loop that a state belongs to."""
        self._leaves: dict[Formal, Node] = {}
        """The leaf that a variable is in the graph."""
        self._needed: dict[int, Sequence[Node]] = {}
        """The values that have to be known before the states of a loop, by its id."""
        self._found: dict[tuple[int, tuple[Fact, ...]], Sequence[Fact]] = {}
        """The facts of a loop's states, by its id and the facts of the initial states."""
        self._assuming = False
        """True while facts of states are assumed: no facts of other loops' states are derived."""
        self.note_binders(roots)

    def note_binders(self, roots: Iterable[Node]) -> None:
        """Learns the binders of the formals under ``roots``."""
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
        """The fact of ``node``."""
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
            needs = top.operands if top.op not in _NEEDING else self.needs(top)
            begun.add(top)
            # An argument of a function may come from the same function, before a loop and in its
            # iterations: of a value that needs itself nothing is known on the way round.
            missing = [need for need in needs if need not in facts and need not in begun]
            if missing:
                pending += missing
                continue
            pending.pop()
            found = [facts.get(need) or self.so_far(need) for need in needs]
            facts[top] = self.derived(top, tuple(found))
        return facts[node]

    def so_far(self, node: Node) -> Fact:
        """The fact of a value so far, while another is derived that needs it, maybe in a circle."""
        known = self._facts.get(node)
        return UNKNOWN.as_kind(_kind(node.type)) if known is None else known

    def assuming(self, facts: Mapping[Node, Fact]) -> Ranges:
        """A copy of the knowledge with further facts assumed; facts that follow are not kept."""
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
        inside = in_body(node) if node.op == "member" else None
        return node.operands if inside is None else (inside,)

    def _needs_of_state(self, loop: Node) -> Sequence[Node]:
        """The initial states, and the values that are the same in every iteration."""
        if loop.id not in self._needed:
            own, states = frozenset(formals_of(loop)), ITERATE.data(loop).states
            around = frozenset((*self._states, *self._indices)) - own
            fixed = parts_of(loop.operands[-states:], around)
            self._needed[loop.id] = (*loop.operands[1 : 1 + states], *fixed)
        return self._needed[loop.id]

    def derived(self, node: Node, known: Sequence[Fact]) -> Fact:
        """The fact of ``node`` that follows from ``known``, the facts of the values it needs."""
        rule = self._rule(node) if node.op == "formal" else RULES.get(node.op)
        fact = UNKNOWN
        if rule is not None and not (self.without and rule.name(node) in self.without):
            fact = rule.derive(self, node, known)
        return fact.as_kind(_kind(node.type))

    def assume(self, node: Node, fact: Fact) -> None:
        """Adds a fact of a node's value that does not follow from its operands."""
        self._facts[node] = self.of(node).meet(fact)

    def assume_counting(self, node: Node, bound: int) -> None:
        """``node`` counts from 0, and stays below ``bound``."""
        self.assume(node, Fact(0.0, float(bound - 1), kind="int"))

    def reason(self, node: Node) -> str | None:
        """The name of the rule that gives the fact of ``node``."""
        rule = self._rule(node)
        if node.op == "select" and self.of(node) != self.of(node.operands[1]).union(
            self.of(node.operands[2])
        ):
            return rulebook.OWN_CONDITION
        return None if rule is None else rule.name(node)

    def _rule(self, node: Node) -> RangeRule | None:
        if node.op == "formal":
            formal = FORMAL.data(node)
            if formal in self._indices:
                return FOLD_INDEX
            if formal in self._states:
                return None if self._assuming else IN_TURN
        return RULES.get(node.op)

    def in_turns(self, state: Formal, starts: Sequence[Fact]) -> Fact:
        """The fact of a loop's state in every iteration, for ``starts`` of the initial states."""
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

    def is_in_turn(self, node: Node) -> bool:
        """True if a value depends on a state of a loop around it."""
        return not node.variables.isdisjoint(self._states)

    def bound_of(self, index: Formal) -> int:
        """The largest number of values that a fold's index takes."""
        return self._indices[index]


@lru_cache(maxsize=1024)
def _kind(type_: Type) -> Kind:
    while isinstance(type_, Array | RuntimeArray):
        type_ = type_.element
    return "matrix" if isinstance(type_, Matrix) else scalar_kind(type_) or "float"


def _start_and_next(loop: Node, name: str) -> tuple[Node, Node]:
    """The initial value of one of a loop's states, and its value after an iteration."""
    assert isinstance(loop.type, Struct)
    position = [member for member, _ in loop.type.members].index(name)
    return loop.operands[1 + position], loop.operands[position - ITERATE.data(loop).states]

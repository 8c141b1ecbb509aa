"""Inlines a function's body if it is used once, or if calling it would cost more than executing it.

The pass decides this call by call, because constant arguments may leave little of a body. A body
that depends on parameters only is inlined too: only then can ``hoist`` move it to the host.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable

from ..ir.node import Formal, Graph, Node, Roots, formals_of
from ..ir.shader import Notes
from .call_prices import CallPrices
from .simplify import Simplifier

_Place = tuple[Node, bool]
"""A node, and whether it is wanted in its simplest form."""


def inline(graph: Graph, roots: Roots, notes: Notes, simplifier: Simplifier) -> Roots:
    """The roots with applies of bodies that are used once, or hardly used, as the bodies.

    A call in a body that is written out may then have other arguments, such as constants, so it is
    decided again.
    """
    before = None
    while roots is not before and "apply" in roots.ops:
        before, roots = roots, _inlined(graph, roots, notes, simplifier)
    return roots


def _inlined(graph: Graph, roots: Roots, notes: Notes, simplifier: Simplifier) -> Roots:
    """The roots with all calls decided that they have now."""
    applies = [node for node in roots.nodes if node.op == "apply"]
    uses = Counter(node.operands[0] for node in applies)
    prices = CallPrices(simplifier)
    calls = [a for a in applies if uses[a.operands[0]] > 1 and prices.is_worth_calling(a)]
    worthwhile = Counter(node.operands[0] for node in calls)
    kept = {node for node in calls if worthwhile[node.operands[0]] > 1}
    if len(kept) == len(applies):
        return roots
    inlined = [node for node in applies if node not in kept]
    once = _called_once(applies, uses)
    inlining = _Inlining(graph, notes, simplifier, inlined, uses.keys(), once)
    return inlining.roots(roots)


def _called_once(applies: Iterable[Node], uses: Counter[Node]) -> frozenset[Node]:
    """The bodies that are called once, and whose variables are those of no other body."""
    owners: dict[Formal, Node] = {}
    shared: set[Node] = set()
    for node in applies:
        body = node.operands[0]
        for formal in formals_of(node):
            if (owner := owners.setdefault(formal, body)) is not body:
                shared |= {owner, body}
    return frozenset(body for body, count in uses.items() if count == 1 and body not in shared)


def _age(place: _Place) -> int:
    return place[0].id


class _Inlining:
    """Rebuilds a graph with some calls written out.

    A body that is called once is not copied: its variables get their values before it is walked
    over. So each node is rebuilt once, however deeply such calls are nested.
    """

    def __init__(
        self,
        graph: Graph,
        notes: Notes,
        simplifier: Simplifier,
        inlined: Collection[Node],
        bodies: Collection[Node],
        once: Collection[Node],
    ) -> None:
        self._graph = graph
        self._notes = notes
        self._simplifier = simplifier
        self._inlined = frozenset(inlined)
        self._bodies = bodies
        self._once = once
        self._bound = frozenset(
            formal for call in inlined if call.operands[0] in once for formal in formals_of(call)
        )
        self._values: dict[Formal, Node] = {}
        """The values of the variables of bodies that are called once."""
        self._concerned: set[Node] = set()
        """Calls that are written out, and all that needs them."""
        self._done: tuple[dict[Node, Node], dict[Node, Node]] = ({}, {})
        """The rebuilt nodes: as they are, and in their simplest form."""

    def roots(self, roots: Roots) -> Roots:
        """The roots, rebuilt."""
        for node in roots.nodes:
            if node in self._inlined or not self._concerned.isdisjoint(node.operands):
                self._concerned.add(node)
        # The oldest come first, so that a value that is written out twice is noted as the first.
        for node in roots.nodes:
            if node in self._concerned and node.variables.isdisjoint(self._bound):
                self._rebuild(node)
        done = self._done[False]
        return Roots(map(done.get, roots, roots))

    def _rebuild(self, root: Node) -> None:
        pending: list[_Place] = [(root, False)]
        while pending:
            node, simplest = place = pending[-1]
            done = self._done[simplest]
            if node in done:
                pending.pop()
            elif self._stays(node, simplest):
                done[node] = node
            elif missing := [p for p in self._needs(place) if p[0] not in self._done[p[1]]]:
                pending += sorted(missing, key=_age, reverse=True)
            else:
                done[node] = made = self._made(node, simplest)
                if made is not node:
                    self._notes.follow(node, made)

    def _stays(self, node: Node, simplest: bool) -> bool:
        """True if a node needs no change."""
        if node in self._concerned:
            return False
        if not simplest:
            return True
        return self._simplifier.is_simplest(node) and node.variables.isdisjoint(self._bound)

    def _needs(self, place: _Place) -> list[_Place]:
        """The nodes that have to be rebuilt before this one can be."""
        node, simplest = place
        if node not in self._inlined or node.operands[0] not in self._once:
            return [(operand, simplest) for operand in node.operands]
        body, *arguments = node.operands
        done = self._done[True]
        if not all(argument in done for argument in arguments):
            return [(argument, True) for argument in arguments]
        for formal, argument in zip(formals_of(node), arguments, strict=True):
            self._values[formal] = done[argument]
        return [(body, True)]

    def _made(self, node: Node, simplest: bool) -> Node:
        """The new form of a node, once all that it needs has been rebuilt."""
        if node in self._inlined:
            return self._written_out(node, simplest)
        if isinstance(node.data, Formal):
            return self._values.get(node.data, node)
        done = self._done[simplest]
        operands = tuple([done[operand] for operand in node.operands])
        # Where a call turned out to be constant, its users may be, too. No backend has to take the
        # derivative of a constant, for instance.
        if simplest or any(map(_is_constant_now, node.operands, operands)):
            return self._simplifier.rule(self._graph, node, operands)
        return self._graph.node(node.op, node.type, operands, node.data)

    def _written_out(self, call: Node, simplest: bool) -> Node:
        """The value of a call."""
        body = call.operands[0]
        if body in self._once:
            written = self._done[True][body]
        else:
            rebuilt, *arguments = (self._done[simplest][operand] for operand in call.operands)
            values = dict(zip(formals_of(call), arguments, strict=True))
            written = self._simplifier.substituted(rebuilt, values)
        # The part that a light adds keeps the names of its terms, which describe it.
        if written not in self._bodies and body.id not in self._notes.terms:
            self._notes.forget_function(written)
        return written


def _is_constant_now(before: Node, now: Node) -> bool:
    return now is not before and now.op == "constant"

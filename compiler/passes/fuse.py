"""Fuses sums over the same lights into one loop that calls one function for each light.

``Σ f(light) + Σ g(light)`` equals ``Σ (f + g)(light)``, so ``matt(…) + shiny(…)`` loops over the
rig only once. In the graph, two applies in one sum that share an argument become an apply of the
sum of their bodies, and two folds with the same count become a fold of the sum of their bodies.
This reorders additions, which is allowed: addition of real numbers is associative.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence

from ..ir import build
from ..ir.binding import substitute
from ..ir.node import Formal, Formals, Graph, Node, Op, Roots, formals_of
from ..ir.operations import FOLD
from ..ir.rewrite import rewrite
from ..ir.shader import Notes
from .simplify import Simplifier

SUMMED: frozenset[Op] = frozenset({"fold", "apply"})
"""The operations that give the contribution of a light (``apply``), or of many (``fold``)."""


def fuse(graph: Graph, roots: Roots, notes: Notes, simplifier: Simplifier) -> Roots:
    """The roots with the sums in them fused."""
    if SUMMED.isdisjoint(roots.ops):
        return roots
    fusing = _Fusing(graph, notes, simplifier, _inner_sums(roots))
    return rewrite(graph, roots, fusing.rule, notes.follow, ("call",))


def _is_sum(node: Node) -> bool:
    return node.op == "call" and node.data == "add"


def _inner_sums(roots: Roots) -> set[int]:
    """Sums that are part of one other sum and nothing else: their terms are gathered there."""
    users: dict[int, int] = {root.id: 2 for root in roots}
    inner: set[int] = set()
    for node in roots.nodes:
        for operand in node.operands:
            users[operand.id] = users.get(operand.id, 0) + 1
            if _is_sum(node) and _is_sum(operand) and operand.type == node.type:
                inner.add(operand.id)
    return {id_ for id_ in inner if users[id_] == 1}


class _Fusing:
    def __init__(self, graph: Graph, notes: Notes, simplifier: Simplifier, inner: set[int]) -> None:
        self._graph = graph
        self._notes = notes
        self._simplifier = simplifier
        self._inner = inner
        self._open: set[int] = set()
        """Inner sums as rebuilt. Only these are taken apart; a shared sum is one term."""
        self._merged: dict[tuple[object, ...], tuple[Node, Formals]] = {}

    def rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        """Fuse a sum that is not part of a larger one."""
        if not _is_sum(node):
            return None
        rebuilt = graph.node(node.op, node.type, operands, node.data)
        if node.id in self._inner:
            self._open.add(rebuilt.id)
            return rebuilt
        return self._sum(rebuilt)

    def _sum(self, root: Node) -> Node:
        terms = self._terms(root)
        if sum(term.op in SUMMED for term in terms) < 2:
            return root
        groups: list[Node] = []
        meeting: dict[Hashable, dict[int, None]] = {}
        """The groups, by the keys that a term may have in common with them."""
        for term in terms:
            common = self._common(term)
            near = {position for key in common for position in meeting.get(key, ())}
            position = next((i for i in sorted(near) if self._fusable(groups[i], term)), None)
            if position is None:
                position = len(groups)
                groups.append(term)
            else:
                groups[position] = self._fused(groups[position], term)
            for key in common:
                meeting.setdefault(key, {})[position] = None
        total = groups[0]
        for group in groups[1:]:
            total = self._simplifier.call("add", root.type, total, group)
        return total

    def _terms(self, root: Node) -> list[Node]:
        """The terms of a sum, left to right."""
        terms: list[Node] = []
        pending = list(reversed(root.operands)) if _is_sum(root) else [root]
        while pending:
            node = pending.pop()
            if node.id in self._open and all(o.type == root.type for o in node.operands):
                pending.extend(reversed(node.operands))
            else:
                terms.append(node)
        return terms

    def _common(self, term: Node) -> Sequence[Hashable]:
        """The keys of a term. Two terms can be fused only if they have one of these in common.

        Sums have the same number of iterations and the same start. Terms of lights share an
        argument.
        """
        if term.op == "fold":
            data = FOLD.data(term)
            summed = data.operator == "add"
            return ((term.type, data.bound, *term.operands[:2]),) if summed else ()
        if term.op != "apply" or term.operands[0].id not in self._notes.terms:
            return ()
        return [argument for argument in term.operands[1:] if argument.op != "constant"]

    def _fusable(self, group: Node, term: Node) -> bool:
        """True if a group can be fused with a term with which it has a key in common."""
        same = term.op == "apply" and group.operands[0] is term.operands[0]
        return group.op == term.op and group.type == term.type and not same

    def _fused(self, left: Node, right: Node) -> Node:
        return self._folds(left, right) if left.op == "fold" else self._applies(left, right)

    def _folds(self, left: Node, right: Node) -> Node:
        count, start, body = left.operands
        index = self._graph.node("formal", count.type, (), FOLD.data(left).index)
        theirs = {FOLD.data(right).index: index}
        other = substitute(self._graph, right.operands[2], theirs, self._notes.follow)
        self._open.update(part.id for part in (body, other) if _is_sum(part))
        joined = self._sum(self._graph.node("call", left.type, (body, other), "add"))
        return self._graph.node("fold", left.type, (count, start, joined), left.data)

    def _applies(self, left: Node, right: Node) -> Node:
        arguments = list(left.operands[1:])
        for argument in right.operands[1:]:
            if argument not in arguments:
                arguments.append(argument)
        places = tuple(arguments.index(argument) for argument in right.operands[1:])
        body, formals = self._bodies(left, right, places)
        return build.apply(self._graph, body, tuple(arguments), formals)

    def _bodies(self, left: Node, right: Node, places: tuple[int, ...]) -> tuple[Node, Formals]:
        """The sum of two bodies; the same two bodies with the same sharing are one body."""
        key = (left.operands[0].id, right.operands[0].id, places)
        if key not in self._merged:
            self._merged[key] = self._new_body(left, right, places)
        return self._merged[key]

    def _new_body(self, left: Node, right: Node, places: tuple[int, ...]) -> tuple[Node, Formals]:
        formals, theirs = formals_of(left), formals_of(right)
        replacements = {}
        for formal, place, argument in zip(theirs, places, right.operands[1:], strict=True):
            if place == len(formals):
                # The same body may be in the sum already, with this variable for another argument.
                formals += (Formal(formal.name) if formal in formals else formal,)
            replacements[formal] = self._graph.node("formal", argument.type, (), formals[place])
        other = substitute(self._graph, right.operands[0], replacements, self._notes.follow)
        body = self._simplifier.call("add", left.type, left.operands[0], other)
        names = [self._notes.functions.get(part.operands[0].id, "") for part in (left, right)]
        name = "_".join(filter(None, names)) or "shade"
        self._notes.functions.setdefault(body.id, name)
        self._notes.terms.setdefault(body.id, name)
        return body, formals

"""Simplifies values exactly, while nodes are built.

Passes build their nodes through ``Simplifier.make``, a smart constructor, so that a rule sees what
earlier rules have simplified. The rules are rows of ``rules/table.py``; each keeps the value for
all operands. A value that no rule simplifies may still be a constant, by its range
(``known_values.py``).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterable, Mapping
from operator import attrgetter

from ..diagnostics.source import Span
from ..ir.node import AGE, HEADS, Formal, Graph, Node, Op, Roots
from ..ir.operations import FORMAL
from ..ir.ranges import Ranges
from ..ir.rewrite import rewrite
from ..ir.shader import Notes
from ..ir.types import Type
from .known_values import as_constant
from .path_conditions import PathRefinement
from .remarks import Outcome, Remark
from .rules.builder import Builder
from .rules.table import rule_table

_HEAD: Callable[[Node], Hashable] = attrgetter("head")


class Simplifier(Builder):
    """Builds nodes in their simplest form."""

    def __init__(self, graph: Graph, ranges: Ranges, notes: Notes) -> None:
        super().__init__(graph, ranges, notes)
        self._candidates = rule_table(ranges.without).candidates
        self.at: Span | None = None
        """The source of the node that is being built."""
        self.expanding = 0
        """The number of expansions around the current node."""
        self.remarks: dict[Hashable, Remark] = {}
        self._simplest: set[Node] = set()
        """Nodes that were built here: they are in simplest form, with all that they need."""
        self._arguments: dict[Node, Node] = {}
        """The simplest forms of arguments and of all nodes below them: many share most of these."""

    def remark(
        self,
        builtin: str,
        operands: tuple[Node, ...],
        outcome: Outcome,
        conditions: tuple[PathRefinement, ...] = (),
        rule: str = "",
    ) -> None:
        """Remembers the decision about a builtin of a user's text."""
        if not self.expanding:
            key = builtin, operands, outcome
            if key not in self.remarks:
                remark = Remark(builtin, operands, self.at, outcome, conditions, rule)
                self.remarks[key] = remark

    def simplified(self, roots: Roots) -> Roots:
        """The roots in their simplest form; nodes in this form already are not looked at."""
        nodes = self._affected(roots, frozenset()) if self._simplest else None
        return rewrite(self.graph, roots, self.rule, self.notes.follow, nodes=nodes)

    def rule(self, _graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node:
        """The simplest form of an operation, for ``rewrite``."""
        self.at = self.notes.spans.get(node.id, self.at)
        if operands is node.operands:
            return self.again(node) if operands else self._or_constant(node)
        return self.make(node.op, node.type, operands, node.data)

    def again(self, node: Node) -> Node:
        """The simplest node with the value of one that is there already."""
        found = self.replacement(node.op, node.type, node.operands, node.data)
        found = found or self._or_constant(node)
        self._simplest.add(found)
        return found

    def _or_constant(self, node: Node) -> Node:
        """A node, or the only number that its value can be."""
        return as_constant(self.graph, self.ranges, node) or node

    def make(
        self, op: Op, type_: Type, operands: tuple[Node, ...] = (), data: Hashable = None
    ) -> Node:
        """The simplest node with the value of this operation."""
        found = self.replacement(op, type_, operands, data)
        if found is None:
            found = self._or_constant(self.graph.node(op, type_, operands, data))
        self._simplest.add(found)
        return found

    def replacement(
        self, op: Op, type_: Type, operands: tuple[Node, ...], data: Hashable
    ) -> Node | None:
        """A simpler node with the value of an operation; ``None`` if no rule knows one."""
        head = HEADS.get(op, data)
        for rule, apply in self._candidates((head, *map(_HEAD, operands))):
            found = apply(self, op, type_, operands, data)
            if found is not None:
                if rule.drops:
                    self.remark(str(data), operands, "dropped", rule=rule.name)
                return found
        return None

    def substituted(self, body: Node, replacements: Mapping[Formal, Node]) -> Node:
        """``body`` with formals replaced; all that changes is built in its simplest form."""
        used = [formal for formal in replacements if formal in body.variables]
        if not used:
            return body
        arguments = Roots([replacements[formal] for formal in used])
        simplest = dict(zip(used, self._simplified_arguments(arguments), strict=True))

        def rule(graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
            if node.op == "formal":
                return simplest.get(FORMAL.data(node))
            return self.rule(graph, node, operands)

        nodes = self._affected((body,), frozenset(used))
        (simplified,) = rewrite(self.graph, (body,), rule, self.notes.follow, nodes=nodes)
        return simplified

    def _simplified_arguments(self, arguments: Roots) -> Roots:
        """Simplifies arguments, and looks at no node again that an earlier argument needed."""
        known = self._arguments
        nodes = self._affected(arguments, frozenset(), known)
        return rewrite(self.graph, arguments, self.rule, self.notes.follow, nodes=nodes, new=known)

    def is_simplest(self, node: Node) -> bool:
        """True if a node is known to be in its simplest form, with all that it needs."""
        return node in self._simplest or not node.operands

    def _affected(
        self, roots: Iterable[Node], formals: frozenset[Formal], known: Collection[Node] = ()
    ) -> list[Node]:
        """The nodes below ``roots`` that are not in their simplest form, or depend on ``formals``.

        A ``known`` node is left out, with all nodes below it.
        """
        simplest = self._simplest
        seen = set(roots).difference(known)
        pending = list(seen)
        found: list[Node] = []
        for node in pending:  # The list grows on the way.
            if node in simplest and (not formals or node.variables.isdisjoint(formals)):
                continue
            found.append(node)
            for operand in node.operands:
                if operand not in seen and operand not in known:
                    seen.add(operand)
                    pending.append(operand)
        found.sort(key=AGE)
        return found

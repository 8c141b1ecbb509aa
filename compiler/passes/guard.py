"""Replaces calls of builtins by hardware operations, and adds guards where these are not safe.

Where range analysis proves that the operands lie where all backends agree (the ``domain`` of the
builtin's row), the hardware's own operation computes the value. Elsewhere the builtin's expansion
does, whose parts are treated in the same way. Each guard that had to stay is recorded as a
``Guard``, which ``burnish graph`` shows to the user.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping

from ...stdlib.builtins import BUILTINS, Builtin
from ...stdlib.builtins.facts import Fact
from ...stdlib.builtins.row import Domain
from ...support.frozen import fresh, frozen, record
from ..diagnostics.source import Span
from ..ir.node import Graph, Node, Op
from ..ir.operations import BRANCH, CALL
from ..ir.ranges import Ranges
from ..ir.shader import Notes
from ..ir.types import Type
from .expand_builtins import Expanding
from .path_conditions import PathConditions, PathRefinement
from .remarks import Outcome, Remark


@frozen
class Guard:
    """A builtin that keeps its guard, and the known facts of its operands."""

    builtin: str
    facts: tuple[Fact, ...]
    span: Span | None
    by_profile: bool = False
    """True if there are languages that need no guard here."""

    @property
    def reason(self) -> str:
        """The reason why the guard is needed, in words."""
        known = ", ".join(_interval(fact) for fact in self.facts)
        return f"operands in {known}; {BUILTINS[self.builtin].outside}"


def _interval(fact: Fact) -> str:
    return f"[{fact.lo:g}, {fact.hi:g}]"


@record
class Decisions:
    """The decisions about guards in several parts of a program."""

    kept: dict[int, Guard] = fresh(factory=dict)
    """The guards that stay, by the id of the ``call`` that was expanded."""
    remarks: dict[Hashable, Remark] = fresh(factory=dict)
    undecided: bool = False
    """True if any call was left to the profiles."""

    def add(self, guarding: Guarding) -> None:
        """Takes over the decisions about one part."""
        self.kept.update(guarding.kept)
        self.remarks.update(guarding.remarks)
        self.undecided = self.undecided or guarding.undecided


class Guarding(Expanding):
    """Builds nodes in hardware operations: natives and expansions.

    The only calls that stay are those that some language may do without a guard; a profile decides
    about them, with the ``domains`` in which its own operations have the builtins' meaning.
    """

    def __init__(
        self,
        graph: Graph,
        ranges: Ranges,
        notes: Notes,
        paths: PathConditions,
        domains: Mapping[str, Domain] | None = None,
    ) -> None:
        """Without ``domains`` nothing is known of the profile."""
        super().__init__(graph, ranges, notes)
        self._paths = paths
        self._domains = domains
        self.undecided = False
        """True if any call was left to the profiles."""
        self._branches: set[int] = set()
        self.kept: dict[int, Guard] = {}
        """The guards that stay, by the id of the ``call`` that was expanded."""
        self._asked: Node | None = None
        """The node that is being replaced, with its operands as they were."""

    def remark(
        self,
        builtin: str,
        operands: tuple[Node, ...],
        outcome: Outcome,
        conditions: tuple[PathRefinement, ...] = (),
        rule: str = "",
    ) -> None:
        """Makes a remark as in any simplifier, but not about parts of expansions.

        A part that is left away by now was part of an expansion. Nobody has to hear of a builtin
        that is expanded whatever is known of its operands.
        """
        if outcome != "dropped" and BUILTINS[builtin].needs:
            super().remark(builtin, operands, outcome, conditions, rule)

    def rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node:
        """Simplifies a node by the facts that are known on the path to it, for ``rewrite``.

        A guard that stays is put down to the source of ``node``.
        """
        if node.id in self._branches:
            return self.make("select", node.type, operands, BRANCH)
        if node.op == "call" and BUILTINS[CALL.data(node)].expansion and self._is_safe(node):
            return self._unguarded(node, operands)
        self._asked = node
        return super().rule(graph, node, operands)

    def _unguarded(self, node: Node, operands: tuple[Node, ...]) -> Node:
        """A call that needs no guard, simplified, as its operands may be constants by now.

        ``make`` would simplify it as well, but then expand it.
        """
        simplest = self.replacement("call", node.type, operands, node.data)
        if simplest is None:
            return self._native(node.type, operands, node.data)
        self._simplest.add(simplest)
        return simplest

    def _is_safe(self, node: Node) -> bool:
        """True if ranges or conditions around ``node`` prove it harmless.

        Its operands may have been expanded by now. They are the same values, of which more is known
        in the form that they had before.
        """
        row = BUILTINS[CALL.data(node)]
        self.at = self.notes.spans.get(node.id, self.at)
        if row.domain(tuple(map(self.ranges.of, node.operands))):
            self.remark(row.name, node.operands, "native")
            return True
        known = [self._paths.known(node, operand) for operand in node.operands]
        if not row.domain(tuple(more.fact for more in known)):
            return False
        # Facts behind a condition help only where its select becomes a branch.
        self._branches.update(select.id for more in known for select in more.selects)
        conditions = tuple(one for more in known for one in more.conditions)
        self.remark(row.name, node.operands, "native", conditions)
        return True

    def make(
        self, op: Op, type_: Type, operands: tuple[Node, ...] = (), data: Hashable = None
    ) -> Node:
        """The simplest node with this value, in hardware operations."""
        if op != "call":
            return self._without_call(super().make(op, type_, operands, data))
        found = self.replacement(op, type_, operands, data)
        if found is None:
            if not BUILTINS[str(data)].expansion:
                return self._native(type_, operands, data)
            found = self.graph.node(op, type_, operands, data)
        self._simplest.add(found)
        return self._without_call(found)

    def again(self, node: Node) -> Node:
        """The simplest node with the value of one that is there already."""
        return self.make(node.op, node.type, node.operands, node.data)

    def _without_call(self, node: Node) -> Node:
        """The value of a node in its simplest form, where it is a call, without the call."""
        if node.op != "call":
            return node
        row = BUILTINS[CALL.data(node)]
        if not row.expansion:
            return self._native(node.type, node.operands, node.data)
        facts = tuple(map(self.ranges.of, node.operands))
        domain = row.domain if self._domains is None else self._domains.get(row.name, row.domain)
        if domain(facts):
            self.remark(row.name, node.operands, "native")
            return self._native(node.type, node.operands, node.data)
        by_profile = self._is_by_profile(row, node, facts)
        if node.id not in self.expanded and node.id not in self.kept:
            self._keep(node, row, by_profile)
        if by_profile:
            self.undecided = True
            return node
        return self.expansion(node)

    def _native(self, type_: Type, operands: tuple[Node, ...], builtin: Hashable) -> Node:
        native = self.graph.node("native", type_, operands, builtin)
        self._simplest.add(native)
        return native

    def _is_by_profile(self, row: Builtin, node: Node, facts: tuple[Fact, ...]) -> bool:
        """True if a profile has to decide about a call.

        The condition is about the last operand, a divisor or an amount. Where that is constant over
        the draw, so is its guard, which leaves the shader and costs no language anything.
        """
        open_ = self._domains is None and row.by_profile(facts)
        return open_ and node.operands[-1] not in self._constant

    def _keep(self, node: Node, row: Builtin, by_profile: bool) -> None:
        """Remembers that a guard stays, and the known facts of the operands."""
        asked = self._asked
        operands = node.operands
        if not self.expanding and asked is not None and asked.data == node.data:
            operands = asked.operands
        self.remark(row.name, operands, "guarded")
        if row.needs:
            facts = tuple(map(self.ranges.of, operands))
            self.kept[node.id] = Guard(row.name, facts, self.at, by_profile)

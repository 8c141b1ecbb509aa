"""From Burnish's meaning to hardware operations.

Where range analysis proves that a builtin's operands lie where all backends agree, the hardware's
own operation is used; elsewhere the builtin's expansion, whose parts are treated the same way. What
could not be proven is kept for the reader as a ``Guard``.
"""

from __future__ import annotations

from collections.abc import Hashable

from ...frozen import frozen
from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.facts import Fact
from ..diagnostics.source import Span
from ..ir.node import Graph, Node, Op
from ..ir.types import Type
from ..semantics.shader import Notes
from .expanding import Expanding
from .paths import Paths
from .ranges import Ranges

BRANCH = "branch"
"""Data of a select that has to become a branch: one of its sides is safe only behind it."""


@frozen
class Guard:
    """A builtin that keeps its guard, and what was known of its operands."""

    builtin: str
    facts: tuple[Fact, ...]
    span: Span | None

    @property
    def reason(self) -> str:
        """Why the guard is needed, in words."""
        known = ", ".join(_interval(fact) for fact in self.facts)
        return f"operands in {known}; {BUILTINS[self.builtin].outside}"


def _interval(fact: Fact) -> str:
    return f"[{fact.lo:g}, {fact.hi:g}]"


class Guarding(Expanding):
    """Builds nodes without any ``call``: natives and expansions."""

    def __init__(self, graph: Graph, ranges: Ranges, notes: Notes, paths: Paths) -> None:
        super().__init__(graph, ranges, notes)
        self._paths = paths
        self._branches: set[int] = set()
        self.kept: dict[int, Guard] = {}
        """By the id of the ``call`` that was expanded."""

    def rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node:
        """As ``Simplifier.rule``, with what is known on the path to ``node``.

        A guard that stays is put down to the source of ``node``.
        """
        if node.id in self._branches:
            return self.make("select", node.type, operands, BRANCH)
        if node.op == "call" and self._safe_on_path(node, operands):
            return self.graph.node("native", node.type, operands, node.data)
        return super().rule(graph, node, operands)

    def _safe_on_path(self, node: Node, operands: tuple[Node, ...]) -> bool:
        """Whether conditions prove what ranges alone do not; their selects then have to branch."""
        row = BUILTINS[str(node.data)]
        plain = tuple(self.ranges.of(operand) for operand in operands)
        if not row.expansion or row.domain(plain):
            return False
        known = [self._paths.known(node, operand) for operand in node.operands]
        facts = tuple(fact.meet(more.fact) for fact, more in zip(plain, known, strict=True))
        if not row.domain(facts):
            return False
        self._branches.update(select.id for more in known for select in more.selects)
        told = tuple(one for more in known for one in more.told)
        self.at = self.notes.spans.get(node.id, self.at)
        self.judge(row.name, node.operands, "native", told)
        return True

    def make(
        self, op: Op, type_: Type, operands: tuple[Node, ...] = (), data: Hashable = None
    ) -> Node:
        """The simplest node with this value, in hardware operations."""
        node = super().make(op, type_, operands, data)
        if node.op != "call":
            return node
        row = BUILTINS[str(node.data)]
        if not row.expansion:
            return self.graph.node("native", node.type, node.operands, node.data)
        facts = tuple(self.ranges.of(operand) for operand in node.operands)
        if row.domain(facts):
            self.judge(row.name, node.operands, "native")
            return self.graph.node("native", node.type, node.operands, node.data)
        if node.id not in self.expanded:
            self.judge(row.name, node.operands, "guarded")
            if row.outside:
                self.kept[node.id] = Guard(row.name, facts, self.at)
        return self.expansion(node)

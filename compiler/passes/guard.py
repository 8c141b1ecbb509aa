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
from ..ir.node import Formal, Formals, Graph, Node, Op
from ..ir.ranges import Ranges
from ..ir.types import Scalar, Texture, Type, Vector, scalar_kind, width, with_width
from ..semantics.shader import Notes
from .expand import Template, template
from .paths import Paths
from .simplify import Simplifier

BRANCH = "branch"
"""Data of a select that has to become a branch: one of its sides is safe only behind it."""


VARYING = frozenset({"interpolate", "attribute", "formal", "input", "resource"})
"""What may differ between the vertices or pixels of a draw."""

OUTLINED = 3
"""Expansions of at least so many operations become functions where they are used repeatedly."""


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


class Guarding(Simplifier):
    """Builds nodes without any ``call``: natives and expansions."""

    def __init__(self, graph: Graph, ranges: Ranges, notes: Notes, paths: Paths) -> None:
        super().__init__(graph, ranges, notes)
        self._paths = paths
        self._branches: set[int] = set()
        self.kept: dict[int, Guard] = {}
        """By the id of the ``call`` that was expanded."""
        self._at: Span | None = None
        self._expanded: dict[int, Node] = {}
        self._varying: dict[int, bool] = {}
        self._functions: dict[tuple[Template, tuple[Type | Node, ...]], tuple[Node, Formals]] = {}

    def rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node:
        """As ``Simplifier.rule``, with what is known on the path to ``node``.

        A guard that stays is put down to the source of ``node``.
        """
        self._at = self.notes.spans.get(node.id, self._at)
        if node.id in self._branches:
            return self.make("select", node.type, operands, BRANCH)
        if node.op == "call" and self._safe_on_path(node, operands):
            return self.graph.node("native", node.type, operands, node.data)
        return super().rule(graph, node, operands)

    def _safe_on_path(self, node: Node, operands: tuple[Node, ...]) -> bool:
        """Whether conditions prove what ranges alone do not; their selects then have to branch."""
        row = BUILTINS[str(node.data)]
        if not row.expansion:
            return False
        plain = tuple([self.ranges.of(operand) for operand in operands])
        if row.domain(plain):
            return False
        known = [self._paths.known(node, operand) for operand in node.operands]
        facts = tuple(fact.meet(more) for fact, (more, _) in zip(plain, known, strict=True))
        if not row.domain(facts):
            return False
        self._branches.update(select.id for _, selects in known for select in selects)
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
        facts = tuple([self.ranges.of(operand) for operand in node.operands])
        if row.domain(facts):
            return self.graph.node("native", node.type, node.operands, node.data)
        if node.id not in self._expanded:
            if row.outside:
                self.kept[node.id] = Guard(row.name, facts, self._at)
            self._expanded[node.id] = self._expand(node)
            self.ranges.assume(self._expanded[node.id], row.range(facts, False))
        return self._expanded[node.id]

    def _expand(self, node: Node) -> Node:
        found = template(str(node.data), tuple(operand.type for operand in node.operands))
        if not found.lanewise:
            return self._applied(found, node.operands)
        assert isinstance(node.type, Vector)
        lanes = tuple(
            self._applied(found, tuple(self._lane(operand, i) for operand in node.operands))
            for i in range(node.type.size)
        )
        return self.make("vector", with_width(node.type.kind, len(lanes)), lanes)

    def _applied(self, found: Template, operands: tuple[Node, ...]) -> Node:
        """The expansion of one operation: a function's call, or written out.

        Where an operand is constant over the draw, parts of the expansion are too and may leave the
        shader, so it is written out. So are functions that turn out to be called once (``inline``).
        """
        if len(found.operations) < OUTLINED or not all(map(self._varies, operands)):
            return self._instantiate(found, operands)
        # Textures are no arguments everywhere, so each has a function of its own.
        named = [(Formal(n), o) for n, o in zip(found.parameters, operands, strict=True)]
        passed = [(formal, o) for formal, o in named if not isinstance(o.type, Texture)]
        key = found, tuple(o if isinstance(o.type, Texture) else o.type for o in operands)
        if key not in self._functions:
            leaves = tuple(
                o if isinstance(o.type, Texture) else self.graph.node("formal", o.type, (), formal)
                for formal, o in named
            )
            body = self._instantiate(found, leaves)
            self.notes.functions.setdefault(body.id, f"safe_{found.name}")
            self.notes.docs.setdefault(body.id, found.doc)
            self._functions[key] = body, tuple(formal for formal, _ in passed)
        body, formals = self._functions[key]
        return self.graph.node("apply", body.type, (body, *(o for _, o in passed)), formals)

    def _varies(self, root: Node) -> bool:
        """Whether a value may differ between vertices or pixels."""
        pending = [root]
        while pending:
            node = pending[-1]
            missing = [o for o in node.operands if o.id not in self._varying]
            if node.id not in self._varying and missing and node.op not in VARYING:
                pending += missing
                continue
            pending.pop()
            self._varying[node.id] = node.op in VARYING or any(
                self._varying[operand.id] for operand in node.operands
            )
        return self._varying[root.id]

    def written_out(self, found: Template, operands: tuple[Node, ...]) -> Node:
        """The value of a template for these operands, lane by lane where it is one of scalars."""
        size = max(width(operand.type) for operand in operands)
        if not found.lanewise:
            return self._instantiate(found, operands)
        lanes = tuple(
            self._instantiate(found, tuple(self._lane(operand, i) for operand in operands))
            for i in range(size)
        )
        kind = scalar_kind(lanes[0].type)
        assert kind is not None
        return self.make("vector", with_width(kind, size), lanes)

    def _lane(self, operand: Node, lane: int) -> Node:
        if not isinstance(operand.type, Vector):
            return operand
        return self.make("swizzle", Scalar(operand.type.kind), (operand,), (lane,))

    def _instantiate(self, found: Template, operands: tuple[Node, ...]) -> Node:
        values = list(operands)
        for step in found.operations:
            inner = tuple(values[i] for i in step.operands)
            values.append(self.make(step.op, step.type, inner, step.data))
            if self._at is not None:
                self.notes.spans.setdefault(values[-1].id, self._at)
            if step.role and values[-1].operands:
                self.notes.roles.setdefault(values[-1].id, step.role)
        return values[found.result]

"""Replaces builtins by their expansions, which are graphs of simpler operations.

Some builtins exist in no backend: their expansion is all there is. The pass ``expand_builtins``
replaces these before guards are decided, so that a condition inside an expansion counts for the
values behind it. ``guard`` expands others by the same class, ``Expanding``, where operands may be
harmful.
"""

from __future__ import annotations

from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.row import nowhere
from ..expansion_templates import Template, template
from ..ir import build
from ..ir.node import Formal, Formals, Graph, Node, Roots
from ..ir.operations import CALL
from ..ir.ranges import Ranges
from ..ir.rewrite import rewrite
from ..ir.shader import Notes
from ..ir.types import Scalar, TextureType, Type, Vector, scalar_kind, width, with_width
from .draw_constants import DrawConstants
from .simplify import Simplifier

OUTLINED = 3
"""Expansions of at least so many operations become functions where they are used repeatedly."""

_HOMELESS = frozenset(
    name for name, row in BUILTINS.items() if row.domain is nowhere and not row.is_promise
)
"""The builtins that no backend has. Promises stay until guards are decided by them."""


class Expanding(Simplifier):
    """Builds nodes, and on demand their expansions in terms of simpler ones."""

    def __init__(self, graph: Graph, ranges: Ranges, notes: Notes) -> None:
        super().__init__(graph, ranges, notes)
        self.expanded: dict[int, Node] = {}
        """The expansions, by the id of the ``call`` that was expanded."""
        self._constant = DrawConstants(elements=True)
        self._functions: dict[tuple[Template, tuple[Type | Node, ...]], tuple[Node, Formals]] = {}

    def expansion(self, node: Node) -> Node:
        """The value of a ``call`` by the expansion in its builtin's row."""
        if node.id not in self.expanded:
            self.expanding += 1
            self.expanded[node.id] = self._expand(node)
            self.expanding -= 1
        return self.expanded[node.id]

    def _expand(self, node: Node) -> Node:
        found = template(CALL.data(node), tuple(operand.type for operand in node.operands))
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
        if len(found.operations) < OUTLINED or any(
            operand in self._constant for operand in operands
        ):
            return self._instantiate(found, operands)
        # Textures are no arguments everywhere, so each has a function of its own.
        named = [(Formal(n), o) for n, o in zip(found.parameters, operands, strict=True)]
        passed = [(formal, o) for formal, o in named if not isinstance(o.type, TextureType)]
        key = found, tuple(o if isinstance(o.type, TextureType) else o.type for o in operands)
        if key not in self._functions:
            leaves = tuple(
                o
                if isinstance(o.type, TextureType)
                else self.graph.node("formal", o.type, (), formal)
                for formal, o in named
            )
            body = self._instantiate(found, leaves)
            self.notes.functions.setdefault(body.id, f"safe_{found.name}")
            self.notes.docs.setdefault(body.id, found.doc)
            self._functions[key] = body, tuple(formal for formal, _ in passed)
        body, formals = self._functions[key]
        call = build.apply(self.graph, body, tuple(o for _, o in passed), formals)
        self.notes.roles.setdefault(call.id, found.name)
        return call

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
            if self.at is not None:
                self.notes.spans.setdefault(values[-1].id, self.at)
            if step.role and values[-1].operands:
                self.notes.roles.setdefault(values[-1].id, step.role)
        return values[found.result]


def expand_builtins(graph: Graph, roots: Roots, notes: Notes, ranges: Ranges) -> Roots:
    """The roots with every ``call`` that no backend has as its expansion, in calls again."""
    if not any(map(_is_homeless, roots.nodes)):
        return roots
    return rewrite(graph, roots, _WritingOut(graph, ranges, notes).rule, notes.follow)


def _is_homeless(node: Node) -> bool:
    return node.op == "call" and node.head in _HOMELESS


class _WritingOut(Expanding):
    def rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node:
        """Expands builtins that no backend has."""
        if operands is not node.operands:
            node = super().rule(graph, node, operands)
        if not _is_homeless(node):
            return node
        self.at = self.notes.spans.get(node.id, self.at)
        value = self.expansion(node)
        # The builtin's range rule knows more than follows from the operations it consists of.
        self.ranges.assume(value, self.ranges.of(node))
        return value

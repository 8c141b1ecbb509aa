"""Opens every binder once, so that passes can treat bodies like any other part of the graph.

Applies of one body share the opened body and its formals: that is what becomes a function.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...frozen import changed
from ..ir.binding import open_body
from ..ir.node import Folding, Formal, Formals, Graph, Node, binders, body_of
from ..ir.rewrite import rewrite
from ..ir.types import INT, Type
from ..semantics.shader import Notes


class _Opener:
    def __init__(self, notes: Notes) -> None:
        self._notes = notes
        self._opened: dict[tuple[int, int], tuple[Node, Formals]] = {}

    def rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        """Open ``node`` if it binds; its body has been opened inside already."""
        if not binders(node):
            return None
        position = 2 if node.op == "fold" else 0
        types = (INT,) if node.op == "fold" else tuple(arg.type for arg in operands[1:])
        body, formals = self._open(graph, node, operands[position], types)
        opened = (*operands[:position], body, *operands[position + 1 :])
        if node.op == "fold":
            assert isinstance(node.data, Folding)
            return graph.node("fold", node.type, opened, changed(node.data, index=formals[0]))
        return graph.node("apply", node.type, opened, formals)

    def _open(
        self, graph: Graph, node: Node, body: Node, types: tuple[Type, ...]
    ) -> tuple[Node, Formals]:
        original = body_of(node)
        assert original is not None
        key = (original.id, len(types))
        if key not in self._opened:
            names = self._names(original, len(types))
            formals = tuple(Formal(name) for name in names)
            leaves = [
                graph.node("formal", type_, (), formal)
                for type_, formal in zip(types, formals, strict=True)
            ]
            opened = open_body(graph, body, leaves, self._notes.follow)
            self._notes.follow(original, opened)
            self._opened[key] = opened, formals
        return self._opened[key]

    def _names(self, body: Node, count: int) -> tuple[str, ...]:
        known = self._notes.variables.get(body.id, ())
        return tuple(known[i] if i < len(known) else "i" for i in range(count))


def open_binders(graph: Graph, roots: Iterable[Node], notes: Notes) -> list[Node]:
    """The roots with every fold and apply opened."""
    return rewrite(graph, roots, _Opener(notes).rule, notes.follow)

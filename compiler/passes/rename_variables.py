"""Alpha-renaming: gives every loop variables of its own.

Some passes copy bodies with the loops inside them, after which two loops may bind the same
variable. A node that depends only on this variable would then be one node for both loops, and the
scheduler could place it in neither. So this pass runs after all that copy, before the graph is
split into stages: in the pipeline, and again where ``targets/legalise/guards.py`` has inlined.
"""

from __future__ import annotations

from typing import TypeAlias

from ...support.frozen import changed
from ..ir.binding import Moved
from ..ir.node import (
    Binder,
    Formal,
    Formals,
    Graph,
    Node,
    Roots,
    bodies_of,
    formals_of,
)
from ..ir.operations import LOOPS

_Renamed: TypeAlias = frozenset[tuple[Formal, Formal]]
_NOTHING: _Renamed = frozenset()


def rename_variables(graph: Graph, roots: Roots, moved: Moved) -> Roots:
    """The roots with no variable bound by two loops."""
    if LOOPS.isdisjoint(roots.ops):
        return roots
    loops = [node for node in roots.nodes if node.op in LOOPS]
    if len({formal for loop in loops for formal in formals_of(loop)}) == sum(
        len(formals_of(loop)) for loop in loops
    ):
        return roots
    separating = _Separating(graph, moved)
    return Roots(map(separating.value, roots))


class _Separating:
    def __init__(self, graph: Graph, moved: Moved) -> None:
        self._graph = graph
        self._moved = moved
        self._done: dict[tuple[int, _Renamed], Node] = {}
        self._own: dict[tuple[int, _Renamed], Formals] = {}
        self._taken: set[Formal] = set()

    def value(self, root: Node) -> Node:
        """``root`` with the variables of the loops in it renamed where others have them."""
        pending: list[tuple[Node, _Renamed]] = [(root, _NOTHING)]
        while pending:
            node, around = pending[-1]
            if (node.id, around) in self._done:
                pending.pop()
                continue
            parts = self._parts(node, around)
            missing = [part for part in parts if (part[0].id, part[1]) not in self._done]
            if missing:
                pending += missing
                continue
            pending.pop()
            operands = tuple(self._done[part.id, inner] for part, inner in parts)
            self._done[node.id, around] = self._rebuilt(node, around, operands)
        return self._done[root.id, _NOTHING]

    def _parts(self, node: Node, around: _Renamed) -> list[tuple[Node, _Renamed]]:
        """The operands, with the names that hold in each for the variables that it needs."""
        inside = bodies_of(node) if node.op != "apply" else ()
        within = around
        if inside:
            old = formals_of(node)
            new = self._variables(node, around)
            kept = {pair for pair in around if pair[0] not in old}
            within = frozenset(kept.union(zip(old, new, strict=True)))
        return [
            (part, _needed(part, within if i in inside else around))
            for i, part in enumerate(node.operands)
        ]

    def _variables(self, loop: Node, around: _Renamed) -> Formals:
        key = loop.id, around
        if key not in self._own:
            formals = formals_of(loop)
            if not self._taken.isdisjoint(formals):
                formals = tuple(Formal(formal.name) for formal in formals)
            self._taken.update(formals)
            self._own[key] = formals
        return self._own[key]

    def _rebuilt(self, node: Node, around: _Renamed, operands: tuple[Node, ...]) -> Node:
        data = node.data
        if isinstance(data, Formal):
            data = dict(around).get(data, data)
        elif isinstance(data, Binder) and node.op in LOOPS:
            data = changed(data, formals=self._own[node.id, around])
        if operands == node.operands and data == node.data:
            return node
        new = self._graph.node(node.op, node.type, operands, data)
        self._moved(node, new)
        return new


def _needed(node: Node, names: _Renamed) -> _Renamed:
    if not names or not node.variables:
        return _NOTHING
    return frozenset(pair for pair in names if pair[0] in node.variables)

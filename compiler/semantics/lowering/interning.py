"""Makes a graph of checked trees: equal values become one node, and keep the notes about them."""

from __future__ import annotations

from collections.abc import Hashable, Iterable

from ....support.frozen import changed
from ...ir.node import Graph, Node, reachable
from ...ir.shader import Notes
from ..checking.call_marks import Callee


class Interning:
    """The graph of some trees, which grows with each of them. It reports nothing."""

    def __init__(self, noted: Notes) -> None:
        """``noted`` are the notes about the trees' nodes."""
        self.graph = Graph()
        self.notes = Notes()
        self.written: dict[Callee, Callee] = {}
        """The callees as the trees have them, by their form in the graph."""
        self._noted = noted
        self._made: dict[Node, Node] = {}

    def interned(self, roots: Iterable[Node]) -> list[Node]:
        """The graph's nodes for these trees."""
        wanted = list(roots)
        made, make = self._made, self.graph.node
        new = {}
        for node in reachable(wanted):
            if node not in made:
                operands = tuple([made[operand] for operand in node.operands])
                made[node] = make(node.op, node.type, operands, self._data(node))
                new[node.id] = made[node].id
        self.notes.take_over(self._noted, new)
        return [made[root] for root in wanted]

    def _data(self, node: Node) -> Hashable:
        """The data of a node; for a call, with the arguments that its body is for as nodes."""
        if not isinstance(node.data, Callee):
            return node.data
        given = (
            self.interned([each])[0] if isinstance(each, Node) else each for each in node.data.given
        )
        callee = changed(node.data, given=tuple(given))
        self.written.setdefault(callee, node.data)
        return callee

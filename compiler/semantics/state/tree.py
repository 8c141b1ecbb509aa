"""Typed trees: checked expressions, in which every use of a value stands in its own place.

A tree is made of the graph's nodes, with the graph's operations, so that whatever can be asked of a
graph (its types, ranges, constants) can be asked of a tree. But equal expressions are not one node:
each stands where it is written, and messages and editors can tell them apart. Only values with a
name are shared, as the value of a slot is by all that read it. ``lowering`` makes a graph of it.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping

from ....support.frozen import EMPTY
from ...ir.node import Graph, Node, Op, key_of
from ...ir.types import Type
from ..work import Work


class Tree(Graph):
    """Makes nodes, and a new one whenever it is asked for one.

    Only a rule that runs once more gets the nodes that it made before (``evaluation``), as values
    computed for it in between are known by these.
    """

    def __init__(self, work: Work) -> None:
        """``work`` counts all nodes."""
        super().__init__()
        self._work = work
        self.nodes: list[Node] = []
        """All nodes that were made, in order."""
        self.again: Mapping[Hashable, Node] = EMPTY
        """The nodes that a rule made before, if it runs once more."""

    def __len__(self) -> int:
        return len(self.nodes)

    def node(
        self, op: Op, type_: Type, operands: tuple[Node, ...] = (), data: Hashable = None
    ) -> Node:
        """A new node that is this operation of these operands."""
        if self.again and (known := self.again.get(key_of(op, type_, operands, data))):
            return known
        node = Node(op, type_, operands, data, len(self.nodes))
        self.nodes.append(node)
        self._work.nodes += 1
        return node

    def made_since(self, first: int) -> dict[Hashable, Node]:
        """The nodes that were made since there were ``first`` of them, to be found ``again``."""
        made = self.nodes[first:]
        return {key_of(node.op, node.type, node.operands, node.data): node for node in made}

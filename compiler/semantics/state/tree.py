"""What has been checked: typed trees, in which every use of a value stands in its own place.

A tree is made of the graph's nodes, with the graph's operations, so that whatever can be asked of
a graph (its types, ranges, constants) can be asked of a tree. But equal expressions are not one
node: each stands where it is written, and messages and editors can tell them apart. Only what has a
name is shared, as the value of a slot is by all that read it. ``lowering`` makes a graph of it.
"""

from __future__ import annotations

from collections.abc import Hashable

from ...ir.node import Graph, Node, Op
from ...ir.types import Type


class Tree(Graph):
    """Makes nodes, and a new one whenever it is asked for one."""

    def __init__(self) -> None:
        super().__init__()
        self._count = 0

    def __len__(self) -> int:
        return self._count

    def node(
        self, op: Op, type_: Type, operands: tuple[Node, ...] = (), data: Hashable = None
    ) -> Node:
        """A new node that is this operation of these operands."""
        node = Node(op, type_, operands, data, self._count)
        self._count += 1
        return node

"""The one way a pass rebuilds a graph: bottom-up, once per node, without recursion."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from .binding import Moved
from .node import Graph, Node, reachable

Rule = Callable[[Graph, Node, tuple[Node, ...]], Node | None]
"""``(graph, node, new_operands) -> replacement``; ``None`` keeps the operation as it is."""


def rewrite(
    graph: Graph, roots: Iterable[Node], rule: Rule, moved: Moved | None = None
) -> list[Node]:
    """The roots, rebuilt with ``rule`` applied to every node they need, operands before users.

    Bodies of folds and applies are ordinary operands here. A replacement therefore stands under
    the same binders as what it replaces and may use the same ``bound`` variables, no others.
    """
    wanted = list(roots)
    new: dict[int, Node] = {}
    for node in reachable(wanted):
        operands = node.operands
        if operands:
            operands = tuple([new[operand.id] for operand in operands])
        replacement = rule(graph, node, operands) or with_operands(graph, node, operands)
        new[node.id] = replacement
        if moved is not None and replacement is not node:
            moved(node, replacement)
    return [new[root.id] for root in wanted]


def with_operands(graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node:
    """The same operation of other operands; ``node`` itself where they are its own."""
    if operands == node.operands:
        return node
    return graph.node(node.op, node.type, operands, node.data)
